#pragma once
#include "files/shown_world.h"
#include "io/new_file.h"

namespace icome::files {

// Writers of formats that hold one mesh. None finishes the file.

/// Binary PLY. Coordinates are single precision where that holds them all exactly, else double.
void write_ply(const FlatWorld& world, io::NewFile& file);

/// Ascii OFF, numbers as short as possible without loss.
void write_off(const FlatWorld& world, io::NewFile& file);

}  // namespace icome::files
