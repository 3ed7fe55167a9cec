#include "base/near_names.h"

#include <gtest/gtest.h>

namespace icome::base {
namespace {

TEST(NearNames, TheNearestIsOffered) {
  EXPECT_EQ(suggestion("extrud", {"box", "extrude"}), "; did you mean 'extrude'?");
  EXPECT_EQ(suggestion("practise", {"measured", "practice"}), "; did you mean 'practice'?");
}

TEST(NearNames, WhereNoneIsNearAFewAreListed) {
  EXPECT_EQ(suggestion("q", {"b", "a", "a", ""}), "; there are a, b");
  EXPECT_EQ(suggestion("q", {}), "");
  EXPECT_EQ(suggestion("nothing", std::vector<std::string>(1, std::string(200, 'x'))),
            "; there are " + std::string(200, 'x'));
}

TEST(NearNames, DistanceCountsLetters) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);  // k to s, e to i, and a g
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("titel", "title"), 1U);  // neighbours that are swapped
  EXPECT_EQ(edit_distance("ab", "ba"), 1U);
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);
}

}  // namespace
}  // namespace icome::base
