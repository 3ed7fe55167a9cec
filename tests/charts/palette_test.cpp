#include "charts/palette.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::charts {
namespace {

double difference(const Colour& a, const Colour& b) {
  return std::hypot(a.red - b.red, a.green - b.green, a.blue - b.blue);
}

TEST(Palette, SeriesHaveColoursOfTheirOwn) {
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GT(difference(series_colour(i), series_colour(j)), 0.05) << i << " and " << j;
  EXPECT_EQ(difference(series_colour(24), series_colour(0)), 0.0);
}

TEST(Palette, SeriesGoThroughTheHuesThenLighterThenDarker) {
  EXPECT_EQ(difference(series_colour(3), colour_of(Hue::Vermilion)), 0.0);
  EXPECT_GT(lightness(series_colour(8)), lightness(series_colour(0)));
  EXPECT_LT(lightness(series_colour(16)), lightness(series_colour(0)));
}

TEST(Palette, InkCanBeReadOnItsGround) {
  for (const Colour& ink : {kInk, kQuietInk, kAxisInk})
    for (const Colour& ground : {kPaper, kPanel, kShade, kGridLine})
      EXPECT_GT(lightness(ground) - lightness(ink), 0.35);
}

}  // namespace
}  // namespace icome::charts
