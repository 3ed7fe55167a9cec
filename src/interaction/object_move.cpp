#include "interaction/object_move.h"

#include <Eigen/LU>
#include <algorithm>
#include <unordered_set>

namespace icome::interaction {

using world::ObjectId;

std::vector<ObjectId> topmost(const world::World& world, std::span<const ObjectId> objects) {
  const std::unordered_set<ObjectId> named(objects.begin(), objects.end());
  std::unordered_set<ObjectId> taken;
  std::vector<ObjectId> found;
  for (const ObjectId id : objects) {
    const world::PhysicalObject* object = world.find(id);
    if (!object || !taken.insert(id).second) continue;
    bool below = false;
    for (ObjectId above = object->parent; above && !below; above = world.find(above)->parent)
      below = named.contains(above);
    if (!below) found.push_back(id);
  }
  return found;
}

ObjectMove::ObjectMove(const world::World& world, std::span<const ObjectId> objects) {
  for (const ObjectId id : topmost(world, objects)) {
    const world::PhysicalObject& object = *world.find(id);
    base::Matrix3 world_from_parent = base::Matrix3::Identity();
    if (object.parent) world_from_parent = world_from_object(world, object.parent).linear();
    const base::Matrix3 parent_from_world = world_from_parent.inverse();
    if (!parent_from_world.allFinite()) continue;
    objects_.push_back(id);
    starts_.push_back({object.parent_from_object, parent_from_world});
  }
}

world::Edit ObjectMove::by(const base::Vector3& offset) const {
  world::EditGroup group;
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    base::Affine3 place = starts_[i].parent_from_object;
    place.translation() += starts_[i].parent_from_world * offset;
    group.edits.emplace_back(world::PlaceObject{objects_[i], place});
  }
  return group;
}

}  // namespace icome::interaction
