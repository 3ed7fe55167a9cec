#pragma once
#include "world/edit/edit.h"

namespace icome::session {

/// An edit that was performed on one world.
struct SharedEdit {
  world::Edit inverse;
  world::Edit for_replicas;  // does the same to another copy of the world, without making shapes anew
};

/// Performs an edit as world::apply does, and also gives what makes replicas equal again: shapes that took
/// work to make are in it.
base::Result<SharedEdit> perform_shared(world::World& world, const world::Edit& edit);

}  // namespace icome::session
