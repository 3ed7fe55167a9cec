#pragma once
#include "world/edit/edit.h"

namespace icome::collab {

/// The edit that puts a model which was prepared alone into a design, with all its shapes, materials,
/// pictures and scenes under new ids: its roots go behind the last child of `parent` (none: behind the last
/// root). One edit, so that undo takes all of it back.
world::Edit integration_of(const world::World& model, const world::World& design, world::ObjectId parent,
                           world::IdSource& ids);

}  // namespace icome::collab
