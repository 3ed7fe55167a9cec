#include "base/srgb.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace icome::base {
namespace {

TEST(Srgb, IsWhatTheStandardSays) {
  EXPECT_EQ(linear_from_srgb(0.0), 0.0);
  EXPECT_DOUBLE_EQ(linear_from_srgb(1.0), 1.0);
  // IEC 61966-2-1: ((0.5 + 0.055) / 1.055) ^ 2.4, and its straight beginning.
  EXPECT_NEAR(linear_from_srgb(0.5), 0.21404114048223255, 1e-15);
  EXPECT_NEAR(linear_from_srgb(0.04), 0.04 / 12.92, 1e-15);
  EXPECT_EQ(srgb_from_linear(-1.0), 0.0);
  EXPECT_DOUBLE_EQ(srgb_from_linear(7.0), 1.0);
}

TEST(Srgb, ComesBackAsItWas) {
  for (int byte = 0; byte <= 255; ++byte) {
    const float channel = float(byte) / 255.0F;
    EXPECT_EQ(float(srgb_from_linear(linear_from_srgb(double(channel)))), channel) << byte;
  }
  Random random(5);
  for (int i = 0; i < 100000; ++i) {
    const auto channel = float(random.uniform());
    ASSERT_EQ(float(srgb_from_linear(linear_from_srgb(double(channel)))), channel);
  }
}

TEST(Srgb, TakesColours) {
  EXPECT_EQ(linear_from_srgb(std::array<float, 3>{0.0F, 0.5F, 1.0F}),
            (std::array<float, 3>{0.0F, float(linear_from_srgb(0.5)), 1.0F}));
  EXPECT_EQ(srgb_from_linear(std::array<double, 3>{0.0, linear_from_srgb(0.25), 2.0}),
            (std::array<float, 3>{0.0F, 0.25F, 1.0F}));
}

}  // namespace
}  // namespace icome::base
