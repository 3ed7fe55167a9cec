#include "sketch/tools/attraction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace icome::sketch {
namespace {

TEST(Attraction, TakesWhatIsNearAndLeavesWhatIsFar) {
  EXPECT_EQ(attracted(0.0101, 0.005, 0.001), 0.01);
  EXPECT_EQ(attracted(-0.0153, 0.005, 0.001), -0.015);
  EXPECT_EQ(attracted(0.0123, 0.005, 0.001), 0.0123);
  EXPECT_NEAR(attracted(0.01075, 0.005, 0.001), 0.0105, 1e-15);
}

/// Whoever drags on feels no jump, and comes to every value.
TEST(Attraction, NeverJumpsAndNeverGoesBack) {
  base::Random random(4);
  for (int round = 0; round < 1000; ++round) {
    const double step = std::exp(random.uniform(-9, 9)), within = random.uniform(0.01, 0.5) * step;
    double before = attracted(-2.0 * step, step, within);
    constexpr int kParts = 400;
    for (int i = 1; i <= kParts; ++i) {
      const double value = step * (-2.0 + 4.0 * i / kParts);
      const double now = attracted(value, step, within);
      ASSERT_GE(now, before - 1e-12 * step);
      ASSERT_LE(now - before, 2.001 * 4.0 * step / kParts);
      ASSERT_LE(std::abs(now - value), 0.5001 * within);
      before = now;
    }
  }
}

}  // namespace
}  // namespace icome::sketch
