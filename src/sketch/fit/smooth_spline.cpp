#include "sketch/fit/smooth_spline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sketch/fit/fit_error.h"

namespace icome::sketch {
namespace {

constexpr std::size_t kUnknowns = 5;   // of a joint: handle before, x, y, direction, handle after
constexpr double kAlongWeight = 0.03;  // of distance along the curve beside that across it
constexpr int kFirstPower = 2;         // of distances: all count alike
constexpr int kPowerOfRound = 1;       // by which it grows
constexpr int kPowerOfStop = 4;        // the same, where no step helps
constexpr int kMostPower = 16;
constexpr double kLeastWeight = 1e-3;  // of a point that the curve goes through, beside the farthest
constexpr int kStepsAtFirst = 8;       // of Newton's method, to find where points belong on the curve
constexpr int kStepsAgain = 2;
constexpr double kShortened = 0.1;  // of a handle, at most this is left by a round
constexpr double kFirstDamping = 1e-3;
constexpr double kMoreDamping = 8.0;   // after each attempt
constexpr double kLessDamping = 0.02;  // after one that was better
constexpr int kMostAttempts = 7;
constexpr double kAim = 0.95;         // of what is enough, since points do not tell all
constexpr double kResolution = 0.02;  // of the distance that is enough, by which certified ones may be above
constexpr double kHopeless = 2.0;     // of what is enough, after the rounds of hope
constexpr double kSlow = 0.995;  // a round that leaves more than this of the greatest distance is the last

Vector2 direction_of(double angle) { return {std::cos(angle), std::sin(angle)}; }
Vector2 across(const Vector2& way) { return {-way.y(), way.x()}; }

double angle_of(const Vector2& way) { return std::atan2(way.y(), way.x()); }

/// The direction halfway between two, by the shorter turn.
double mean_direction(const Vector2& a, const Vector2& b) {
  const Vector2 sum = a + b;
  return sum.norm() > 1e-6 ? angle_of(sum) : angle_of(a);
}

/// Takes much less time than std::pow().
double raised(double base, int power) {
  double result = 1.0;
  for (; power > 0; power /= 2, base *= base)
    if (power % 2 == 1) result *= base;
  return result;
}

/// A cubic by the powers of t: takes less time where many places of it are asked for.
class Powers {
 public:
  explicit Powers(const CubicBezier& curve)
      : constant_(curve.points[0]),
        linear_(3.0 * (curve.points[1] - curve.points[0])),
        square_(3.0 * (curve.points[2] - 2.0 * curve.points[1] + curve.points[0])),
        cube_(curve.points[3] - curve.points[0] + 3.0 * (curve.points[1] - curve.points[2])) {}

  Vector2 at(double t) const { return constant_ + t * (linear_ + t * (square_ + t * cube_)); }
  Vector2 derivative(double t) const { return linear_ + t * (2.0 * square_ + 3.0 * t * cube_); }
  Vector2 second_derivative(double t) const { return 2.0 * square_ + 6.0 * t * cube_; }

 private:
  Vector2 constant_;
  Vector2 linear_;
  Vector2 square_;
  Vector2 cube_;
};

}  // namespace

/// A point of the way, and where the curve is nearest to it.
struct SmoothSpline::Place {
  std::size_t segment;
  double t;
  double distance = 0.0;
};

/// The part that points beside one segment have in the normal equations. Unknowns are x, y, direction and
/// handle of the first joint; handle, x, y and direction of the last.
class SmoothSpline::Equations {
 public:
  Equations(const SmoothSpline& spline, std::size_t segment, const Beyond& beyond)
      : curve_(spline.segment(segment)),
        from_(spline.joints_[segment]),
        to_(spline.joints_[segment + 1]),
        leaves_(direction_of(from_.direction)),
        arrives_(direction_of(to_.direction)) {
    const bool is_first = segment == 0;
    const bool is_last = segment + 1 == spline.segments();
    if (is_first) free_.head<2>().setZero();
    if (is_first && beyond.first) free_[2] = 0.0;
    if (is_last) free_.segment<2>(5).setZero();
    if (is_last && beyond.last) free_[7] = 0.0;
  }

  void add(const Vector2& point, double t, double weight) {
    const Vector2 away = point - curve_.at(t);
    Vector2 along = curve_.derivative(t);
    const double speed = along.norm();
    if (speed > 0.0) along /= speed;
    add_row(t, across(along), across(along).dot(away), weight);
    add_row(t, along, along.dot(away), kAlongWeight * weight);
  }

  void add_to(BandSystem& system, std::size_t first_unknown) const {
    for (std::size_t i = 0; i < 8; ++i) {
      system.add_right(first_unknown + i, right_[Eigen::Index(i)]);
      for (std::size_t j = 0; j <= i; ++j)
        system.add(first_unknown + i, first_unknown + j, left_(Eigen::Index(i), Eigen::Index(j)));
    }
  }

 private:
  using Row = Eigen::Matrix<double, 8, 1>;

