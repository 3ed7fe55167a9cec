#include "io/web_colours.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace icome::io {
namespace {

TEST(WebColour, KnowsNamesInAnyCase) {
  EXPECT_EQ(web_colour("gold"), 0xffd700ffU);  // CSS Color 4, 6.1
  EXPECT_EQ(web_colour("RebeccaPurple"), 0x663399ffU);
  EXPECT_EQ(web_colour("transparent"), 0x00000000U);
  EXPECT_FALSE(web_colour("golden"));
}

TEST(WebColour, NamesAreAlphabeticalAndKnown) {
  const std::vector<std::string_view> names = web_colour_names();
  EXPECT_EQ(names.size(), 148U);
  EXPECT_TRUE(std::ranges::is_sorted(names));
  for (const std::string_view name : names) EXPECT_TRUE(web_colour(name)) << name;
}

TEST(WebColour, ReadsDigitsInAllFourLengths) {
  EXPECT_EQ(web_colour("#1af"), 0x11aaffffU);
  EXPECT_EQ(web_colour("#1af8"), 0x11aaff88U);
  EXPECT_EQ(web_colour("#12abEF"), 0x12abefffU);
  EXPECT_EQ(web_colour("#12abef80"), 0x12abef80U);
  EXPECT_FALSE(web_colour("#12abe"));
  EXPECT_FALSE(web_colour("#12abeg"));
  EXPECT_FALSE(web_colour("#"));
}

}  // namespace
}  // namespace icome::io
