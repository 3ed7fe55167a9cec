#include "cutout/tracker/edges/colour_classes.h"

#include <algorithm>
#include <cmath>

namespace icome::cutout {
namespace {

constexpr double kDarkest = 24;          // the greatest channel of a colour that still has a hue
constexpr double kSkinOverGreen = 0.06;  // the least share by which skin is redder than green
constexpr double kLeastChange = 0.02;    // of a limit, for which the table is made anew
constexpr double kClassMargin = 0.12;    // shares between which classes could be kept apart

}  // namespace

ColourClasses::ColourClasses() : table_(32 * 32 * 32) { fill(); }

void ColourClasses::fill() {
  for (std::size_t i = 0; i < table_.size(); ++i) {
    const double b = 8 * double(i >> 10) + 4, g = 8 * double(i >> 5 & 31) + 4, r = 8 * double(i & 31) + 4;
    const double most = std::max({b, g, r});
    ColourClass& is = table_[i];
    is = ColourClass::Other;
    if (most < kDarkest) continue;
    if ((b - r) / most > limits_.blue_over_red && b >= 0.95 * g)
      is = ColourClass::Blue;
    else if ((r - g) / most > limits_.red_over_green && (r - b) / most > limits_.red_over_blue)
      is = ColourClass::Red;
    else if ((r - g) / most > kSkinOverGreen && r > b)
      is = ColourClass::Skin;
  }
}

bool ColourClasses::adapt(const double table_bgr[3], const double triangle_bgr[3]) {
  const double table_most = std::max({table_bgr[0], table_bgr[1], table_bgr[2]});
  const double triangle_most = std::max({triangle_bgr[0], triangle_bgr[1], triangle_bgr[2]});
  if (!(table_most >= kDarkest && triangle_most >= kDarkest)) return false;
  const double over_green = (table_bgr[2] - table_bgr[1]) / table_most;
  const double over_blue = (table_bgr[2] - table_bgr[0]) / table_most;
  const double over_red = (triangle_bgr[0] - triangle_bgr[2]) / triangle_most;
  if (!(over_green > 2 * kClassMargin && over_blue > 2 * kClassMargin && over_red > kClassMargin))
    return false;
  const Limits wanted = {std::clamp(0.65 * over_green, kClassMargin, 0.5),
                         std::clamp(0.6 * over_blue, kClassMargin, 0.5),
                         std::clamp(0.35 * over_red, 0.08, 0.25)};
  threshold_ = int(std::lround((table_bgr[0] - table_bgr[2] + triangle_bgr[0] - triangle_bgr[2]) / 2));
  const bool same = std::abs(wanted.red_over_green - limits_.red_over_green) < kLeastChange &&
                    std::abs(wanted.red_over_blue - limits_.red_over_blue) < kLeastChange &&
                    std::abs(wanted.blue_over_red - limits_.blue_over_red) < kLeastChange;
  if (same) return true;
  limits_ = wanted;
  fill();
  return true;
}

}  // namespace icome::cutout
