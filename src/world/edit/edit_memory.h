#pragma once
#include <cstddef>

#include "world/edit/edit.h"

namespace icome::world {

/// About the bytes of memory that keeping an edit may take: its texts, numbers, shapes and pictures. Shared
/// parts count in full.
std::size_t memory_of(const Edit& edit);

}  // namespace icome::world
