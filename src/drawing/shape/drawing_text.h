#pragma once
#include <span>
#include <string>

#include "drawing/shape/drawing_shape.h"

namespace icome::drawing {

/// The drawing of the shape as SVG text, from which shape_of_svg() makes one that looks and feels the same to
/// the last bit; only its numbers of strokes and layers may be others.
std::string svg_of(const DrawingShape& shape);

/// The body as three numbers with spaces between them: height of lines, more for a metre of width, sheet (m).
std::string text_of(const DrawingBody& body);

/// A shape from SVG text and the numbers of its body, which may come from a stranger. Fails with a sentence.
base::Result<world::GeometryPointer> shape_of_svg(const std::string& svg, std::span<const double> body);

}  // namespace icome::drawing
