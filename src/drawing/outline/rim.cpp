#include "drawing/outline/rim.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace icome::drawing {
namespace {

Vector2 quarter_turned(const Vector2& v) { return {-v.y(), v.x()}; }
double spanned(const Vector2& a, const Vector2& b) { return a.x() * b.y() - a.y() * b.x(); }

constexpr double kQuarter = 0.5 * std::numbers::pi;
constexpr double kQuarterArcError = 2.73e-4;  // of the radius, of the best cubic with these tangents

/// In how many cubics an arc is drawn: their error falls with the sixth power of the angle.
int arc_pieces(double radius, double turn, double tolerance) {
  const double error = kQuarterArcError * radius / std::max(tolerance, 1e-6 * radius);
  const double widest = kQuarter * std::min(1.0, std::pow(1.0 / std::max(error, 1e-12), 1.0 / 6.0));
  return std::max(1, int(std::ceil(std::abs(turn) / widest - 1e-9)));
}

constexpr int kSteps = 8;  // of a part in which its rim is looked at

/// A place on the rim.
struct RimSample {
  double t;
  Vector2 point;
  Vector2 touching;  // direction from the centre
  double speed;      // as rim_speed()
  double radius;
};

RimSample rim_sample(const SweptPart& part, double side, double t) {
  const SweepingDisc disc = part.disc_at(t);
  const Vector2 touching = disc.touching(side);
  return {t, disc.centre + disc.radius * touching, touching, disc.rim_speed(side), disc.radius};
}

using RimSamples = std::array<RimSample, kSteps + 1>;

constexpr double kSteepSine = 0.3;  // of the lean: beyond it the rim moves like a square root

/// Samples of a range, denser at an end at which the disc grows or shrinks almost as fast as it moves.
RimSamples rim_samples(const SweptPart& part, double side, double from, double to) {
  const bool steep_start = part.disc_at(from).lean_sine() < kSteepSine;
  const bool steep_end = part.disc_at(to).lean_sine() < kSteepSine;
  RimSamples samples;
  for (int k = 0; k <= kSteps; ++k) {
    const double w = double(k) / kSteps;
    const double even = steep_start && steep_end ? w * w * (3.0 - 2.0 * w)
                        : steep_start            ? w * w
                        : steep_end              ? w * (2.0 - w)
                                                 : w;
    samples[std::size_t(k)] = rim_sample(part, side, k == kSteps ? to : std::lerp(from, to, even));
  }
  return samples;
}

constexpr double kWidestTurn = 1.9;  // rad, of the rim in one cubic
constexpr double kWidestStep = 0.5;  // rad, from sample to sample

double turn_of_rim(const Vector2& a, const Vector2& b) { return std::atan2(spanned(a, b), a.dot(b)); }

bool turns_little(const RimSamples& samples) {
  double turn = 0.0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double step = std::abs(turn_of_rim(samples[k - 1].touching, samples[k].touching));
    if (step > kWidestStep) return false;
    turn += step;
  }
  return turn <= kWidestTurn;
}

/// Fits a cubic to samples of a rim that runs forward; its directions at both ends are given.
class RimFit {
 public:
  RimFit(const RimSamples& samples, double side)
      : samples_(samples),
        start_way_(-side * quarter_turned(samples.front().touching)),
        end_way_(-side * quarter_turned(samples.back().touching)) {
    double run = 0.0;
    for (std::size_t k = 1; k < samples.size(); ++k) {
      run += (samples[k].point - samples[k - 1].point).norm();
      t_[k] = run;
    }
    for (double& t : t_) t = run > 0.0 ? t / run : 0.0;
    run_ = run;
  }

  /// The cubic that lies within `tolerance` of the samples, and in thin places on the right side of the
  /// centre line; nothing where none was found.
  std::optional<CubicBezier> within(double tolerance) {
    for (int i = 0; i < kMostRounds; ++i) {
      const CubicBezier curve = least_squares();
      const double error = moved_to_nearest(curve, tolerance);
      if (error <= 1.0) return curve;
      if (error > kHopeless) return std::nullopt;
    }
    return std::nullopt;
  }

  double run() const { return run_; }

 private:
  static constexpr int kMostRounds = 4;
  static constexpr double kHopeless = 30.0;
  static constexpr double kThinnest = 0.03;

  CubicBezier with_handles(double start, double end) const {
    const Vector2& a = samples_.front().point;
    const Vector2& b = samples_.back().point;
    return {{a, a + start * start_way_, b - end * end_way_, b}};
  }

