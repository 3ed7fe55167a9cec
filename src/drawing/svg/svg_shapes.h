#pragma once
#include <string_view>

#include "drawing/svg/svg_path.h"
#include "drawing/svg/xml_text.h"

namespace icome::drawing {

/// Does an element of this local name draw lines by itself: path, line, polyline, polygon, rect, circle or
/// ellipse?
bool is_svg_shape(std::string_view name);

/// The outline that such an element draws, in its user units. Percent are of `whole`. Lengths that are none
/// count as not there, which the fault tells; paths and polygons end before a fault.
SvgShape svg_shape_of(const XmlNode& node, const base::Vector2& whole);

}  // namespace icome::drawing
