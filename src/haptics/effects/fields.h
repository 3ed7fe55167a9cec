#pragma once
#include <functional>

#include "haptics/effects/effect.h"
#include "haptics/effects/surface_force.h"

namespace icome::haptics {

/// A constant force, equal everywhere, such as weight.
class ConstantForce final : public Effect {
 public:
  explicit ConstantForce(const Vector3& newtons) : force_(newtons) {}
  Vector3 force(const EffectInput& input) override;

 private:
  Vector3 force_;  // N
};

/// A force (N) that is a function of place (m) and time (s), such as wind or a magnet.
class ForceField final : public Effect {
 public:
  using Function = std::function<Vector3(const Vector3& position, double time)>;
  /// `function` is not empty and real-time safe: the servo calls it.
  explicit ForceField(Function function);
  Vector3 force(const EffectInput& input) override;

 private:
  Function function_;
};

/// Attracts the tip to a point from within a radius: F(r) = k r (1 - (r/R)^2)^2, which begins at the rim
/// without a jump in force or slope and is a spring of k at the centre. The strongest pull is 0.286 k R,
/// at r = R/sqrt(5). It gives back all the energy it takes but for a little damping, k leak_seconds() at the
/// centre and none at the rim, which pays for what the hold of a tick leaks. k is kept within what is
/// stable for the device and the tick.
class GravityWell final : public Effect {
 public:
  /// `radius` > 0 in m, `stiffness` k at the centre in N/m.
  GravityWell(const Vector3& centre, double radius, double stiffness);
  /// The stiffness (N/m) at the centre of a well of `radius` > 0 (m) whose strongest pull is `force` (N).
  static double stiffness_of(double radius, double force);
  Vector3 force(const EffectInput& input) override;
  double mass_needed(double device_mass, double dt) const override {
    return haptics::mass_needed(stiffness_, 0.0, device_mass, dt);
  }
  Reach reach() const override { return {.centre = centre_, .radius = radius_}; }
  std::string capped(double device_mass, double dt) const override {
    return capped_spring(device_mass, dt, stiffness_, 0.0);
  }

 private:
  Vector3 centre_;    // m
  double radius_;     // m
  double stiffness_;  // N/m
};

/// A round recess, the target aid of Oakley et al. (2000): on its floor the tip is free, around it a
/// slope pushes it back towards the axis, F(r) = peak sin^2(pi (r - floor)/(rim - floor)), outside it is
/// free again. To leave, the hand pays peak (rim - floor)/2 joule, and gets it back when it falls in, but for
/// damping that pays for what the hold of a tick leaks on the slope. The slope's stiffness,
/// peak pi/(rim - floor), is kept within what is stable for the device and the tick: the peak may be lower.
struct RecessSettings {
  Vector3 centre = Vector3::Zero();  // m, any point on the axis
  Vector3 axis = Vector3::UnitZ();   // any length but 0; no force along it
  double floor_radius = 0.008;       // m
  double rim_radius = 0.012;         // m, > floor_radius
  double peak_force = 1.0;           // N, usually 0.3 to 2
};

class Recess final : public Effect {
 public:
  explicit Recess(const RecessSettings& settings);
  Vector3 force(const EffectInput& input) override;
  double mass_needed(double device_mass, double dt) const override {
    return haptics::mass_needed(slope_stiffness(), 0.0, device_mass, dt);
  }
  Reach reach() const override { return {settings_.centre, settings_.axis, settings_.rim_radius}; }
  std::string capped(double device_mass, double dt) const override {
    return capped_spring(device_mass, dt, slope_stiffness(), 0.0);
  }

 private:
  double slope_stiffness() const;  // N/m, where the slope rises most

  RecessSettings settings_;  // axis normalised
};

}  // namespace icome::haptics
