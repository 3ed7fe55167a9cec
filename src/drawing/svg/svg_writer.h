#pragma once
#include <string>
#include <string_view>

#include "drawing/drawing.h"

namespace icome::drawing {

/// The two ways to put the lines of a drawing into a file.
enum class SvgLines {
  Outlines,     ///< as their rims, filled: every program shows their true width
  CentreLines,  ///< as lines of their mean width: other programs can edit them
};

/// The drawing as an SVG file in mm. Beside what every program shows it holds all that was drawn, as
/// svg_names.h describes, so that read_svg_text() gives an equal drawing back (with other ids). Layers are
/// layers in Inkscape, too.
std::string svg_text(const Drawing& drawing, SvgLines lines);

/// Is that what the path of a stroke draws in such a file, within what other programs round, however they
/// write it?
bool is_drawn_by(const Stroke& stroke, std::string_view path_data);

}  // namespace icome::drawing