  /// The distance `miss` in a direction is to be gone by moves of the place at t.
  void add_row(double t, const Vector2& way, double miss, double weight) {
    const double u = 1.0 - t;
    const double b1 = 3.0 * t * u * u;
    const double b2 = 3.0 * t * t * u;
    const double first = u * u * u + b1;
    const double last = b2 + t * t * t;
    Row row;
    row << first * way.x(), first * way.y(), b1 * from_.after * way.dot(across(leaves_)),
        b1 * way.dot(leaves_), -b2 * way.dot(arrives_), last * way.x(), last * way.y(),
        -b2 * to_.before * way.dot(across(arrives_));
    row.array() *= free_.array();
    const Row weighed = weight * row;
    left_.noalias() += weighed * row.transpose();
    right_ += miss * weighed;
  }

  Powers curve_;
  const Joint& from_;
  const Joint& to_;
  Vector2 leaves_;
  Vector2 arrives_;
  Row free_ = Row::Ones();  // 0 where an unknown stays as it is
  Eigen::Matrix<double, 8, 8> left_ = Eigen::Matrix<double, 8, 8>::Zero();
  Row right_ = Row::Zero();
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
  std::vector<Powers> curves;
  for (std::size_t i = 0; i < segments(); ++i) curves.emplace_back(segment(i));
  double greatest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Place& place = places[i];
    for (int step = 0; step < steps; ++step) {
      const Powers& curve = curves[place.segment];
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
    place.distance = (curves[place.segment].at(place.t) - points[i]).norm();
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
double sum_of_powers(const Places& places, double scale, int power) {
  double sum = 0.0;
  for (const auto& place : places) sum += raised(place.distance / scale, power);
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
  int power = kFirstPower;    // of distances, whose sum a round lessens
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
bool SmoothSpline::take_step(const BandSystem& system, Approach& approach, double scale) {
  const double before = sum_of_powers(approach.places, scale, approach.power);
  for (int attempt = 0; attempt < kMostAttempts; ++attempt) {
    const std::vector<double> step = system.solve(approach.damping);
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

/// The normal equations of a round: points count by a power of their distance.
void SmoothSpline::set_up(BandSystem& system, const Beyond& beyond, const Approach& approach) const {
  system.clear();
  for (std::size_t i = 0; i < system.size(); ++i) system.add(i, i, 1e-9);
  std::size_t i = 0;
  while (i < approach.places.size()) {
    const std::size_t segment = approach.places[i].segment;
    Equations equations(*this, segment, beyond);
    for (; i < approach.places.size() && approach.places[i].segment == segment; ++i) {
      const Place& place = approach.places[i];
      equations.add(approach.points[i], place.t,
                    raised(place.distance / approach.greatest, approach.power - 2) + kLeastWeight);
    }
    equations.add_to(system, kUnknowns * segment + 1);
  }
}

/// One round, after which great distances weigh more. False where more rounds are of no use.
bool SmoothSpline::run_round(BandSystem& system, const Beyond& beyond, Approach& approach) {
  const double scale = approach.greatest;
  set_up(system, beyond, approach);
  const bool is_last_power = approach.power >= kMostPower;
  const bool better = take_step(system, approach, scale);
  approach.keep_if_best(*this);
  if (is_last_power && !(better && approach.greatest <= kSlow * scale)) return false;
  approach.power = std::min(kMostPower, approach.power + (better ? kPowerOfRound : kPowerOfStop));
  if (!better) approach.damping = kFirstDamping;
  return true;
}

double SmoothSpline::bring_near(std::span<const Vector2> points, const Beyond& beyond, double enough,
                                const Effort& effort) {
  Approach approach = begin_approach(points);
  BandSystem system(kUnknowns * joints_.size());
  for (int round = 0; round < effort.most_rounds; ++round) {
    if (!(approach.least > kAim * enough) || !std::isfinite(approach.greatest)) break;
    if (round >= effort.rounds_of_hope && approach.least > kHopeless * enough) break;
    if (!run_round(system, beyond, approach)) break;
  }
  joints_ = std::move(approach.best);
  return note_errors(points, approach.best_places, beyond, kResolution * enough);
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
                                 const Beyond& beyond, double resolution) {
  points_before_.assign(joints_.size(), 0);
  for (const Place& place : places) ++points_before_[place.segment + 1];
  for (std::size_t j = 1; j < joints_.size(); ++j) points_before_[j] += points_before_[j - 1];
  errors_.clear();
  std::vector<Vector2> line;
  Vector2 start = beyond.first.value_or(points.front());
  for (std::size_t i = 0; i < segments(); ++i) {
    const bool is_last = i + 1 == segments();
    const Vector2 end = is_last ? beyond.last.value_or(points.back()) : place_of_way(points, i + 1);
    line.assign(1, start);
    line.insert(line.end(), points.begin() + std::ptrdiff_t(points_before_[i]),
                points.begin() + std::ptrdiff_t(points_before_[i + 1]));
    line.push_back(end);
    errors_.push_back(certified_distance(line, segment(i), resolution));
    start = end;
  }
  return *std::max_element(errors_.begin(), errors_.end());
}

Vector2 SmoothSpline::place_of_way(std::span<const Vector2> points, std::size_t joint) const {
  const std::size_t next = points_before_[joint];
  if (next == 0) return points.front();
  if (next == points.size()) return points.back();
  const Vector2 way = points[next] - points[next - 1];
  const double part = (joints_[joint].place - points[next - 1]).dot(way) / way.squaredNorm();
  return points[next - 1] + std::clamp(part, 0.0, 1.0) * way;
}

}  // namespace icome::sketch
