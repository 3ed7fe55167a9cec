#include <algorithm>
#include <cmath>

#include "geometry/implicit/implicit_walk.h"

namespace icome::geometry {
namespace {

using base::Vector3;

/// One of the two smooth surfaces that meet in a crease, as its tangent plane.
struct CreaseSide {
  Vector3 normal;  // unit
  Vector3 point;
  double height;  // of `point` above the surface

  double height_of(const Vector3& other) const { return height + normal.dot(other - point); }
};

std::optional<CreaseSide> crease_side(const Formula& formula, const Vector3& point, double time) {
  const Formula::Slope at = formula.slope(point, time);
  const double steepness = at.gradient.norm();
  if (!(steepness > 0.0) || !std::isfinite(steepness) || !std::isfinite(at.value)) return std::nullopt;
  return CreaseSide{at.gradient / steepness, point, at.value / steepness};
}

/// The two sides of a crease, as seen from places a little off it.
class Crease {
 public:
  Crease(const CreaseSide& first, const CreaseSide& second) : one(first), other(second) {}

  CreaseSide one, other;
  bool between = false;  // both have been seen from the last place
  bool valley = false;   // the solid's sides meet in a groove, not in an edge

  double cosine() const { return one.normal.dot(other.normal); }
  Vector3 direction() const { return one.normal.cross(other.normal).normalized(); }

  /// The shortest way from `point` onto both planes.
  Vector3 onto(const Vector3& point) const {
    const double h = one.height_of(point), k = other.height_of(point), c = cosine(), det = 1.0 - c * c;
    return ((c * k - h) * one.normal + (c * h - k) * other.normal) / det;
  }

  /// Is `pull` held by the two sides of a groove, or is its origin the point of an edge nearest to it?
  bool holds(const Vector3& pull) const {
    const double sign = valley ? -1.0 : 1.0;
    const double p = sign * pull.dot(one.normal), q = sign * pull.dot(other.normal), c = cosine();
    return p >= c * q && q >= c * p;
  }

  /// Looks at both sides from `offset` away. In a groove the lower of the two functions counts, on an edge
  /// the higher one: towards one.normal - other.normal the first grows faster. If that shows only one side,
  /// the other is searched for half-way back to its last known point.
  bool look_from(const Formula& formula, const Vector3& point, double offset, double time) {
    const Vector3 apart = (one.normal - other.normal).normalized();
    const auto below = crease_side(formula, point - offset * apart, time);
    const auto above = crease_side(formula, point + offset * apart, time);
    if (!below || !above) return false;
    const bool one_below = is_one(*below), one_above = is_one(*above);
    (one_below ? one : other) = *below;
    (one_above ? one : other) = *above;
    between = one_below != one_above;
    valley = between && one_below;
    if (!between) {
      const auto back = crease_side(formula, 0.5 * (point + (one_below ? other : one).point), time);
      if (!back) return false;
      (is_one(*back) ? one : other) = *back;
    }
    return cosine() < 0.9999 && cosine() > -0.99;
  }

 private:
  bool is_one(const CreaseSide& side) const {
    return side.normal.dot(one.normal) > side.normal.dot(other.normal);
  }
};

}  // namespace

std::optional<ImplicitWalk::Leg> ImplicitWalk::crease_leg(const Place& from, const Vector3& goal,
                                                          double reach, Vector3& up) const {
  // Newton's method for this side would lead to the other side.
  const Vector3 pull = goal - from.point;
  const Vector3 ahead = pull - pull.dot(from.normal) * from.normal;
  const double length = ahead.norm();
  if (!(length > 0.0)) return std::nullopt;
  const auto beyond = crease_side(formula_, from.point + std::min(1.0, reach / length) * ahead, time_);
  if (!beyond) return std::nullopt;
  Crease crease({from.normal, from.point, 0.0}, *beyond);
  if (crease.cosine() > 0.9999 || crease.cosine() < -0.99) return std::nullopt;
  constexpr double kOffset = 1e-7, kArrived = 1e-12;  // of the size
  constexpr int kMostTurns = 12;
  Vector3 at = from.point;
  double last_pull = 0.0, last_move = 0.0;
  bool arrived = false;
  for (int i = 0; i < kMostTurns && !arrived; ++i) {
    const Vector3 direction = crease.direction();
    // The crease bends, and with it the pull along it: the last step tells how much (the secant method).
    const double pulled = direction.dot(goal - at);
    const double bends = last_move == 0.0 ? 1.0 : (last_pull - pulled) / last_move;
    const double along = std::clamp(pulled / std::clamp(bends, 0.05, 20.0), -0.5 * reach, 0.5 * reach);
    const Vector3 step = crease.onto(at) + along * direction;
    at += step;
    last_pull = pulled;
    last_move = along;
    if (!((at - from.point).squaredNorm() <= 4.0 * reach * reach)) return std::nullopt;
    if (!crease.look_from(formula_, at, kOffset * size_, time_)) return std::nullopt;
    arrived = step.norm() <= kArrived * size_;
  }
  const auto facing = normal(at);
  const bool on_it = crease.between && std::fabs(crease.one.height_of(at)) <= 1e-9 * size_;
  if (!facing || !on_it) return std::nullopt;
  up = (crease.one.normal + crease.other.normal).normalized();
  return Leg{{at, *facing}, arrived && crease.holds(goal - at)};
}

}  // namespace icome::geometry
