#include "sketch/feel/resistance.h"

#include <algorithm>
#include <cmath>

namespace icome::sketch {
namespace {

// Two saturating parts: one that brings the force to 0.2 N within a millimetre, and one that takes a hand's
// way to bring it near 1 N.
constexpr double kQuickForce = 0.22;     // N
constexpr double kQuickLength = 0.0003;  // m
constexpr double kSlowForce = 0.78;      // N
constexpr double kSlowLength = 0.04;     // m

constexpr double kNearCentre =
    0.5;  // of the arm when it was taken: nearer, forces of turns and scalings fade

/// A force of that strength (N) against a direction of any length; none where it has none.
Vector2 against(const Vector2& direction, double strength) {
  const double length = direction.norm();
  if (!(length > 0.0)) return Vector2::Zero();
  return -strength / length * direction;
}

/// Adds the parts of a force at one place.
class Summing {
 public:
  Summing(const ToolGrip& grip, const Vector2& pen) : grip_(grip), pen_(pen) {}

  void add_move() {
    const Vector2 way = pen_ - grip_.start;
    add(against(way, resistance(grip_.softness * grip_.holding * way.norm())), way.norm());
  }

  /// A torque by the angle, whose half has the translations of the holding points as chords.
  void add_turn() {
    const Vector2 before = grip_.start - grip_.centre, arm = pen_ - grip_.centre;
    const double taken_at = before.norm(), at = arm.norm();
    if (!(grip_.turned > 0.0) || !(taken_at > 0.0) || !(at > 0.0)) return;
    const double angle = std::atan2(before.x() * arm.y() - before.y() * arm.x(), before.dot(arm));
    const double translations = 2.0 * grip_.turned * std::abs(std::sin(0.5 * angle));
    const double near = kNearCentre * taken_at;
    const double lever = at >= near ? taken_at / at : taken_at * at / (near * near);
    const double strength =
        std::min(1.0, resistance(grip_.softness * translations) * std::abs(std::cos(0.5 * angle)) * lever);
    const Vector2 with_the_turn = std::copysign(1.0, angle) * Vector2(-arm.y(), arm.x());
    sum_.of_turn = against(with_the_turn, strength);
    add(sum_.of_turn, at * std::abs(angle));
  }

  void add_scaling() {
    const double taken_at = (grip_.start - grip_.centre).norm();
    const Vector2 arm = pen_ - grip_.centre;
    if (!(grip_.scaled > 0.0) || !(taken_at > 0.0)) return;
    const double more = arm.norm() / taken_at - 1.0;
    const double translations = grip_.scaled * std::abs(more);
    // At the centre itself the arm has no direction.
    const double fading = std::min(1.0, arm.norm() / (kNearCentre * taken_at));
    add(against(std::copysign(1.0, more) * arm, fading * resistance(grip_.softness * translations)),
        taken_at * std::abs(more));
  }

  void add_attraction() {
    if (!grip_.end || !(grip_.within > 0.0)) return;
    const Vector2 all = pen_ - *grip_.end;
    const Vector2 way = all - all.dot(grip_.free) * grip_.free;
    const double part = way.norm() / grip_.within;
    if (!(part < 1.0)) return;
    const double fading = (1.0 - part * part) * (1.0 - part * part);
    add(against(way, fading * resistance(grip_.softness * way.norm())), way.norm());
  }

  const ToolForce& sum() const { return sum_; }

 private:
  void add(const Vector2& force, double way) {
    sum_.force += force;
    if (way > 0.0) sum_.hardness += force.norm() / way;
  }

  const ToolGrip& grip_;
  const Vector2& pen_;
  ToolForce sum_;
};

}  // namespace

double resistance(double length) {
  return kQuickForce * -std::expm1(-length / kQuickLength) + kSlowForce * -std::expm1(-length / kSlowLength);
}

ToolForce tool_force(const ToolGrip& grip, const Vector2& pen) {
  Summing summing(grip, pen);
  summing.add_move();
  summing.add_turn();
  summing.add_scaling();
  summing.add_attraction();
  return summing.sum();
}

double greatest_hardness(const ToolGrip& grip) {
  const double arm = (grip.start - grip.centre).norm();
  const double by_arm = arm > 0.0 ? (grip.turned / (kNearCentre * kNearCentre) + grip.scaled) / arm : 0.0;
  return grip.softness * kHardness * (grip.holding + by_arm + (grip.end ? 1.0 : 0.0));
}

}  // namespace icome::sketch