  /// The handles by which the sum of the squared distances at the present parameters is smallest.
  CubicBezier least_squares() const {
    double aa = 0.0, ab = 0.0, bb = 0.0, ay = 0.0, by = 0.0;
    const CubicBezier bare = with_handles(0.0, 0.0);
    for (std::size_t k = 1; k < kSteps; ++k) {
      const double t = t_[k], u = 1.0 - t;
      const Vector2 a = 3.0 * t * u * u * start_way_;
      const Vector2 b = -3.0 * t * t * u * end_way_;
      const Vector2 y = samples_[k].point - bare.at(t);
      aa += a.dot(a), ab += a.dot(b), bb += b.dot(b), ay += a.dot(y), by += b.dot(y);
    }
    const double determinant = aa * bb - ab * ab;
    const double start = (ay * bb - by * ab) / determinant;
    const double end = (by * aa - ay * ab) / determinant;
    const bool sound = start >= 0.0 && end >= 0.0 && start <= run_ && end <= run_;
    return sound && determinant > 1e-12 * aa * bb ? with_handles(start, end)
                                                  : with_handles(run_ / 3.0, run_ / 3.0);
  }

  /// Moves the parameters towards the nearest points; the greatest distance of a sample over what is allowed.
  double moved_to_nearest(const CubicBezier& curve, double tolerance) {
    double worst = 0.0;
    for (std::size_t k = 1; k < kSteps; ++k) {
      for (int i = 0; i < 2; ++i) {
        const Vector2 way = curve.derivative(t_[k]);
        const Vector2 off = curve.at(t_[k]) - samples_[k].point;
        const double slope = way.dot(way) + off.dot(curve.second_derivative(t_[k]));
        if (slope > 0.0) t_[k] = std::clamp(t_[k] - off.dot(way) / slope, 0.0, 1.0);
      }
      const double allowed = std::clamp(0.5 * samples_[k].radius, kThinnest * tolerance, tolerance);
      worst = std::max(worst, (curve.at(t_[k]) - samples_[k].point).norm() / allowed);
    }
    return worst;
  }

  const RimSamples& samples_;
  Vector2 start_way_, end_way_;
  std::array<double, kSteps + 1> t_{};
  double run_ = 0.0;
};

/// A spoke: from the centre of a disc towards its touching point, as far as the next ones do not cross it.
struct Spoke {
  double t;
  Vector2 centre, tip, touching;
};

/// The point in which two segments, each from `.centre` to `.tip`, cross.
std::optional<Vector2> crossing_of(const Spoke& a, const Spoke& b) {
  const Vector2 along_a = a.tip - a.centre;
  const Vector2 along_b = b.tip - b.centre;
  const Vector2 between = b.centre - a.centre;
  const double span = spanned(along_a, along_b);
  const double on_a = spanned(between, along_b) / span;
  const double on_b = spanned(between, along_a) / span;
  const bool meet = on_a >= 0.0 && on_a <= 1.0 && on_b >= 0.0 && on_b <= 1.0;  // false for not-a-numbers
  return meet ? std::optional<Vector2>(a.centre + on_a * along_a) : std::nullopt;
}

double distance_to_line(const Vector2& p, const Vector2& a, const Vector2& b) {
  const Vector2 way = b - a;
  const double length2 = way.squaredNorm();
  const double t = length2 > 0.0 ? std::clamp((p - a).dot(way) / length2, 0.0, 1.0) : 0.0;
  return (p - a - t * way).norm();
}

/// Lengthens a rim on one side of a part.
class SideTracer {
 public:
  SideTracer(Rim& rim, const SweptPart& part, double side, double tolerance)
      : rim_(rim), part_(part), side_(side), tolerance_(tolerance) {}

  void trace(double from, double to, int depth) {
    const RimSamples samples = rim_samples(part_, side_, from, to);
    if (const auto turn = turning_place(samples)) {
      if (depth<kMostDepth&& * turn> from && *turn < to) {
        trace(from, *turn, depth + 1);
        trace(*turn, to, depth + 1);
        return;
      }
    } else if (samples[kSteps / 2].speed <= 0.0) {
      return trace_crossings(from, to);
    }
    trace_forward(samples, depth);
  }

 private:
  static constexpr int kMostDepth = 40;
  static constexpr int kMostCrossingDepth = 12;
  static constexpr double kWidestSpokes = 0.5;    // rad between neighbours
  static constexpr double kSampledShare = 0.6;    // of the tolerance at the samples: it is more between them
  static constexpr double kStraightShare = 0.01;  // of the tolerance: less is not bent
  static constexpr double kStill = 1e-6;          // a rim speed that may be rounding

  void trace_forward(const RimSamples& samples, int depth) {
    RimFit fit(samples, side_);
    if (fit.run() <= kSampledShare * tolerance_ || depth >= kMostDepth || straight(samples))
      return rim_.line_to(samples.back().point);
    const auto curve = turns_little(samples) ? fit.within(kSampledShare * tolerance_) : std::nullopt;
    if (curve) return rim_.curve_to(curve->points[1], curve->points[2], curve->points[3]);
    trace(samples.front().t, samples[kSteps / 2].t, depth + 1);
    trace(samples[kSteps / 2].t, samples.back().t, depth + 1);
  }

