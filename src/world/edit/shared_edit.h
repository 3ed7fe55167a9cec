#pragma once
#include <functional>
#include <optional>

#include "world/edit/edit.h"

namespace icome::world {

/// An edit that was performed on one world.
struct SharedEdit {
  Edit inverse;
  Edit for_replicas;  // does the same to another copy of the world, without making shapes anew
};

/// Says how an edit that is no group is to be performed on the world as it is then; nothing: as it is.
using Fit = std::function<std::optional<Edit>(const World& world, const Edit& edit)>;

/// Performs an edit as apply() does, and also gives the edit that makes replicas equal again: it holds the
/// shapes that took work to make. With `fit`, each edit of a group is fitted before it is performed.
base::Result<SharedEdit> perform_shared(World& world, const Edit& edit, const Fit& fit = nullptr);

}  // namespace icome::world
