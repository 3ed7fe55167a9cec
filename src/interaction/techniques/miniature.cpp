#include "interaction/techniques/miniature.h"

#include <algorithm>

#include "interaction/techniques/similarity.h"

namespace icome::interaction {
namespace {

/// Straight ahead of the eyes and level; where they look straight up or down, where the head's top points.
Vector3 level_ahead(const Pose& room_from_head) {
  Vector3 ahead = -room_from_head.linear().col(2);
  if (std::hypot(ahead.x(), ahead.z()) < 1e-6) ahead = room_from_head.linear().col(1);
  ahead.y() = 0.0;
  return ahead.normalized();
}

}  // namespace

base::Affine3 copy_from_world(const MiniatureSettings& settings, const base::Bounds& all,
                              const TechniqueInput& input, const base::Affine3& world_from_room) {
  base::Bounds box = settings.shown.isEmpty() ? all : settings.shown;
  if (box.isEmpty() || !box.sizes().allFinite() || !(box.sizes().maxCoeff() > 0.0))
    box = base::Bounds(Vector3::Constant(-0.5), Vector3::Constant(0.5));
  const double room_scale = scale_of(world_from_room);
  const double factor = room_scale * settings.size / box.sizes().maxCoeff();
  Vector3 floor = box.center();
  floor.y() = box.min().y();
  const HandInput& other = input.hands[1];
  base::Affine3 copy_from_floor = base::Affine3::Identity();
  if (other.tracked) {
    copy_from_floor = carried_by(world_from_room, other.room_from_hand);
    copy_from_floor.translate(Vector3(0.0, room_scale * settings.above_hand, 0.0));
  } else {
    const Vector3 eyes = input.room_from_head.translation();
    const Vector3 at =
        eyes + settings.before * level_ahead(input.room_from_head) - settings.below * Vector3::UnitY();
    copy_from_floor.translation() = world_from_room * at;
  }
  return copy_from_floor * Eigen::Scaling(factor) * Eigen::Translation3d(-floor);
}

}  // namespace icome::interaction
