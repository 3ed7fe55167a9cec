#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "drawing/drawing.h"
#include "drawing/outline/filled_loops.h"
#include "drawing/svg/svg_colour.h"
#include "drawing/svg/svg_notes.h"

namespace icome::drawing {

/// The paint of a shape, as far as drawings know it. Defaults are those of SVG.
struct SvgStyle {
  std::optional<CssColour> fill = CssColour{};
  std::optional<CssColour> line;
  CssColour current;        ///< the property `color`
  double line_width = 1.0;  ///< user units
  double fill_opacity = 1.0, line_opacity = 1.0;
  double opacity = 1.0;  ///< of the element and all around it
  CurveEnds ends = CurveEnds::Flat;
  FillRule rule = FillRule::NonZero;
  bool is_width_fixed = false;  ///< on the paper, whatever transforms there are, for the element alone
  bool visible = true;
  bool displayed = true;  ///< false for the element with display:none alone
};

/// The style of an element within one of style `around`: by its attributes, then by the declarations of
/// sheets (the weakest first), then by its style attribute, and last by what is !important. `whole` is what
/// percent of a width are of, in user units. What is not understood is noted.
SvgStyle svg_style_of(const XmlNode& node, const SvgStyle& around,
                      std::span<const std::string_view> declarations, double whole, SvgNotes& notes);

}  // namespace icome::drawing
