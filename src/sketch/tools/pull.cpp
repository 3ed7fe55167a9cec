#include "sketch/tools/pull.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace icome::sketch {
namespace {

constexpr double kNearAnEnd = 0.05;     // t up to which the thesis moves the joint
constexpr double kSmoothJoint = 0.002;  // rad, by which directions of a smooth joint may differ

/// A curve while one of its segments is changed, and what its neighbours were like before.
class Pulling {
 public:
  Pulling(const Curve& curve, std::size_t segment) : curve_(curve), segment_(segment) {
    if (before()) smooth_before_ = is_smooth(curve.segments[*before()], curve.segments[segment]);
    if (after()) smooth_after_ = is_smooth(curve.segments[segment], curve.segments[*after()]);
  }

  CubicBezier& pulled() { return curve_.segments[segment_]; }

  /// Moves the joint before the segment, with the handle of the neighbour.
  void move_start(const Vector2& by) {
    pulled().points[0] += by;
    if (!before()) return;
    curve_.segments[*before()].points[3] = pulled().points[0];
    curve_.segments[*before()].points[2] += by;
  }

  void move_end(const Vector2& by) {
    pulled().points[3] += by;
    if (!after()) return;
    curve_.segments[*after()].points[0] = pulled().points[3];
    curve_.segments[*after()].points[1] += by;
  }

  /// Turns the handles of neighbours about their joints until they are smooth again, where they were.
  Curve finish() {
    if (smooth_before_) {
      Vector2& handle = curve_.segments[*before()].points[2];
      handle = turned(pulled().points[0], handle, -pulled().start_direction());
    }
    if (smooth_after_) {
      Vector2& handle = curve_.segments[*after()].points[1];
      handle = turned(pulled().points[3], handle, pulled().end_direction());
    }
    return std::move(curve_);
  }

 private:
  static bool is_smooth(const CubicBezier& first, const CubicBezier& second) {
    const Vector2 a = first.end_direction();
    const Vector2 b = second.start_direction();
    return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) < kSmoothJoint;
  }

  static Vector2 turned(const Vector2& joint, const Vector2& handle, const Vector2& direction) {
    return direction.isZero() ? handle : joint + (handle - joint).norm() * direction;
  }

  std::optional<std::size_t> before() const {
    if (segment_ > 0) return segment_ - 1;
    return curve_.closed && curve_.segments.size() > 1 ? std::optional(curve_.segments.size() - 1)
                                                       : std::nullopt;
  }
  std::optional<std::size_t> after() const {
    if (segment_ + 1 < curve_.segments.size()) return segment_ + 1;
    return curve_.closed && curve_.segments.size() > 1 ? std::optional<std::size_t>(0) : std::nullopt;
  }

  Curve curve_;
  std::size_t segment_;
  bool smooth_before_ = false;
  bool smooth_after_ = false;
};

void pull_as_thesis(Pulling& pulling, double t, const Vector2& by) {
  CubicBezier& curve = pulling.pulled();
  if (t <= kNearAnEnd) {
    pulling.move_start(by);
    curve.points[1] += by;
  } else if (t >= 1.0 - kNearAnEnd) {
    pulling.move_end(by);
    curve.points[2] += by;
  } else {
    const Vector2 share = by / (3.0 * t * (1.0 - t));
    curve.points[1] += share;
    curve.points[2] += share;
  }
}

/// The shares of a ring, one segment that is closed: both ends are one point with the share of both.
void pull_exactly(Pulling& pulling, double t, const Vector2& by, bool is_ring) {
  const double u = 1.0 - t;
  double share[4] = {u * u * u, 3.0 * t * u * u, 3.0 * t * t * u, t * t * t};
  if (is_ring) share[0] = share[3] = share[0] + share[3];
  double squares = 0.0;
  for (const double s : share) squares += s * s;
  if (is_ring) squares -= share[3] * share[3];
  CubicBezier& curve = pulling.pulled();
  pulling.move_start(share[0] / squares * by);
  curve.points[1] += share[1] / squares * by;
  curve.points[2] += share[2] / squares * by;
  pulling.move_end(share[3] / squares * by);
}

}  // namespace

Curve pulled(const Curve& curve, double place, const Vector2& by, PullRule rule) {
  const double whole = std::clamp(std::floor(place), 0.0, curve.end() - 1.0);
  const double t = place - whole;
  Pulling pulling(curve, std::size_t(whole));
  if (curve.closed && curve.segments.size() == 1 && (t <= kNearAnEnd || t >= 1.0 - kNearAnEnd)) {
    // One segment whose ends are one point: both move.
    for (Vector2& point : pulling.pulled().points) point += by;
    return pulling.finish();
  }
  if (rule == PullRule::Thesis) {
    pull_as_thesis(pulling, t, by);
  } else {
    pull_exactly(pulling, t, by, curve.closed && curve.segments.size() == 1);
  }
  return pulling.finish();
}

}  // namespace icome::sketch
