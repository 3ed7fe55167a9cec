#include "drawing/shape/drawing_text.h"

#include "drawing/svg/svg_reader.h"
#include "drawing/svg/svg_writer.h"
#include "io/number_text.h"

namespace icome::drawing {

std::string svg_of(const DrawingShape& shape) { return svg_text(shape.drawing(), SvgLines::CentreLines); }

std::string text_of(const DrawingBody& body) {
  std::string text;
  for (const double number : {body.heights.height, body.heights.height_by_width, body.sheet}) {
    if (!text.empty()) text += ' ';
    io::append_number(text, number);
  }
  return text;
}

base::Result<world::GeometryPointer> shape_of_svg(const std::string& svg, std::span<const double> body) {
  if (body.size() != 3) return base::fail("the body of a drawing is three numbers");
  auto read = read_svg_text(svg, "drawing");
  if (!read) return tl::unexpected(read.error());
  auto shape = DrawingShape::create(std::move(read->drawing), {{body[0], body[1]}, body[2]});
  if (!shape) return tl::unexpected(shape.error());
  return world::GeometryPointer(std::move(*shape));
}

}  // namespace icome::drawing
