#include "interaction/techniques/selecting.h"

#include <algorithm>
#include <limits>

#include "interaction/techniques/similarity.h"

namespace icome::interaction {
namespace {

Vector3 centre_of(const TechniqueScene& scene, TargetId id) { return ball_of(*scene.find(id)).centre; }

Ray ray_of(const Pose& pointer) { return {pointer.translation(), -pointer.linear().col(2)}; }

PointedAt touched(const TechniqueScene& scene, const Pose& hand, double radius) {
  PointedAt result{0, hand.translation(), hand};
  if (const auto near = scene.nearest(result.point, radius)) result.id = near->id;
  return result;
}

PointedAt shone_upon(const TechniqueScene& scene, const Pose& pointer, double reach) {
  PointedAt result{0, pointer.translation(), pointer};
  if (const auto hit = scene.first_hit(ray_of(pointer))) {
    result.id = hit->id;
    result.point = pointer * Vector3(0.0, 0.0, -hit->distance);
  } else {
    result.point = pointer * Vector3(0.0, 0.0, -reach);
  }
  return result;
}

/// The target with its centre, or nothing with a point ahead.
PointedAt centred(const TechniqueScene& scene, const Pose& pointer, TargetId id, double reach) {
  return {id, id != 0 ? centre_of(scene, id) : Vector3(pointer * Vector3(0.0, 0.0, -reach)), pointer};
}

PointedAt spotlighted(const TechniqueScene& scene, const Pose& pointer, const SelectingSettings& settings,
                      double reach) {
  const SelectionCone cone{pointer.translation(), -pointer.linear().col(2), settings.spotlight};
  return centred(scene, pointer, disambiguated(scene.lit_by(cone), settings.same_angle), reach);
}

/// The target that the look goes through, else the one that it passes nearest.
PointedAt looked_upon(const TechniqueScene& scene, const Pose& eyes, const SelectingSettings& settings,
                      double reach) {
  const PointedAt straight = shone_upon(scene, eyes, reach);
  if (straight.id != 0) return straight;
  const SelectionCone cone{eyes.translation(), -eyes.linear().col(2), settings.look_angle};
  return centred(scene, eyes, disambiguated(scene.lit_by(cone), 0.0), reach);
}

PointedAt touched_copy(const TechniqueScene& scene, const TechniqueInput& input, const Pose& hand,
                       const SelectingSettings& settings, const base::Affine3& world_from_room) {
  const base::Affine3 copy = copy_from_world(settings.miniature, scene.bounds(), input, world_from_room);
  const double radius = settings.finger_radius * scale_of(world_from_room) / scale_of(copy);
  PointedAt result = touched(scene, carried_by(copy.inverse(), hand), radius);
  result.world_from_pointer = hand;
  return result;
}

}  // namespace

std::string_view name_of(Selecting selecting) {
  switch (selecting) {
    case Selecting::VirtualHand:
      return "virtual hand";
    case Selecting::GoGo:
      return "Go-Go";
    case Selecting::RayPointer:
      return "ray pointer";
    case Selecting::Spotlight:
      return "spotlight";
    case Selecting::Miniature:
      return "world in miniature";
    case Selecting::LookAt:
      return "look-at";
  }
  return "";
}

TargetId disambiguated(const std::vector<TechniqueScene::Lit>& lit, double same_angle) {
  double nearest_axis = std::numeric_limits<double>::infinity();
  for (const TechniqueScene::Lit& it : lit) nearest_axis = std::min(nearest_axis, it.off_axis);
  const TechniqueScene::Lit* chosen = nullptr;
  for (const TechniqueScene::Lit& it : lit) {
    if (it.off_axis > nearest_axis + same_angle) continue;
    if (!chosen || it.depth < chosen->depth) chosen = &it;
  }
  return chosen ? chosen->id : 0;
}

PointedAt pointed_at(Selecting selecting, const SelectingSettings& settings, const TechniqueInput& input,
                     int hand, const base::Affine3& world_from_room, const TechniqueScene& scene) {
  const double scale = scale_of(world_from_room);
  const double reach = scale * settings.go_go.arm;
  if (selecting == Selecting::LookAt)
    return looked_upon(scene, carried_by(world_from_room, input.room_from_head), settings, reach);
  const HandInput& from = input.hands[std::size_t(hand)];
  if (!from.tracked) return {};
  const Pose world_from_hand = carried_by(world_from_room, from.room_from_hand);
  switch (selecting) {
    case Selecting::VirtualHand:
      return touched(scene, world_from_hand, scale * settings.hand_radius);
    case Selecting::GoGo: {
      const Vector3 chest = chest_of(settings.go_go, input.room_from_head);
      const Pose mapped = go_go_hand(settings.go_go, chest, from.room_from_hand);
      return touched(scene, carried_by(world_from_room, mapped), scale * settings.hand_radius);
    }
    case Selecting::RayPointer:
      return shone_upon(scene, world_from_hand, reach);
    case Selecting::Spotlight:
      return spotlighted(scene, world_from_hand, settings, reach);
    case Selecting::Miniature:
      return touched_copy(scene, input, world_from_hand, settings, world_from_room);
    case Selecting::LookAt:
      break;
  }
  return {};
}

}  // namespace icome::interaction
