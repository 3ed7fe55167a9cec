#pragma once
#include <memory>
#include <unordered_map>
#include <vector>

#include "interaction/techniques/technique.h"
#include "world/edit/changes.h"

namespace icome::interaction {

/// The objects of a world that have a shape, in the order of their ids, which are the targets' numbers. They
/// are met as the triangles of their shapes, as near as world::usual_tolerance says where these are exact
/// solids; objects of one shape share them. Shapes without an end, such as planes, and those without
/// triangles are left out.
TechniqueScene targets_of(const world::World& world);

/// The target that techniques meet for a shape; null: there is nothing to meet. Any thread.
std::shared_ptr<const TargetShape> target_shape(const world::Geometry& shape);

/// The targets of a world that changes: those of targets_of(), to the last bit, at the cost of the
/// changes only. Owns the shapes.
class WorldTargets {
 public:
  /// The targets of the world: the one of the last call, but for changes that changed() was told of.
  const TechniqueScene& of(const world::World& world);
  /// To be told of changes of the world; null: it is another world.
  void changed(const world::Changes* changes);

  /// The shapes that of() would have to make into targets first, and that take long: solids under union,
  /// intersection and difference, subdivision surfaces, formulas, meshes of many triangles. Each once.
  std::vector<world::GeometryPointer> slow_shapes(const world::World& world) const;
  /// Keeps the result of target_shape() for a shape of the world, so that of() does not make it again.
  void keep(const world::GeometryPointer& shape, std::shared_ptr<const TargetShape> made);

 private:
  void read(const world::World& world);
  bool follow(const world::World& world);
  bool follow(const world::World& world, world::ObjectId id);

  TechniqueScene scene_;
  // Null: there is nothing to meet.
  std::unordered_map<world::GeometryPointer, std::shared_ptr<const TargetShape>> shapes_;
  std::unordered_map<world::ObjectId, world::GeometryId> made_of_;  // those objects that have a shape
  std::vector<world::ObjectId> moved_;                              // or changed otherwise
  bool is_stale_ = true;
};

/// Puts an object where a technique moved it. Fails where the object is gone or a parent above it has shrunk
/// to nothing.
base::Result<world::Edit> edit_of(const world::World& world, const MovedTarget& moved);

}  // namespace icome::interaction
