#include "interaction/operations/object_frames.h"

#include <fmt/format.h>

#include <Eigen/LU>

#include "interaction/object_move.h"

namespace icome::interaction {

using base::Affine3;
using base::Result;
using base::Vector3;
using world::ObjectId;
using world::World;

std::string called(const World& world, ObjectId id) {
  const std::string& name = world.find(id)->name;
  return name.empty() ? fmt::format("object #{}", id.value) : fmt::format("'{}'", name);
}

Affine3 world_from_parent(const World& world, ObjectId id) {
  const ObjectId parent = world.find(id)->parent;
  return parent ? world::world_from_object(world, parent) : Affine3::Identity();
}

Result<Affine3> parent_from_world(const World& world, ObjectId id) {
  const Affine3 inverse = world_from_parent(world, id).inverse();
  if (inverse.matrix().allFinite()) return inverse;
  return base::fail(fmt::format("{} cannot be moved: what is above it is shrunk to nothing; put it elsewhere",
                                called(world, id)));
}

Result<world::Edit> moved_by(const World& world, ObjectId id, const Vector3& offset) {
  const auto parent = parent_from_world(world, id);
  if (!parent) return tl::unexpected(parent.error());
  Affine3 place = world.find(id)->parent_from_object;
  place.translation() += parent->linear() * offset;
  return world::Edit(world::PlaceObject{id, place});
}

Result<world::Edit> mapped_by(const World& world, std::span<const ObjectId> objects,
                              const Affine3& world_from_world) {
  world::EditGroup group;
  for (const ObjectId id : topmost(world, objects)) {
    const auto parent = parent_from_world(world, id);
    if (!parent) return tl::unexpected(parent.error());
    const Affine3 there = world_from_world * world::world_from_object(world, id);
    group.edits.emplace_back(world::PlaceObject{id, *parent * there});
  }
  return world::Edit(std::move(group));
}

Affine3 about(const Vector3& centre, const base::Matrix3& linear) {
  Affine3 map = Affine3::Identity();
  map.linear() = linear;
  map.translation() = centre - linear * centre;
  return map;
}

Vector3 middle_of(const World& world, std::span<const ObjectId> objects) {
  base::Bounds shapes;
  base::Bounds origins;
  for (const ObjectId id : objects) {
    shapes.extend(world::bounds(world, id));
    origins.extend(Vector3(world::world_from_object(world, id).translation()));
  }
  return shapes.isEmpty() ? origins.center() : shapes.center();
}

}  // namespace icome::interaction
