#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "world/edit/edit.h"

namespace icome::interaction {

// Where objects are, for operations that move them in the world's frame.

/// "'leg'", or "object #12" where it has no name. The object is there.
std::string called(const world::World& world, world::ObjectId id);

/// The frame that the object's place is said in, in the world's. The object is there.
base::Affine3 world_from_parent(const world::World& world, world::ObjectId id);
/// The other way round. Fails, naming the object, where parents within parents shrink space to nothing.
base::Result<base::Affine3> parent_from_world(const world::World& world, world::ObjectId id);

/// The edit that moves an object by an offset (m, world frame); how it is turned stays to the last bit.
base::Result<world::Edit> moved_by(const world::World& world, world::ObjectId id,
                                   const base::Vector3& offset);

/// The edit that does to objects what a map of the world onto itself does; those below another of them go
/// along with it.
base::Result<world::Edit> mapped_by(const world::World& world, std::span<const world::ObjectId> objects,
                                    const base::Affine3& world_from_world);

/// The map that does this (about the origin) about a centre.
base::Affine3 about(const base::Vector3& centre, const base::Matrix3& linear);

/// The middle of the box around all of them (m, world frame); of where they stand if they have no shape.
base::Vector3 middle_of(const world::World& world, std::span<const world::ObjectId> objects);

}  // namespace icome::interaction