  bool straight(const RimSamples& samples) const {
    const Vector2& from = samples.front().point;
    const Vector2& to = samples.back().point;
    return std::all_of(samples.begin(), samples.end(), [&](const RimSample& sample) {
      return distance_to_line(sample.point, from, to) <= kStraightShare * tolerance_;
    });
  }

  /// The place at which the rim begins to run back or forward again, if it does so between two of the
  /// samples.
  std::optional<double> turning_place(const RimSamples& samples) const {
    const auto unsure = [](const RimSample& sample) { return std::abs(sample.speed) <= kStill; };
    for (std::size_t k = 1; k < samples.size(); ++k) {
      const RimSample& a = samples[k - 1];
      const RimSample& b = samples[k];
      if ((k == 1 && unsure(a)) || (k + 1 == samples.size() && unsure(b))) continue;
      if ((a.speed > 0.0) != (b.speed > 0.0)) return halved_to_turn(a.t, b.t, a.speed > 0.0);
    }
    return std::nullopt;
  }

  double halved_to_turn(double low, double high, bool forward_at_low) const {
    for (int i = 0; i < 50; ++i) {
      const double middle = 0.5 * (low + high);
      const bool forward = part_.disc_at(middle).rim_speed(side_) > 0.0;
      (forward == forward_at_low ? low : high) = middle;
    }
    return 0.5 * (low + high);
  }

  Spoke spoke_at(double t) const {
    const SweepingDisc disc = part_.disc_at(t);
    const Vector2 touching = disc.touching(side_);
    return {t, disc.centre, disc.centre + disc.crossing(side_) * touching, touching};
  }

  void trace_crossings(double from, double to) {
    const Spoke first = spoke_at(from);
    rim_.line_to(first.tip);
    trace_crossings(first, spoke_at(to), 0);
    rim_.line_to(rim_sample(part_, side_, to).point);
  }

  void trace_crossings(const Spoke& a, const Spoke& b, int depth) {
    const Spoke middle = spoke_at(0.5 * (a.t + b.t));
    const auto meeting = crossing_of(a, b);
    const Vector2 corner = meeting.value_or(b.tip);
    const double off =
        std::min(distance_to_line(middle.tip, a.tip, corner), distance_to_line(middle.tip, corner, b.tip));
    const bool narrow = std::abs(turn_of_rim(a.touching, middle.touching)) +
                            std::abs(turn_of_rim(middle.touching, b.touching)) <=
                        kWidestSpokes;
    if (depth >= kMostCrossingDepth || (narrow && off <= kSampledShare * tolerance_)) {
      return append_cell(a, b, meeting);
    }
    trace_crossings(a, middle, depth + 1);
    trace_crossings(middle, b, depth + 1);
  }

  /// From tip to tip; what lies between the spokes must not be wound around backwards.
  void append_cell(const Spoke& a, const Spoke& b, const std::optional<Vector2>& meeting) {
    if (meeting) {
      rim_.line_to(*meeting);
    } else if (side_ * (spanned(b.tip - a.centre, a.tip - a.centre) +
                        spanned(b.centre - a.centre, b.tip - a.centre)) <
               0.0) {
      rim_.line_to(a.centre);
      rim_.line_to(b.centre);
    }
    rim_.line_to(b.tip);
  }

  Rim& rim_;
  const SweptPart& part_;
  double side_;
  double tolerance_;
};

}  // namespace

void Rim::line_to(const Vector2& point) {
  if (point == at_) return;
  edges_.push_back(CubicBezier::line(at_, point));
  at_ = point;
}

void Rim::curve_to(const Vector2& first_control, const Vector2& second_control, const Vector2& end) {
  edges_.push_back({{at_, first_control, second_control, end}});
  at_ = end;
}

void Rim::arc_to(const Vector2& centre, double turn, const Vector2& end, double tolerance) {
  const Vector2 spoke = at_ - centre;
  const int pieces = arc_pieces(spoke.norm(), turn, tolerance);
  const double step = turn / pieces;
  const double handle = 4.0 / 3.0 * std::tan(0.25 * step);
  Vector2 from = spoke;
  for (int i = 1; i <= pieces; ++i) {
    const Vector2 to = i == pieces ? Vector2(end - centre) : Vector2(Eigen::Rotation2Dd(i * step) * spoke);
    curve_to(centre + from + handle * quarter_turned(from), centre + to - handle * quarter_turned(to),
             centre + to);
    from = to;
  }
  edges_.back().points[3] = at_ = end;
}

void Rim::append_reversed(const Rim& other) {
  line_to(other.at_);
  for (auto edge = other.edges_.rbegin(); edge != other.edges_.rend(); ++edge)
    edges_.push_back(edge->reversed());
  at_ = other.start_;
}

void append_side(Rim& rim, const SweptPart& part, double side, double tolerance) {
  SideTracer(rim, part, side, tolerance).trace(part.from, part.to, 0);
}

}  // namespace icome::drawing
