#pragma once
#include <vector>

#include "haptics/effects/effect.h"
#include "haptics/effects/surface_force.h"

namespace icome::haptics {

/// Stiffness and damping of a spring effect. Damping acts only in the directions in which the spring
/// does and is kept within what is stable for the device and the tick (stable_damping).
struct SpringSettings {
  double stiffness = 200.0;  // N/m, usually 50 to 500
  double damping = 1.0;      // N s/m, usually 0 to 5
};

/// Base of the spring effects.
class Spring : public Effect {
 public:
  double mass_needed(double device_mass, double dt) const override {
    return haptics::mass_needed(settings_.stiffness, settings_.damping, device_mass, dt);
  }
  std::string capped(double device_mass, double dt) const override {
    return capped_spring(device_mass, dt, settings_.stiffness, settings_.damping);
  }

 protected:
  explicit Spring(const SpringSettings& settings) : settings_(settings) {}
  /// The force (N) towards a place that is `offset` (m) from the tip, against the velocity (m/s) `resisted`.
  Vector3 pull(const Vector3& offset, const Vector3& resisted, const EffectInput& input) const;

 private:
  SpringSettings settings_;
};

/// Holds the tip at a point.
class PointSpring final : public Spring {
 public:
  PointSpring(const Vector3& point, const SpringSettings& settings) : Spring(settings), point_(point) {}
  Vector3 force(const EffectInput& input) override;
  Reach reach() const override { return {.centre = point_}; }

 private:
  Vector3 point_;  // m
};

/// Holds the tip on an endless line, along which it moves freely.
class LineSpring final : public Spring {
 public:
  /// The line through `point` (m) along `direction` (any length but 0).
  LineSpring(const Vector3& point, const Vector3& direction, const SpringSettings& settings);
  Vector3 force(const EffectInput& input) override;
  Reach reach() const override { return {.centre = point_, .axis = direction_}; }

 private:
  Vector3 point_;      // m
  Vector3 direction_;  // unit
};

/// Holds the tip on a plane, from both sides.
class PlaneSpring final : public Spring {
 public:
  /// The plane through `point` (m) with `normal` (any length but 0).
  PlaneSpring(const Vector3& point, const Vector3& normal, const SpringSettings& settings);
  Vector3 force(const EffectInput& input) override;
  Reach reach() const override { return {.centre = point_}; }

 private:
  Vector3 point_;   // m
  Vector3 normal_;  // unit
};

/// Holds the tip on a curve given as a polyline, along which it moves freely; beyond an end it is held at
/// the end. Each tick looks at every segment, about 10 ns each: keep to some hundred.
class CurveSpring final : public Spring {
 public:
  /// At least one point (m); equal neighbours do no harm. A closed curve repeats its first point.
  CurveSpring(std::vector<Vector3> points, const SpringSettings& settings);
  Vector3 force(const EffectInput& input) override;
  Reach reach() const override { return {.centre = points_.front()}; }

 private:
  std::vector<Vector3> points_;  // m
};

}  // namespace icome::haptics
