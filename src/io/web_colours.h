#pragma once
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace icome::io {

/// The colour of a name of the web's list (CSS Color 4, in any case), of "transparent", or of #rgb, #rgba,
/// #rrggbb or #rrggbbaa, as 0xrrggbbaa: red, green, blue and how much it covers, 0 to 255 each. Nothing for
/// other text.
std::optional<std::uint32_t> web_colour(std::string_view text);

/// The names of the web's list in alphabetical order, without "transparent".
std::vector<std::string_view> web_colour_names();

}  // namespace icome::io
