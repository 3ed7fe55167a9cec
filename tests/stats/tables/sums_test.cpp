#include "stats/tables/sums.h"

#include <gtest/gtest.h>

#include <vector>

namespace icome::stats {
namespace {

TEST(Sums, KeepWhatAddingInTurnLoses) {
  // Adding from left to right gives 0.
  EXPECT_EQ(sum(std::vector{1.0, 1e100, 1.0, -1e100}), 2.0);
  EXPECT_EQ(sum({}), 0.0);
}

TEST(Sums, VarianceOfLargeNumbersThatDifferByLittle) {
  // 1e9 + {4, 7, 13, 16} have the variance 30; the textbook formula gives less than nothing.
  const std::vector values{1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16};
  EXPECT_EQ(mean(values), 1e9 + 10);
  EXPECT_EQ(variance(values), 30.0);
  EXPECT_EQ(squared_deviations(values), 90.0);
}

}  // namespace
}  // namespace icome::stats
