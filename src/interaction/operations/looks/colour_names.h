#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "world/shape/fixture.h"

namespace icome::interaction {

/// The colour of "#rrggbb" or of one of the names of CSS ("red", "gold", "navy", ...), in any case of
/// letters; not "transparent", which is none. Fails with what may have been meant.
base::Result<world::Colour> colour_from_text(std::string_view text);

/// The names, in alphabetical order.
std::vector<std::string> colour_names();

}  // namespace icome::interaction
