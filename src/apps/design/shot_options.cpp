#include "apps/design/shot_options.h"

#include <fmt/format.h>

#include <string_view>

#include "base/parse_number.h"

namespace icome::apps {
base::Result<void> parse_size(const std::string& text, ShotOptions& options) {
  constexpr int kMostSide = 16384;
  const std::string_view all = text;
  const std::size_t cross = all.find('x');
  if (cross != std::string_view::npos) {
    const auto width = base::parse_number<int>(all.substr(0, cross));
    const auto height = base::parse_number<int>(all.substr(cross + 1));
    if (width && height && *width >= 1 && *height >= 1 && *width <= kMostSide && *height <= kMostSide) {
      options.width = *width;
      options.height = *height;
      return {};
    }
  }
  return base::fail(fmt::format(
      "--size \"{}\" makes no sense: give width and height in pixels, 1 to {} each, such as 1280x960.", text,
      kMostSide));
}

base::Result<void> parse_background(const std::string& text, ShotOptions& options) {
  if (text == "none") {
    options.clear = true;
    return {};
  }
  if (text == "white") options.background = 0xffffff;
  if (text == "black") options.background = 0x000000;
  if (text.size() == 7 && text[0] == '#')
    options.background = base::parse_number<unsigned>(std::string_view(text).substr(1), 16);
  if (options.background) return {};
  return base::fail(fmt::format(
      "--background \"{}\" is no colour: give none, white, black or #rrggbb, such as #e0e8f0.", text));
}

}  // namespace icome::apps
