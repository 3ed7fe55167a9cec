#include "interaction/operations/looks/colour_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/parse_number.h"
#include "interaction/operations/near_names.h"

namespace icome::interaction {
namespace {

struct NamedColour {
  const char* name;
  std::uint32_t rgb;  // eight bits each, sRGB
};

/// The sixteen basic colours of CSS 1 and the orange that CSS 2.1 added.
constexpr std::array<NamedColour, 17> kColours{{{"aqua", 0x00ffff},
                                                {"black", 0x000000},
                                                {"blue", 0x0000ff},
                                                {"fuchsia", 0xff00ff},
                                                {"gray", 0x808080},
                                                {"green", 0x008000},
                                                {"lime", 0x00ff00},
                                                {"maroon", 0x800000},
                                                {"navy", 0x000080},
                                                {"olive", 0x808000},
                                                {"orange", 0xffa500},
                                                {"purple", 0x800080},
                                                {"red", 0xff0000},
                                                {"silver", 0xc0c0c0},
                                                {"teal", 0x008080},
                                                {"white", 0xffffff},
                                                {"yellow", 0xffff00}}};

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
  const auto found = std::ranges::find(kColours, said, &NamedColour::name);
  if (found != kColours.end()) return colour_of(found->rgb);
  return base::fail(fmt::format("there is no colour '{}'{}", text, suggestion(said, colour_names())));
}

std::vector<std::string> colour_names() {
  std::vector<std::string> names;
  for (const NamedColour& colour : kColours) names.emplace_back(colour.name);
  return names;
}

}  // namespace icome::interaction
