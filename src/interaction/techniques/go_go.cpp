#include "interaction/techniques/go_go.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

double beyond_near(const GoGoSettings& settings, double distance) {
  return std::max(0.0, distance - settings.near_share * settings.arm);
}

/// The point in the same direction from the chest, at another distance.
base::Vector3 at_distance(const base::Vector3& chest, const base::Vector3& point, double now, double then) {
  return now > 0.0 ? base::Vector3(chest + then / now * (point - chest)) : point;
}

}  // namespace

double go_go_reach(const GoGoSettings& settings, double distance) {
  const double beyond = beyond_near(settings, distance);
  return distance + settings.gain * beyond * beyond;
}

double go_go_slope(const GoGoSettings& settings, double distance) {
  return 1.0 + 2.0 * settings.gain * beyond_near(settings, distance);
}

double go_go_distance(const GoGoSettings& settings, double reach) {
  const double further = beyond_near(settings, reach);
  // The root of k x^2 + x = further, without losing digits where k is small.
  return reach - further + 2.0 * further / (1.0 + std::sqrt(1.0 + 4.0 * settings.gain * further));
}

base::Pose go_go_hand(const GoGoSettings& settings, const base::Vector3& room_chest,
                      const base::Pose& room_from_hand) {
  base::Pose mapped = room_from_hand;
  const base::Vector3 hand = room_from_hand.translation();
  const double distance = (hand - room_chest).norm();
  mapped.translation() = at_distance(room_chest, hand, distance, go_go_reach(settings, distance));
  return mapped;
}

base::Vector3 go_go_hand_for(const GoGoSettings& settings, const base::Vector3& room_chest,
                             const base::Vector3& room_point) {
  const double reach = (room_point - room_chest).norm();
  return at_distance(room_chest, room_point, reach, go_go_distance(settings, reach));
}

base::Vector3 chest_of(const GoGoSettings& settings, const base::Pose& room_from_head) {
  return room_from_head.translation() - settings.chest_below_eyes * base::Vector3::UnitY();
}

}  // namespace icome::interaction
