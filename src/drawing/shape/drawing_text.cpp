#include "drawing/shape/drawing_text.h"

#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"

namespace icome::drawing {

std::string svg_of(const DrawingShape& shape) { return svg_text(shape.drawing(), SvgLines::CentreLines); }

base::Result<world::GeometryPointer> shape_of_svg(const std::string& svg, const DrawingBody& body) {
  auto read = read_svg_text(svg, "drawing");
  if (!read) return tl::unexpected(read.error());
  auto shape = DrawingShape::create(std::move(read->drawing), body);
  if (!shape) return tl::unexpected(shape.error());
  return world::GeometryPointer(std::move(*shape));
}

}  // namespace icome::drawing
