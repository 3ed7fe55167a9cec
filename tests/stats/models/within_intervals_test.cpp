#include "stats/models/within_intervals.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::stats {
namespace {

/// Ten people before and after: the data of "Error bars for within-subjects variables" in the Cookbook for R
/// (Chang), which gives means 47.74 and 51.43 and half a 95 % interval of 1.618396 with Morey's correction.
const std::vector<std::vector<double>> kBeforeAndAfter = {
    {59.4, 64.5}, {46.4, 52.4}, {46.0, 49.7}, {49.0, 48.7}, {32.5, 37.4},
    {45.2, 49.5}, {60.3, 59.9}, {54.3, 54.1}, {45.4, 49.6}, {38.9, 48.5}};

TEST(WithinIntervals, AreThoseOfAPublishedExample) {
  const auto intervals = within_intervals(kBeforeAndAfter);
  ASSERT_TRUE(intervals) << intervals.error().message;
  EXPECT_NEAR((*intervals)[0].mean, 47.74, 1e-12);
  EXPECT_NEAR((*intervals)[1].mean, 51.43, 1e-12);
  for (const WithinInterval& it : *intervals) {
    EXPECT_NEAR(it.interval.high - it.mean, 1.618396, 5e-7);
    EXPECT_NEAR(it.mean - it.interval.low, 1.618396, 5e-7);
  }
}

TEST(WithinIntervals, LeaveNothingOfPeopleWhoDifferOnlyOverall) {
  const auto moved = without_person_differences({{1.0, 2.0, 4.0}, {11.0, 12.0, 14.0}});
  ASSERT_TRUE(moved);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR((*moved)[0][i], (*moved)[1][i], 1e-12);
  EXPECT_NEAR((*moved)[0][0], 6.0, 1e-12) << "the mean of the condition stays";
}

TEST(WithinIntervals, RefuseWhatIsNoTableOfPeopleAndConditions) {
  EXPECT_FALSE(within_intervals({}));
  EXPECT_FALSE(within_intervals({{1.0, 2.0}})) << "one person";
  EXPECT_FALSE(within_intervals({{1.0}, {2.0}})) << "one condition";
  EXPECT_FALSE(within_intervals({{1.0, 2.0}, {1.0}}));
  EXPECT_FALSE(within_intervals({{1.0, 2.0}, {1.0, NAN}}));
  EXPECT_FALSE(within_intervals(kBeforeAndAfter, 1.0));
}

}  // namespace
}  // namespace icome::stats
