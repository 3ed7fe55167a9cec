#include "sketch/feel/resistance.h"

#include <cmath>

namespace icome::sketch {
namespace {

// Two saturating parts: one that brings the force to 0.2 N within a millimetre, and one that takes a hand's
// way to bring it near 1 N.
constexpr double kQuickForce = 0.22;     // N
constexpr double kQuickLength = 0.0003;  // m
constexpr double kSlowForce = 0.78;      // N
constexpr double kSlowLength = 0.04;     // m

/// A force of that strength (N) against a direction of any length; none where it has none.
Vector2 against(const Vector2& direction, double strength) {
  const double length = direction.norm();
  if (!(length > 0.0)) return Vector2::Zero();
  return -strength / length * direction;
}

}  // namespace

double resistance(double length) {
  return kQuickForce * -std::expm1(-length / kQuickLength) + kSlowForce * -std::expm1(-length / kSlowLength);
}

Vector2 pull_force(const Vector2& pull) { return against(pull, resistance(pull.norm())); }

Vector2 move_force(const Vector2& move, std::size_t holding_points) {
  return against(move, resistance(double(holding_points) * move.norm()));
}

Vector2 turn_force(const Vector2& pen, const Vector2& centre, double angle,
                   std::span<const Vector2> holding) {
  double ways = 0.0;
  for (const Vector2& point : holding) ways += (point - centre).norm() * std::abs(angle);
  const Vector2 arm = pen - centre;
  const Vector2 with_the_turn = std::copysign(1.0, angle) * Vector2(-arm.y(), arm.x());
  return against(with_the_turn, resistance(ways));
}

Vector2 scale_force(const Vector2& pen, const Vector2& centre, double factor,
                    std::span<const Vector2> holding) {
  double ways = 0.0;
  for (const Vector2& point : holding) ways += (point - centre).norm() * std::abs(factor - 1.0);
  return against(std::copysign(1.0, factor - 1.0) * (pen - centre), resistance(ways));
}

Vector2 connect_force(const Vector2& pen, const Vector2& end, double within) {
  const Vector2 way = pen - end;
  const double part = way.norm() / within;
  if (!(part < 1.0)) return Vector2::Zero();
  const double fading = (1.0 - part * part) * (1.0 - part * part);
  return against(way, fading * resistance(way.norm()));
}

}  // namespace icome::sketch
