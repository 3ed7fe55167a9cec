#include "files/csg/csg_colours.h"

#include "io/web_colours.h"

namespace icome::files {

std::optional<geometry::CsgTree::Colour> parse_colour(std::string_view text) {
  const auto packed = io::web_colour(text);
  if (!packed) return std::nullopt;
  const auto channel = [&](unsigned shift) { return float((*packed >> shift) & 0xffU) / 255.0F; };
  return geometry::CsgTree::Colour{channel(24), channel(16), channel(8), channel(0)};
}

}  // namespace icome::files
