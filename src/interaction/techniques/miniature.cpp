#include "interaction/techniques/miniature.h"

#include <algorithm>

#include "interaction/techniques/similarity.h"

namespace icome::interaction {
namespace {

/// The level direction ahead of the eyes; where they look straight up or down, that of the head's top.
Vector3 level_ahead(const Pose& room_from_head) {
  Vector3 ahead = -room_from_head.linear().col(2);
  if (std::hypot(ahead.x(), ahead.z()) < 1e-6) ahead = room_from_head.linear().col(1);
  ahead.y() = 0.0;
  return ahead.normalized();
}

/// The place where the copy floats, in the room.
Vector3 floating_place(const MiniatureSettings& settings, const Pose& room_from_head) {
  const bool level = !settings.keeps_in_sight;
  const Vector3 ahead = level ? level_ahead(room_from_head) : Vector3(-room_from_head.linear().col(2));
  const Vector3 up = level ? Vector3(Vector3::UnitY()) : Vector3(room_from_head.linear().col(1));
  return room_from_head.translation() + settings.before * ahead - settings.below * up;
}

}  // namespace

base::Affine3 copy_from_world(const MiniatureSettings& settings, const base::Bounds& all,
                              const TechniqueInput& input, const base::Affine3& world_from_room) {
  base::Bounds box = settings.shown.isEmpty() ? all : settings.shown;
  if (box.isEmpty() || !box.sizes().allFinite() || !(box.sizes().maxCoeff() > 0.0))
    box = base::Bounds(Vector3::Constant(-0.5), Vector3::Constant(0.5));
  const double room_scale = scale_of(world_from_room);
  const double factor = room_scale * settings.size / box.sizes().maxCoeff();
  const HandInput& other = input.hands[1];
  Vector3 foot = box.center();
  if (other.tracked || !settings.keeps_in_sight) foot.y() = box.min().y();
  base::Affine3 copy_from_foot = base::Affine3::Identity();
  if (other.tracked) {
    copy_from_foot = carried_by(world_from_room, other.room_from_hand);
    copy_from_foot.translate(Vector3(0.0, room_scale * settings.above_hand, 0.0));
  } else {
    copy_from_foot.translation() = world_from_room * floating_place(settings, input.room_from_head);
  }
  return copy_from_foot * Eigen::Scaling(factor) * Eigen::Translation3d(-foot);
}

}  // namespace icome::interaction
