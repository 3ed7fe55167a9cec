#include "files/single.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <sstream>

#include "base/random.h"

namespace icome::files {
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

}  // namespace
}  // namespace icome::files
