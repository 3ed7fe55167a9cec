#include "sketch/fit/smooth_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sketch/fit/band_system.h"
#include "sketch/fit/fit_error.h"

namespace icome::sketch {
namespace {

constexpr std::size_t kUnknowns = 5;   // of a joint: handle before, x, y, direction, handle after
constexpr double kAlongWeight = 0.03;  // of distance along the curve beside that across it
constexpr int kEvenRounds = 3;         // rounds in which all distances count alike
constexpr double kHighPower = 16.0;    // of distances, afterwards
constexpr double kLeastWeight = 1e-3;  // of a point that the curve goes through, beside the farthest
constexpr int kStepsAtFirst = 8;       // of Newton's method, to find where points belong on the curve
constexpr int kStepsAgain = 2;
constexpr double kShortened = 0.1;        // of a handle, at most this is left by a round
constexpr double kShortestHandle = 1e-3;  // of the distance that is enough, or it has no direction
constexpr double kFirstDamping = 1e-3;
constexpr double kMoreDamping = 8.0;   // after each attempt
constexpr double kLessDamping = 0.02;  // after one that was better
constexpr int kMostAttempts = 5;
constexpr double kAim = 0.95;         // of what is enough, since points do not tell all
constexpr double kResolution = 0.02;  // of the distance that is enough, by which certified ones may be above
constexpr double kSlow = 0.995;  // a round that leaves more than this of the greatest distance is the last

Vector2 direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2 across(const Vector2& way) { return {-way.y(), way.x()}; }

double angle_of(const Vector2& way) { return std::atan2(way.y(), way.x()); }

/// The direction halfway between two, by the shorter turn.
double mean_direction(const Vector2& a, const Vector2& b) {
  const Vector2 sum = a + b;
  return sum.norm() > 1e-6 ? angle_of(sum) : angle_of(a);
}

}  // namespace

/// A point of the way, and where the curve is nearest to it.
struct SmoothSpline::Place {
  std::size_t segment;
  double t;
  double distance = 0.0;
};

/// The normal equations for one round.
class SmoothSpline::Normal {
 public:
  explicit Normal(std::size_t joints) : system_(kUnknowns * joints) {}

  void begin(const SmoothSpline& spline, const Freedom& freedom) {
    system_.clear();
    for (std::size_t i = 0; i < system_.size(); ++i) system_.add(i, i, 1e-9);
    spline_ = &spline;
    freedom_ = freedom;
  }

  void add(const Place& place, const Vector2& point, double weight) {
    const Joint& from = spline_->joints_[place.segment];
    const Joint& to = spline_->joints_[place.segment + 1];
    const CubicBezier curve = spline_->segment(place.segment);
    const double t = place.t;
    const double u = 1.0 - t;
    const double b0 = u * u * u;
    const double b1 = 3.0 * t * u * u;
    const double b2 = 3.0 * t * t * u;
    const double b3 = t * t * t;
    const Vector2 way_from = direction_of(from.direction);
    const Vector2 way_to = direction_of(to.direction);
    const bool first_moves = moves(place.segment);
    const bool last_moves = moves(place.segment + 1);
    // Columns: x, y, direction, handle of the first joint; handle, x, y, direction of the last.
    Eigen::Matrix<double, 2, 8> columns = Eigen::Matrix<double, 2, 8>::Zero();
    if (first_moves) columns.leftCols<2>() = (b0 + b1) * Eigen::Matrix2d::Identity();
    if (turns(place.segment)) columns.col(2) = b1 * from.after * across(way_from);
    columns.col(3) = b1 * way_from;
    columns.col(4) = -b2 * way_to;
    if (last_moves) columns.middleCols<2>(5) = (b2 + b3) * Eigen::Matrix2d::Identity();
    if (turns(place.segment + 1)) columns.col(7) = -b2 * to.before * across(way_to);
    add_rows(kUnknowns * place.segment + 1, columns, curve, t, point, weight);
  }

