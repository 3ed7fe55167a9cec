#pragma once
#include <map>
#include <optional>
#include <string>

#include "base/result.h"
#include "world/shape/geometry.h"

namespace icome::files {

/// A shape that is no mesh, as texts with names: for formats that hold triangles and let texts be put
/// beside them. docs/file-formats.md tells what they are. "kind" is one of them.
using ShapeText = std::map<std::string, std::string>;

/// Exact to the last bit. Nothing for meshes; fails for kinds that have no text, saying why.
base::Result<std::optional<ShapeText>> shape_text(const world::Geometry& shape);

/// The shape of texts that may come from a stranger.
base::Result<world::GeometryPointer> shape_from_text(const ShapeText& text);

}  // namespace icome::files
