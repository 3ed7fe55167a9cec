#pragma once
#include <span>

#include "world/edit/edit.h"

namespace icome::interaction {

// Edits that people make of several objects at once. Objects below another of them go along with it; those
// that do not exist (any more) are left out.

/// Deletes the objects with all below them, and the shapes that no object uses then.
world::Edit delete_objects(const world::World& world, std::span<const world::ObjectId> objects);

/// Puts the objects under `parent` (none: among the roots), one after the other, before the sibling-to-be
/// that is at `place` now; they stay where they are in the world. Fails where the parent is one of them or
/// below one, or does not exist.
base::Result<world::Edit> put_under(const world::World& world, std::span<const world::ObjectId> objects,
                                    world::ObjectId parent, std::size_t place);

/// The edit that groups objects, ready to be applied, and the object that will be the group.
struct Grouping {
  world::Edit edit;
  world::ObjectId group;
};

/// Puts the objects under a new one that stands in the middle of them, in the place of the first and under
/// its parent. Fails without objects.
base::Result<Grouping> group_objects(const world::World& world, std::span<const world::ObjectId> objects,
                                     world::IdSource& ids);

}  // namespace icome::interaction
