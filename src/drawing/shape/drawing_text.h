#pragma once
#include <string>

#include "drawing/shape/drawing_shape.h"

namespace icome::drawing {

/// The drawing of the shape as SVG text, from which shape_of_svg() makes one that looks and feels the same to
/// the last bit; only its numbers of strokes and layers may be others.
std::string svg_of(const DrawingShape& shape);

/// A shape from SVG text, which may come from a stranger. Fails with a sentence.
base::Result<world::GeometryPointer> shape_of_svg(const std::string& svg, const DrawingBody& body);

}  // namespace icome::drawing
