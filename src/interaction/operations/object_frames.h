#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "world/edit/edit.h"

namespace icome::interaction {

// Places of objects, for operations that move them in the world's frame.

/// "'leg'", or "object #12" where it has no name. Precondition: the object exists.
std::string called(const world::World& world, world::ObjectId id);

/// The frame in which the object's place is given, in the world's. Precondition: the object exists.
base::Affine3 world_from_parent(const world::World& world, world::ObjectId id);
/// The inverse of world_from_parent(). Fails, naming the object, where its parents shrink space to nothing.
base::Result<base::Affine3> parent_from_world(const world::World& world, world::ObjectId id);

/// The edit that moves an object by an offset (m, world frame); its turn and scale stay to the last bit.
base::Result<world::Edit> moved_by(const world::World& world, world::ObjectId id,
                                   const base::Vector3& offset);

/// The edit that applies a map of the world onto itself to objects; those below another of them go along
/// with it.
base::Result<world::Edit> mapped_by(const world::World& world, std::span<const world::ObjectId> objects,
                                    const base::Affine3& world_from_world);

/// The linear map, applied about a centre instead of the origin.
base::Affine3 about(const base::Vector3& centre, const base::Matrix3& linear);

/// The middle of the box around all of them (m, world frame); of their origins if they have no shape.
base::Vector3 middle_of(const world::World& world, std::span<const world::ObjectId> objects);

}  // namespace icome::interaction
