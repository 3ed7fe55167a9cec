#pragma once
#include <optional>
#include <string_view>

#include "geometry/csg/csg_tree.h"

namespace icome::files {

/// The colour that OpenSCAD gives to a name of the web's list (in any case), "transparent", or #rgb, #rgba,
/// #rrggbb, #rrggbbaa. Nothing for other text.
std::optional<geometry::CsgTree::Colour> parse_colour(std::string_view text);

}  // namespace icome::files