  std::vector<double> step(double damping) const { return system_.solve(damping); }

 private:
  bool moves(std::size_t joint) const { return joint > 0 && joint < spline_->segments(); }
  bool turns(std::size_t joint) const {
    return moves(joint) || (joint == 0 ? freedom_.turn_first : freedom_.turn_last);
  }

  void add_rows(std::size_t base, const Eigen::Matrix<double, 2, 8>& columns, const CubicBezier& curve,
                double t, const Vector2& point, double weight) {
    const Vector2 away = point - curve.at(t);
    Vector2 along = curve.derivative(t);
    const double speed = along.norm();
    if (speed > 0.0) along /= speed;
    const Eigen::Matrix<double, 1, 8> rows[2] = {across(along).transpose() * columns,
                                                 along.transpose() * columns};
    const double misses[2] = {across(along).dot(away), along.dot(away)};
    const double weights[2] = {weight, kAlongWeight * weight};
    for (int row = 0; row < 2; ++row) {
      for (std::size_t i = 0; i < 8; ++i) {
        const double left = weights[row] * rows[row][Eigen::Index(i)];
        system_.add_right(base + i, left * misses[row]);
        for (std::size_t j = 0; j <= i; ++j)
          system_.add(base + i, base + j, left * rows[row][Eigen::Index(j)]);
      }
    }
  }

  BandSystem system_;
  const SmoothSpline* spline_ = nullptr;
  Freedom freedom_;
};

SmoothSpline SmoothSpline::through(std::span<const CubicBezier> segments) {
  std::vector<Joint> joints(segments.size() + 1);
  for (std::size_t i = 0; i <= segments.size(); ++i) {
    const CubicBezier& before = segments[i > 0 ? i - 1 : 0];
    const CubicBezier& after = segments[std::min(i, segments.size() - 1)];
    const Vector2 arrives = i > 0 ? before.end_direction() : after.start_direction();
    const Vector2 leaves = i < segments.size() ? after.start_direction() : before.end_direction();
    joints[i] = {i < segments.size() ? after.points[0] : before.points[3], mean_direction(arrives, leaves),
                 (before.points[3] - before.points[2]).norm(), (after.points[1] - after.points[0]).norm()};
  }
  return SmoothSpline(std::move(joints));
}

CubicBezier SmoothSpline::segment(std::size_t i) const {
  const Joint& from = joints_[i];
  const Joint& to = joints_[i + 1];
  return {{from.place, from.place + from.after * direction_of(from.direction),
           to.place - to.before * direction_of(to.direction), to.place}};
}

std::vector<CubicBezier> SmoothSpline::curve() const {
  std::vector<CubicBezier> all;
  for (std::size_t i = 0; i < segments(); ++i) all.push_back(segment(i));
  return all;
}

double SmoothSpline::find_places(std::span<const Vector2> points, std::vector<Place>& places,
                                 int steps) const {
  double greatest = 0.0;
  std::size_t made = std::numeric_limits<std::size_t>::max();
  CubicBezier curve;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Place& place = places[i];
    for (int step = 0; step < steps; ++step) {
      if (made != place.segment) curve = segment(made = place.segment);
      const Vector2 away = curve.at(place.t) - points[i];
      const Vector2 speed = curve.derivative(place.t);
      const double bend = speed.squaredNorm() + away.dot(curve.second_derivative(place.t));
      const double steepness = bend > 0.0 ? bend : speed.squaredNorm();
      if (!(steepness > 0.0)) break;
      const double t = place.t - std::clamp(away.dot(speed) / steepness, -0.25, 0.25);
      const bool back = t < 0.0 && place.segment > 0;
      const bool on = t > 1.0 && place.segment + 1 < segments();
      if (back) place = {place.segment - 1, 1.0};
      if (on) place = {place.segment + 1, 0.0};
      if (!back && !on) place.t = std::clamp(t, 0.0, 1.0);
    }
    if (made != place.segment) curve = segment(made = place.segment);
    place.distance = (curve.at(place.t) - points[i]).norm();
    greatest = std::max(greatest, place.distance);
  }
  return greatest;
}

