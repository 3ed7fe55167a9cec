#pragma once
#include <string_view>

#include "base/result.h"
#include "world/shape/geometry.h"

namespace icome::world {

// Shapes of the built-in kinds, read from the bytes of their `write` (geometry.fbs), for GeometryFactory.
// All fail with a sentence on bytes that are damaged, or to which no such shape can have been written.
base::Result<GeometryPointer> read_mesh(std::string_view bytes);
base::Result<GeometryPointer> read_loop(std::string_view bytes);
base::Result<GeometryPointer> read_primitive(std::string_view bytes);
base::Result<GeometryPointer> read_csg(std::string_view bytes);
base::Result<GeometryPointer> read_implicit(std::string_view bytes);

}  // namespace icome::world
