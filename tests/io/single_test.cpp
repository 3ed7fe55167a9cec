#include "io/single.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "base/random.h"

namespace icome::io {
namespace {

TEST(FromSingle, ReadsDecimalsAsTheyWereWritten) {
  EXPECT_EQ(from_single(0.1F), 0.1);
  EXPECT_EQ(from_single(-0.9F), -0.9);
  EXPECT_EQ(from_single(1.57079F), 1.57079);
  EXPECT_EQ(from_single(1e-20F), 1e-20);
  EXPECT_EQ(from_single(3e38F), 3e38);
  EXPECT_EQ(from_single(123456.7F), 123456.7);
  EXPECT_EQ(from_single(16777216.0F), 16777216.0);
}

TEST(FromSingle, KeepsZerosAndWhatIsNotFinite) {
  EXPECT_EQ(from_single(0.0F), 0.0);
  EXPECT_TRUE(std::signbit(from_single(-0.0F)));
  EXPECT_TRUE(std::isnan(from_single(std::numeric_limits<float>::quiet_NaN())));
  EXPECT_EQ(from_single(std::numeric_limits<float>::infinity()), std::numeric_limits<double>::infinity());
}

TEST(FromSingle, GivesTheSameFloatBack) {
  base::Random random(7);
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<float>(std::uint32_t(random.bits() >> 32));
    if (!std::isfinite(value)) continue;
    ASSERT_EQ(static_cast<float>(from_single(value)), value);
  }
}

TEST(FromShortSingle, GivesBackWhatPeopleWrite) {
  for (const double written : {0.1, -0.3, 1.25, 3.141593, 12.5, 99.9, 123.45, 1000.1, 0.000001})
    EXPECT_EQ(from_short_single(static_cast<float>(written)), written);
}

TEST(FromShortSingle, LeavesOtherNumbersAsTheyAre) {
  for (const float value : {179.828125F, 1.0F / 3.0F, 1e-9F, 1e9F, -0.0F, 123456.7F})
    EXPECT_EQ(from_short_single(value), double(value));
  EXPECT_TRUE(std::isnan(from_short_single(std::numeric_limits<float>::quiet_NaN())));
}

TEST(FromShortSingle, NeverLeavesTheFloat) {
  base::Random random(3);
  for (int i = 0; i < 100'000; ++i) {
    const auto value = std::bit_cast<float>(static_cast<std::uint32_t>(random.bits()));
    if (std::isfinite(value)) {
      EXPECT_EQ(static_cast<float>(from_short_single(value)), value);
    }
  }
}

}  // namespace
}  // namespace icome::io
