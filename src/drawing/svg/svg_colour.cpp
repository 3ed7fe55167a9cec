#include "drawing/svg/svg_colour.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "drawing/svg/svg_scanner.h"
#include "io/web_colours.h"

namespace icome::drawing {
namespace {

/// The numbers within the brackets of rgb() and rgba(): bytes or shares in percent, then perhaps the alpha.
std::optional<CssColour> rgb_colour(std::string_view numbers) {
  SvgScanner scanner(numbers);
  CssColour result;
  for (float& channel : result.colour) {
    const auto number = scanner.number();
    if (!number) return std::nullopt;
    channel = float(std::clamp(*number / (scanner.take('%') ? 100.0 : 255.0), 0.0, 1.0));
  }
  scanner.take('/');
  if (const auto alpha = scanner.number())
    result.alpha = std::clamp(*alpha / (scanner.take('%') ? 100.0 : 1.0), 0.0, 1.0);
  if (!scanner.take(')') || !scanner.at_end()) return std::nullopt;
  return result;
}

}  // namespace

std::optional<CssColour> parse_css_colour(std::string_view text) {
  constexpr std::size_t kLongestColour = 200;
  if (text.size() > kLongestColour) return std::nullopt;
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? char(c + 32) : c; });
  text = lower;
  if (text.starts_with("rgb(")) return rgb_colour(text.substr(4));
  if (text.starts_with("rgba(")) return rgb_colour(text.substr(5));
  const auto packed = io::web_colour(text);
  if (!packed) return std::nullopt;
  const auto channel = [&](unsigned shift) { return float((*packed >> shift) & 0xffU) / 255.0F; };
  return CssColour{{channel(24), channel(16), channel(8)}, double(*packed & 0xffU) / 255.0};
}

}  // namespace icome::drawing
