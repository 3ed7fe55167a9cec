#include "haptics/effects/grip.h"

#include <algorithm>
#include <cmath>

#include "haptics/effects/fields.h"
#include "haptics/effects/surface_force.h"

namespace icome::haptics {
namespace {

/// Distance over which the least pull is faded in.
constexpr double kSoftStart = 0.002;  // m

double smooth_step(double t) {
  const double x = std::clamp(t, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// The pull back against the displacement of the held thing, in its free directions only.
Vector3 resistance(const GripFeel& feel, const Vector3& way) {
  const Vector3 taken = feel.freedom * way;
  const double distance = taken.norm();
  if (distance <= 0.0) return Vector3::Zero();
  return -pull_back(feel, distance) / distance * taken;
}

/// Stiffness and damping that are stable for the device and the tick; see SpringSettings.
struct Hold {
  double stiffness, damping;

  Hold(const SpringSettings& settings, const EffectInput& input)
      : stiffness(stable_stiffness(input.device_mass, input.dt, settings.stiffness)),
        damping(stable_damping(stiffness, input.device_mass, input.dt, settings.damping)) {}
};

Vector3 guidance(const GripFeel& feel, const Hold& hold, const EffectInput& input) {
  const base::Matrix3 kept = base::Matrix3::Identity() - feel.freedom;
  return kept * (hold.stiffness * (feel.start - input.position) - hold.damping * input.velocity);
}

/// Damped on the way in only: a wall does not hold back a tip that leaves it.
Vector3 stop_force(const GripStop& stop, const Hold& hold, const EffectInput& input) {
  const double depth = (stop.point - input.position).dot(stop.normal);
  if (!(depth > 0.0)) return Vector3::Zero();
  const double inwards = std::max(0.0, -input.velocity.dot(stop.normal));
  return (hold.stiffness * depth + hold.damping * inwards) * stop.normal;
}

}  // namespace

double pull_back(const GripFeel& feel, double distance) {
  const double rise = 1.0 - std::exp(-distance / feel.reach);
  return feel.least_pull * smooth_step(distance / kSoftStart) + (feel.most_pull - feel.least_pull) * rise;
}

/// Counts as if guidance, a stop and the well pulled along the same line.
double grip_mass_needed(const GripFeel& feel, double device_mass, double dt) {
  if (!feel.holds) return 0.0;
  const double well = feel.well ? feel.well->stiffness : 0.0;
  return mass_needed(2.0 * feel.hold.stiffness + well, 2.0 * feel.hold.damping, device_mass, dt);
}

Vector3 grip_force(const GripFeel& feel, const EffectInput& input) {
  if (!feel.holds) return Vector3::Zero();
  const Hold hold(feel.hold, input);
  Vector3 force = feel.weight + resistance(feel, input.position - feel.start) + guidance(feel, hold, input);
  for (std::size_t i = 0; i < std::min(feel.stop_count, feel.stops.size()); ++i)
    force += stop_force(feel.stops[i], hold, input);
  if (feel.well) {
    // The centre is the nearest place of the well's line or plane.
    const Vector3 nearest = input.position - feel.well->across * (input.position - feel.well->centre);
    GravityWell well(nearest, feel.well->radius, feel.well->stiffness);
    force += well.force(input);
  }
  return force;
}

}  // namespace icome::haptics