namespace {

/// The places of the points on segments whose lengths are these, if both are run through alike.
template <typename Place>
std::vector<Place> spread_evenly(std::span<const Vector2> points, const std::vector<double>& lengths) {
  std::vector<double> along(points.size(), 0.0);
  for (std::size_t i = 1; i < points.size(); ++i)
    along[i] = along[i - 1] + (points[i] - points[i - 1]).norm();
  double all = 0.0;
  for (const double length : lengths) all += length;
  std::vector<Place> places;
  std::size_t segment = 0;
  double passed = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double here = along.back() > 0.0 ? along[i] / along.back() * all : 0.0;
    while (segment + 1 < lengths.size() && here > passed + lengths[segment]) passed += lengths[segment++];
    const double t = lengths[segment] > 0.0 ? (here - passed) / lengths[segment] : 0.0;
    places.push_back({segment, std::clamp(t, 0.0, 1.0)});
  }
  return places;
}

/// The sum of a power of all distances in units of `scale`: what a round must lessen.
template <typename Places>
double sum_of_powers(const Places& places, double scale, double power) {
  double sum = 0.0;
  for (const auto& place : places) sum += std::pow(place.distance / scale, power);
  return sum;
}

}  // namespace

SmoothSpline SmoothSpline::moved_by(const std::vector<double>& step) const {
  SmoothSpline moved = *this;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    Joint& joint = moved.joints_[j];
    const double* of_joint = step.data() + kUnknowns * j;
    // A handle that would turn over only gets short, and keeps its direction.
    joint.before = std::max({kShortestHandle, kShortened * joint.before, joint.before + of_joint[0]});
    joint.place += Vector2(of_joint[1], of_joint[2]);
    joint.direction += of_joint[3];
    joint.after = std::max({kShortestHandle, kShortened * joint.after, joint.after + of_joint[4]});
  }
  return moved;
}

/// The state of the rounds that bring a spline near to points.
struct SmoothSpline::Approach {
  std::span<const Vector2> points;
  std::vector<Place> places;  // of the points on the spline as it is
  double greatest;            // distance of these
  double power = 2.0;         // of distances, whose sum a round lessens
  double damping = kFirstDamping;
  std::vector<Joint> best;  // so far, by the greatest distance
  std::vector<Place> best_places;
  double least;

  void keep_if_best(const SmoothSpline& spline) {
    if (!(greatest < least)) return;
    best = spline.joints_;
    best_places = places;
    least = greatest;
  }
};

SmoothSpline::Approach SmoothSpline::begin_approach(std::span<const Vector2> points) const {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < segments(); ++i) lengths.push_back(segment(i).length());
  Approach approach{.points = points,
                    .places = spread_evenly<Place>(points, lengths),
                    .greatest = 0.0,
                    .best = joints_,
                    .best_places = {},
                    .least = 0.0};
  approach.greatest = approach.least = find_places(points, approach.places, kStepsAtFirst);
  approach.best_places = approach.places;
  return approach;
}

/// Takes the step of the normal equations, damped more and more until the sum of powers is less; false where
/// it does not get less.
bool SmoothSpline::take_step(const Normal& normal, Approach& approach, double scale) {
  const double before = sum_of_powers(approach.places, scale, approach.power);
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::vector<double> step = normal.step(approach.damping);
    approach.damping *= kMoreDamping;
    if (step.empty()) continue;
    SmoothSpline moved = moved_by(step);
    std::vector<Place> moved_places = approach.places;
    const double moved_greatest = moved.find_places(approach.points, moved_places, kStepsAgain);
    if (!(sum_of_powers(moved_places, scale, approach.power) < before)) continue;
    joints_ = std::move(moved.joints_);
    approach.places = std::move(moved_places);
    approach.greatest = moved_greatest;
    approach.damping *= kLessDamping;
    return true;
  }
  return false;
}

