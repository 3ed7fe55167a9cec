#pragma once
#include "files/new_file.h"
#include "files/shown_world.h"

namespace icome::files {

// Writers of formats that hold one mesh. None finishes the file.

/// Binary PLY. Coordinates are single precision where that holds them all exactly, else double.
void write_ply(const FlatWorld& world, NewFile& file);

/// Ascii OFF, numbers as short as they can be without loss.
void write_off(const FlatWorld& world, NewFile& file);

}  // namespace icome::files
