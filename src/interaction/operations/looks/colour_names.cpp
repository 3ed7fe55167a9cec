#include "interaction/operations/looks/colour_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "base/parse_number.h"
#include "interaction/operations/near_names.h"
#include "io/web_colours.h"

namespace icome::interaction {
namespace {

world::Colour colour_of(std::uint32_t rgb) {
  const auto part = [rgb](unsigned shift) { return float((rgb >> shift) & 0xffU) / 255.0F; };
  return {part(16), part(8), part(0)};
}

char lower(char letter) { return letter >= 'A' && letter <= 'Z' ? char(letter - 'A' + 'a') : letter; }

}  // namespace

base::Result<world::Colour> colour_from_text(std::string_view text) {
  std::string said(text);
  std::ranges::transform(said, said.begin(), lower);
  if (said.starts_with('#')) {
    constexpr std::size_t kLength = 7;
    const auto rgb = base::parse_number<std::uint32_t>(std::string_view(said).substr(1), 16);
    if (rgb && said.size() == kLength) return colour_of(*rgb);
    return base::fail(fmt::format("'{}' is no colour: say #rrggbb with six digits, such as #ff8000", text));
  }
  constexpr std::uint32_t kCovers = 0xff;  // all but "transparent"
  const auto named = io::web_colour(said);
  if (named && (*named & 0xffU) == kCovers) return colour_of(*named >> 8U);
  return base::fail(fmt::format("there is no colour '{}'{}", text, suggestion(said, colour_names())));
}

std::vector<std::string> colour_names() {
  const std::vector<std::string_view> names = io::web_colour_names();
  return {names.begin(), names.end()};
}

}  // namespace icome::interaction
