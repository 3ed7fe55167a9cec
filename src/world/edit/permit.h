#pragma once
#include <cstddef>
#include <functional>

#include "world/edit/edit.h"

namespace icome::world {

/// May work on bytes of a stranger go on, and take so many more bytes of memory? Asked before allocations
/// that few bytes may stand for, and now and then with small sizes. Empty: always allowed.
using Permit = std::function<bool(std::size_t bytes)>;

/// Replays as replay() in edit.h, but each single edit of `edit` waits for the permit.
base::Result<void> replay(World& world, const Edit& edit, const Permit& permit);

}  // namespace icome::world
