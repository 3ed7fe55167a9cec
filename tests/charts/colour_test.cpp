#include "charts/colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/srgb.h"

namespace icome::charts {
namespace {

TEST(LinearFromSrgb, MatchesTheStandardsMiddleGrey) {
  // IEC 61966-2-1: sRGB 0.5 is 21.404 % light.
  EXPECT_NEAR(base::linear_from_srgb(0.5), 0.21404, 1e-5);
  EXPECT_NEAR(base::srgb_from_linear(base::linear_from_srgb(0.3)), 0.3, 1e-12);
}

TEST(Lightness, IsZeroForBlackAndOneForWhite) {
  EXPECT_NEAR(lightness({0.0, 0.0, 0.0}), 0.0, 1e-6);
  EXPECT_NEAR(lightness({1.0, 1.0, 1.0}), 1.0, 1e-6);
}

TEST(MagnitudeColour, GrowsEvenlyInLightness) {
  const double step = (lightness(magnitude_colour(1.0)) - lightness(magnitude_colour(0.0))) / 20.0;
  for (int i = 0; i < 20; ++i) {
    const double rise = lightness(magnitude_colour((i + 1) / 20.0)) - lightness(magnitude_colour(i / 20.0));
    EXPECT_NEAR(rise, step, 0.02 * step) << "at step " << i;
  }
}

TEST(MagnitudeColour, StaysOnTheScreenForAnyNumber) {
  for (const double t : {-1.0, 0.0, 0.25, 0.5, 0.75, 1.0, 7.0, std::numeric_limits<double>::quiet_NaN()}) {
    const Colour c = magnitude_colour(t);
    for (const double channel : {c.red, c.green, c.blue}) {
      EXPECT_GE(channel, 0.0);
      EXPECT_LE(channel, 1.0);
    }
  }
}

}  // namespace
}  // namespace icome::charts
