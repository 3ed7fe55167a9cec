#include "drawing/svg/svg_names.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>

namespace icome::drawing {
namespace {

std::string mm_text(double metres) {
  std::string text;
  append_mm(text, metres);
  return text;
}

TEST(SvgNames, WritesMetresAsMm) {
  EXPECT_EQ(mm_text(0.297), "297");
  EXPECT_EQ(mm_text(-0.0123456), "-12.3456");
  EXPECT_EQ(mm_text(0.0), "0");
  EXPECT_EQ(mm_text(1e-5), "0.01");
  EXPECT_EQ(mm_text(1.5e-20), "1.5e-17");
}

TEST(SvgNames, ReadsBackTheSameBits) {
  std::mt19937_64 random(24);
  for (int i = 0; i < 100000; ++i) {
    const auto number = std::bit_cast<double>(std::uint64_t(random()));
    if (!std::isfinite(number) || (number != 0.0 && std::abs(number) < 1e-300) || std::abs(number) > 1e300)
      continue;
    const auto read = metres_from_mm(mm_text(number));
    ASSERT_TRUE(read) << mm_text(number);
    ASSERT_EQ(*read, number) << mm_text(number);
  }
}

TEST(SvgNames, RefusesWhatIsNoNumber) {
  for (const char* const text : {"", "nan", "inf", "1e", "1e999999999999", "e3", "1 2", "1e+-3"})
    EXPECT_FALSE(metres_from_mm(text)) << text;
  EXPECT_EQ(metres_from_mm("+1.5E+2"), 0.15);
}

}  // namespace
}  // namespace icome::drawing