/// One round: points count by a power of their distance. False where more rounds are of no use.
bool SmoothSpline::run_round(Normal& normal, const Freedom& freedom, Approach& approach) {
  const double scale = approach.greatest;
  normal.begin(*this, freedom);
  for (std::size_t i = 0; i < approach.points.size(); ++i) {
    const Place& place = approach.places[i];
    normal.add(place, approach.points[i],
               std::pow(place.distance / scale, approach.power - 2.0) + kLeastWeight);
  }
  const bool better = take_step(normal, approach, scale);
  const bool is_late = approach.power > 2.0;
  approach.keep_if_best(*this);
  if (is_late) return better && !(approach.greatest > kSlow * scale);
  if (!better) {
    approach.power = kHighPower;
    approach.damping = kFirstDamping;
  }
  return true;
}

double SmoothSpline::bring_near(std::span<const Vector2> points, const Freedom& freedom, double enough,
                                int most_rounds) {
  Approach approach = begin_approach(points);
  Normal normal(joints_.size());
  for (int round = 0; round < most_rounds; ++round) {
    if (!(approach.least > kAim * enough) || !std::isfinite(approach.greatest)) break;
    if (round == kEvenRounds) approach.power = kHighPower;
    if (!run_round(normal, freedom, approach)) break;
  }
  joints_ = std::move(approach.best);
  return note_errors(points, approach.best_places, kResolution * enough);
}

void SmoothSpline::replace(std::size_t first, std::size_t last, const SmoothSpline& part) {
  std::vector<Joint> inner = part.joints_;
  inner.front().before = joints_[first].before;
  inner.back().after = joints_[last].after;
  std::vector<std::size_t> before;
  for (const std::size_t count : part.points_before_) before.push_back(points_before_[first] + count);
  const auto put = [&](auto& list, const auto& with, std::size_t end) {
    list.erase(list.begin() + std::ptrdiff_t(first), list.begin() + std::ptrdiff_t(end));
    list.insert(list.begin() + std::ptrdiff_t(first), with.begin(), with.end());
  };
  put(joints_, inner, last + 1);
  put(points_before_, before, last + 1);
  put(errors_, part.errors_, last);
}

double SmoothSpline::note_errors(std::span<const Vector2> points, const std::vector<Place>& places,
                                 double resolution) {
  points_before_.assign(joints_.size(), 0);
  for (const Place& place : places) ++points_before_[place.segment + 1];
  for (std::size_t j = 1; j < joints_.size(); ++j) points_before_[j] += points_before_[j - 1];
  errors_.clear();
  std::vector<Vector2> line;
  for (std::size_t i = 0; i < segments(); ++i) {
    line.assign(1, beside_joint(points, i));
    line.insert(line.end(), points.begin() + std::ptrdiff_t(points_before_[i]),
                points.begin() + std::ptrdiff_t(points_before_[i + 1]));
    line.push_back(beside_joint(points, i + 1));
    const CubicBezier curve = segment(i);
    errors_.push_back(certified_distance(line, curve, resolution));
  }
  return *std::max_element(errors_.begin(), errors_.end());
}

Vector2 SmoothSpline::beside_joint(std::span<const Vector2> points, std::size_t joint) const {
  const std::size_t next = points_before_[joint];
  if (joint == 0 || next == 0) return points.front();
  if (joint == segments() || next == points.size()) return points.back();
  const Vector2 way = points[next] - points[next - 1];
  const double part = (joints_[joint].place - points[next - 1]).dot(way) / way.squaredNorm();
  return points[next - 1] + std::clamp(part, 0.0, 1.0) * way;
}

}  // namespace icome::sketch
