#pragma once
#include <cstddef>
#include <functional>

#include "world/edit/edit.h"

namespace icome::world {

/// May work on bytes of a stranger go on, and take so many bytes of memory more? Asked before memory is taken
/// that few bytes may stand for, and with few now and then. Empty: it may.
using Permit = std::function<bool(std::size_t bytes)>;

/// As replay() (edit.h), but each single edit of `edit` waits for the permit.
base::Result<void> replay(World& world, const Edit& edit, const Permit& permit);

}  // namespace icome::world
