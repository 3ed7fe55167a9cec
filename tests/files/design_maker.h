#pragma once
#include <string>

#include "world/sample_world.h"

namespace icome::files {

/// A design to add objects to.
struct DesignMaker {
  world::World world;
  world::IdSource ids;

  world::ObjectId add(const std::string& name, world::GeometryPointer shape, world::ObjectId parent = {},
                      const world::Affine3& frame = world::Affine3::Identity()) {
    return add_object(world, ids, name, std::move(shape), parent, frame);
  }
};

}  // namespace icome::files
