#pragma once
#include <optional>
#include <string_view>

#include "world/shape/fixture.h"

namespace icome::drawing {

/// A colour of CSS and how much it covers, 0 to 1.
struct CssColour {
  world::Colour colour = {0.0F, 0.0F, 0.0F};
  double alpha = 1.0;
};

/// "#rgb", "#rrggbb" (both also with a digit or two of alpha), "rgb(...)", "rgba(...)", "hsl(...)",
/// "hsla(...)", "transparent" or one of the names of CSS, without regard to case; nothing for other text.
std::optional<CssColour> parse_css_colour(std::string_view text);

}  // namespace icome::drawing
