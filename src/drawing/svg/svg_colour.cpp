#include "drawing/svg/svg_colour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "drawing/svg/svg_scanner.h"
#include "io/web_colours.h"

namespace icome::drawing {
namespace {

/// The colour with the alpha that may follow, if the bracket closes behind it.
std::optional<CssColour> with_alpha(SvgScanner& scanner, CssColour colour) {
  scanner.take('/');
  if (const auto alpha = scanner.number())
    colour.alpha = std::clamp(*alpha / (scanner.take('%') ? 100.0 : 1.0), 0.0, 1.0);
  if (!scanner.take(')') || !scanner.at_end()) return std::nullopt;
  return colour;
}

/// The numbers within the brackets of rgb() and rgba(): bytes or shares in percent, then perhaps the alpha.
std::optional<CssColour> rgb_colour(std::string_view numbers) {
  SvgScanner scanner(numbers);
  CssColour result;
  for (float& channel : result.colour) {
    const auto number = scanner.number();
    if (!number) return std::nullopt;
    channel = float(std::clamp(*number / (scanner.take('%') ? 100.0 : 255.0), 0.0, 1.0));
  }
  return with_alpha(scanner, result);
}

/// The hue in turns: a number of degrees, or with one of CSS's units of angles.
std::optional<double> hue_turns(SvgScanner& scanner) {
  const auto number = scanner.number();
  if (!number) return std::nullopt;
  const std::string_view unit = scanner.word();
  if (unit.empty() || unit == "deg") return *number / 360.0;
  if (unit == "turn") return *number;
  if (unit == "grad") return *number / 400.0;
  if (unit == "rad") return *number / (2.0 * std::numbers::pi);
  return std::nullopt;
}

/// The numbers within the brackets of hsl() and hsla(): hue, saturation, lightness, then perhaps the alpha.
std::optional<CssColour> hsl_colour(std::string_view numbers) {
  SvgScanner scanner(numbers);
  const auto hue = hue_turns(scanner);
  if (!hue) return std::nullopt;
  std::array<double, 2> shares{};
  for (double& share : shares) {
    const auto percent = scanner.number();
    if (!percent) return std::nullopt;
    scanner.take('%');
    share = std::clamp(*percent / 100.0, 0.0, 1.0);
  }
  const auto [saturation, lightness] = shares;
  const double reach = saturation * std::min(lightness, 1.0 - lightness);
  // CSS Color 4, 7.1: each channel follows the hue, red first.
  const auto channel = [&](double first) {
    const double k = std::fmod(first + 12.0 * (*hue - std::floor(*hue)), 12.0);
    return float(lightness - reach * std::clamp(std::min(k - 3.0, 9.0 - k), -1.0, 1.0));
  };
  return with_alpha(scanner, {{channel(0.0), channel(8.0), channel(4.0)}, 1.0});
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
  if (text.starts_with("hsl(")) return hsl_colour(text.substr(4));
  if (text.starts_with("hsla(")) return hsl_colour(text.substr(5));
  const auto packed = io::web_colour(text);
  if (!packed) return std::nullopt;
  const auto channel = [&](unsigned shift) { return float((*packed >> shift) & 0xffU) / 255.0F; };
  return CssColour{{channel(24), channel(16), channel(8)}, double(*packed & 0xffU) / 255.0};
}

}  // namespace icome::drawing
