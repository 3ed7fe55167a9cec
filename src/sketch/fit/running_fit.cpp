#include "sketch/fit/running_fit.h"

#include <algorithm>
#include <cmath>

namespace icome::sketch {
namespace {

constexpr double kNear = 0.85;           // of the distance allowed: knots do not tell all of the way
constexpr double kConeTolerance = 0.06;  // of the distance allowed
constexpr double kMoved = 1e-3;          // a pen that moves less is at rest
constexpr double kKeptPart = 0.8;        // of a segment's t when it is finished; the rest is shared
constexpr std::size_t kMostKnots = 40;   // of a segment: what a point costs at most
constexpr double kSmallHandle = 0.5;     // turns a curve aside from a straight line by less than is allowed
constexpr double kCornerAngle = 0.87;    // rad
constexpr double kCornerReach = 3.0;     // on either side of a corner
constexpr double kLeastReach = 1.0;
constexpr double kCutOff = 0.7;        // by which the corner of two straight pieces may be cut off
constexpr double kLeastTurn = 0.02;    // of its sine: flatter ones are cut off no farther
constexpr double kRoundHandle = 0.55;  // of the way to the corner, for a curve that is nearly an arc

double turn_between(const Vector2& a, const Vector2& b) {
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

/// A cubic that leaves in a direction and soon runs straight to its end.
CubicBezier nearly_straight(const Vector2& start, const Vector2& direction, const Vector2& end) {
  const Vector2 way = end - start;
  return {{start, start + std::min(kSmallHandle, way.norm() / 3.0) * direction, end - way / 3.0, end}};
}

}  // namespace

RunningFit::RunningFit(const Vector2& start) : cone_(kConeTolerance) { begin_segment(start, {}); }

void RunningFit::Way::add(const Vector2& point) {
  const double length = length_to(point);
  moments.add(knots.back().point, knots.back().along, point, length);
  knots.push_back({point, length});
}

double RunningFit::Way::length_to(const Vector2& end) const {
  return knots.back().along + (end - knots.back().point).norm();
}

void RunningFit::begin_segment(const Vector2& start, const std::optional<Vector2>& direction) {
  start_along_ = finished_.empty() ? 0.0 : finished_.back().to;
  start_ = start;
  last_ = start;
  along_ = start_along_;
  direction_ = direction;
  way_.knots.assign(1, {start, 0.0});
  way_.moments = {};
  current_ = CubicBezier::line(start, start);
  cone_.begin(start);
}

void RunningFit::add(const Vector2& point) {
  if ((point - last_).norm() < kMoved) return;
  while (!try_to_reach(point)) finish_segment(point);
}

bool RunningFit::try_to_reach(const Vector2& point) {
  // From the start alone every point can be reached, so that the loop of add() ends.
  if (last_ != start_ && !cone_.reaches(point)) {
    way_.add(last_);
    cone_.begin(last_);
    cone_.reaches(point);
  } else if (last_ == start_) {
    cone_.reaches(point);
  }
  const double length = way_.length_to(point);
  CurveMoments moments = way_.moments;
  moments.add(way_.knots.back().point, way_.knots.back().along, point, length);
  CubicBezier cubic = moments.cubic(start_, point, length, direction_);
  if (!is_near(cubic, point, length)) {
    if (way_.knots.size() > 1) return false;
    cubic = direction_ ? nearly_straight(start_, *direction_, point) : CubicBezier::line(start_, point);
  }
  current_ = cubic;
  last_ = point;
  along_ = start_along_ + length;
  return true;
}

bool RunningFit::is_near(const CubicBezier& cubic, const Vector2& end, double length) const {
  if (way_.knots.size() > kMostKnots) return false;
  const auto near = [&](const Vector2& point, double along) {
    double t = nearer_t(cubic, point, along / length);
    t = nearer_t(cubic, point, t);
    return (cubic.at(t) - point).squaredNorm() <= kNear * kNear;
  };
  // The last knots are where a curve that no longer fits is farthest away.
  Vector2 next = end;
  double next_along = length;
  for (std::size_t i = way_.knots.size(); i-- > 0;) {
    const Knot& knot = way_.knots[i];
    if (!near(0.5 * (knot.point + next), 0.5 * (knot.along + next_along))) return false;
    if (i > 0 && !near(knot.point, knot.along)) return false;
    next = knot.point;
    next_along = knot.along;
  }
  return true;
}

void RunningFit::keep(const CubicBezier& curve, double length) {
  finished_.push_back({curve, start_along_, start_along_ + length});
}

void RunningFit::finish_segment(const Vector2& next) {
  if (finish_at_corner()) return;
  const double length = along_ - start_along_;
  const bool is_straight = way_.knots.size() == 1 || (way_.knots.size() == 2 && way_.knots[1].point == last_);
  if (is_straight) {
    finish_at_last(next);
    return;
  }
  // The next segment shares the last part of the way with this segment, so that its direction has a ground.
  const auto [kept, rest] = current_.split(kKeptPart);
  std::vector<Knot> knots;
  for (const Knot& knot : way_.knots)
    if (knot.along > kKeptPart * length) knots.push_back(knot);
  const Vector2 last = last_;
  keep(kept, kKeptPart * length);
  begin_segment(kept.points[3], kept.end_direction());
  for (const Knot& knot : knots) way_.add(knot.point);
  cone_.begin(way_.knots.back().point);
  cone_.reaches(last);
  current_ = rest;
  last_ = last;
  along_ = start_along_ + way_.length_to(last);
}

/// The segment lies beside one straight piece, and the next point is off it: the way turns at the last point.
void RunningFit::finish_at_last(const Vector2& next) {
  const double length = along_ - start_along_;
  const Vector2 on = (next - last_).normalized();
  const double turn = turn_between(current_.end_direction(), on);
  if (turn > kCornerAngle && std::min(length, (next - last_).norm()) > kLeastReach) {
    ++corners_;
    keep(current_, length);
    begin_segment(last_, {});
    return;
  }
  // Cut off the angle by a short curve that goes from one direction into the other.
  const double beside = std::min(kCutOff / std::max(std::sin(0.5 * turn), kLeastTurn),
                                 0.4 * std::min(length, (next - last_).norm()));
  const auto [kept, rest] = current_.split(1.0 - beside / length);
  const Vector2 end = last_ + beside * on;
  const Vector2& start = kept.points[3];
  keep(kept, length - beside);
  start_along_ += length - beside;
  keep({{start, start + kRoundHandle * beside * kept.end_direction(), end - kRoundHandle * beside * on, end}},
       2.0 * beside);
  begin_segment(end, on);
}

bool RunningFit::finish_at_corner() {
  const double length = along_ - start_along_;
  const auto& knots = way_.knots;
  for (std::size_t i = knots.size(); i-- > 1;) {
    const double reach = std::min({kCornerReach, knots[i].along, length - knots[i].along});
    if (length - knots[i].along > 4.0 * kCornerReach) break;
    if (reach < kLeastReach) continue;
    const auto at = [&](double along) -> Vector2 {
      std::size_t after = 1;
      while (after < knots.size() && knots[after].along < along) ++after;
      const Vector2 end = after < knots.size() ? knots[after].point : last_;
      const double end_along = after < knots.size() ? knots[after].along : length;
      const Knot& from = knots[after - 1];
      return from.point + (along - from.along) / (end_along - from.along) * (end - from.point);
    };
    const Vector2 before = knots[i].point - at(knots[i].along - reach);
    const Vector2 behind = at(knots[i].along + reach) - knots[i].point;
    if (turn_between(before, behind) < kCornerAngle) continue;
    CurveMoments moments;
    for (std::size_t k = 1; k <= i; ++k)
      moments.add(knots[k - 1].point, knots[k - 1].along, knots[k].point, knots[k].along);
    const Knot corner = knots[i];
    std::vector<Vector2> rest;
    for (std::size_t k = i + 1; k < knots.size(); ++k) rest.push_back(knots[k].point);
    rest.push_back(last_);
    keep(moments.cubic(start_, corner.point, corner.along, direction_), corner.along);
    ++corners_;
    begin_segment(corner.point, {});
    for (const Vector2& point : rest) add(point);
    return true;
  }
  return false;
}

}  // namespace icome::sketch
