#pragma once
#include "world/edit/edit.h"

namespace icome::session {

/// An edit that was performed on one world.
struct SharedEdit {
  world::Edit inverse;
  world::Edit for_replicas;  // does the same to another copy of the world, without making shapes anew
};

/// Performs an edit as world::apply does, and also gives the edit that makes replicas equal again: it
/// holds the shapes that took work to make.
base::Result<SharedEdit> perform_shared(world::World& world, const world::Edit& edit);

}  // namespace icome::session
