#pragma once
#include <map>
#include <optional>
#include <string>

#include "base/result.h"
#include "world/shape/geometry.h"

namespace icome::files {

/// A shape that is no mesh, as texts with names: for formats that hold triangles and allow texts
/// beside them. docs/file-formats.md describes them. "kind" is one of them.
using ShapeText = std::map<std::string, std::string>;

/// Exact to the last bit. Nothing for meshes; fails for kinds without a text, saying why.
base::Result<std::optional<ShapeText>> shape_text(const world::Geometry& shape);

/// The shape of texts that may come from a stranger.
base::Result<world::GeometryPointer> shape_from_text(const ShapeText& text);

}  // namespace icome::files
