#include "devices/vrpn/remote_forces.h"

#include <algorithm>
#include <cmath>

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kCycle = 1'000'000;       // ns, of the loop that recovery cycles count
constexpr std::int32_t kLongestRecovery = 1000;  // cycles
constexpr double kRollingSpeed = 0.01;  // m/s, below which friction falls to none, so that it never jumps

double depth_behind(const Plane& plane, const Vector3& tip) { return -plane.normal.dot(tip) - plane.offset; }

/// The plane on its way from one place to another; share 0 to 1. The two face alike.
Plane between(const Plane& from, const Plane& to, double share) {
  Plane plane = to;
  plane.normal = ((1.0 - share) * from.normal + share * to.normal).normalized();
  plane.offset = (1.0 - share) * from.offset + share * to.offset;
  plane.spring = (1.0 - share) * from.spring + share * to.spring;
  return plane;
}

}  // namespace

bool tidy(Plane& plane, const RemoteForceSettings& settings) {
  if (!plane.normal.allFinite() || !std::isfinite(plane.offset) || !std::isfinite(plane.spring) ||
      !std::isfinite(plane.damper) || !std::isfinite(plane.dynamic_friction))
    return false;
  const double length = plane.normal.norm();
  if (length < 1e-6) {
    plane.normal.setZero();
    return true;
  }
  plane.normal /= length;
  plane.offset /= length;
  plane.spring = std::clamp(plane.spring * settings.spring_unit, 0.0, settings.max_stiffness);
  plane.damper = std::clamp(plane.damper * settings.spring_unit, 0.0, settings.max_damping);
  plane.dynamic_friction = std::clamp(plane.dynamic_friction, 0.0, 1.0);
  plane.recovery = std::clamp(plane.recovery, std::int32_t{1}, kLongestRecovery);
  return true;
}

bool tidy(ForceField& field, const RemoteForceSettings& settings) {
  if (!field.origin.allFinite() || !field.force.allFinite() || !field.jacobian.allFinite() ||
      !std::isfinite(field.radius))
    return false;
  field.radius = std::max(0.0, field.radius);
  const double strength = field.force.norm();
  if (strength > settings.max_force) field.force *= settings.max_force / strength;
  field.jacobian = field.jacobian.cwiseMax(-settings.max_stiffness).cwiseMin(settings.max_stiffness);
  return true;
}

Vector3 RemoteForces::force(const WantedForces& wanted, const PointerState& state, std::int64_t now) {
  Vector3 sum = Vector3::Zero();
  if (!state.position.allFinite() || !state.velocity.allFinite()) return sum;
  for (std::size_t slot = 0; slot < kMostClients; ++slot) {
    const ClientForces& forces = wanted.clients[slot];
    Client& client = clients_[slot];
    if (client.number != forces.client || state.jumped) client = {forces.client, {}};
    for (std::size_t i = 0; i < kPlanes; ++i) sum += push(client.walls[i], forces.planes[i], state, now);
    const Vector3 away = state.position - forces.field.origin;
    if (forces.field.radius > 0.0 && away.norm() <= forces.field.radius)
      sum += forces.field.force + forces.field.jacobian * away;
  }
  return sum;
}

void RemoteForces::change(Wall& wall, const Plane& last, const Plane& next, const PointerState& state,
                          std::int64_t now) {
  wall.changed = now;
  // Two planes that face apart have nothing between them: the later one is new.
  if (wall.there && last.normal.dot(next.normal) > 0.1) {
    wall.from = last;
    return;
  }
  const double depth = depth_behind(next, state.position);
  wall.there = true;
  wall.behind = depth > settings_.deepest;
  wall.from = next;
  wall.from.offset += std::max(0.0, depth);
}

Vector3 RemoteForces::push(Wall& wall, const ClientForces::PlaneSlot& slot, const PointerState& state,
                           std::int64_t now) {
  if (slot.plane.normal.isZero()) {
    wall.there = false;
    wall.revision = slot.revision;
    return Vector3::Zero();
  }
  const auto felt = [&](const Wall& it, const Plane& plane) {
    const double cycles = static_cast<double>(now - it.changed) / static_cast<double>(kCycle);
    return between(it.from, plane, std::clamp(cycles / plane.recovery, 0.0, 1.0));
  };
  if (slot.revision != wall.revision || !wall.there) {
    wall.revision = slot.revision;
    change(wall, wall.there ? felt(wall, wall.to) : Plane(), slot.plane, state, now);
    wall.to = slot.plane;
  }
  if (depth_behind(slot.plane, state.position) <= 0.0) wall.behind = false;
  const Plane plane = felt(wall, slot.plane);
  const double depth = depth_behind(plane, state.position);
  if (wall.behind || depth <= 0.0) return Vector3::Zero();
  const double outwards = plane.normal.dot(state.velocity);
  const double press = std::max(0.0, plane.spring * depth - plane.damper * outwards);
  const Vector3 along = state.velocity - outwards * plane.normal;
  return press * (plane.normal - plane.dynamic_friction / std::max(along.norm(), kRollingSpeed) * along);
}

}  // namespace icome::devices::vrpn
