#include "realtime/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/random.h"

namespace icome::realtime {
namespace {

// The definition itself: the smallest sample that at least `share` of all samples do not exceed.
double sorted_quantile(std::vector<std::int64_t> samples, double share) {
  std::sort(samples.begin(), samples.end());
  const auto rank = static_cast<std::size_t>(std::ceil(share * static_cast<double>(samples.size())));
  return static_cast<double>(samples[std::max<std::size_t>(rank, 1) - 1]);
}

TEST(DurationHistogram, IsZeroWhenEmpty) {
  DurationHistogram histogram;
  EXPECT_EQ(histogram.count(), 0u);
  EXPECT_EQ(histogram.mean(), 0.0);
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  EXPECT_EQ(histogram.max(), 0);
}

TEST(DurationHistogram, IsExactBelow256Nanoseconds) {
  DurationHistogram histogram;
  for (std::int64_t ns = 1; ns <= 100; ++ns) histogram.add(ns);
  EXPECT_EQ(histogram.quantile(0.5), 50.0);
  EXPECT_EQ(histogram.quantile(0.99), 99.0);
  EXPECT_EQ(histogram.quantile(1.0), 100.0);
  EXPECT_EQ(histogram.quantile(0.0), 1.0);
  EXPECT_EQ(histogram.mean(), 50.5);
}

TEST(DurationHistogram, AgreesWithSortedSamplesToAFifthOfAPercent) {
  base::Random random(5);
  DurationHistogram histogram;
  std::vector<std::int64_t> samples;
  for (int i = 0; i < 20000; ++i) {
    // From 10 ns to 10 s, evenly over the decades: tick times, periods and stalls alike.
    samples.push_back(static_cast<std::int64_t>(std::pow(10.0, random.uniform(1.0, 10.0))));
    histogram.add(samples.back());
  }
  for (double share : {0.01, 0.25, 0.5, 0.9, 0.99, 0.999, 0.9999}) {
    const double reference = sorted_quantile(samples, share);
    EXPECT_NEAR(histogram.quantile(share), reference, 0.002 * reference) << "at " << share;
  }
  EXPECT_EQ(histogram.max(), *std::max_element(samples.begin(), samples.end()));
}

TEST(DurationHistogram, CountsEachPowerOfTwoAndItsNeighboursOnce) {
  for (int bit = 8; bit < 36; ++bit) {
    for (std::int64_t offset : {-1, 0, 1}) {
      const std::int64_t value = (std::int64_t{1} << bit) + offset;
      DurationHistogram histogram;
      histogram.add(value);
      histogram.add(std::int64_t{1} << 40);  // so that the maximum does not stand in for the bucket
      EXPECT_NEAR(histogram.quantile(0.5), static_cast<double>(value), 0.002 * static_cast<double>(value));
      EXPECT_EQ(histogram.count(), 2u);
    }
  }
}

TEST(DurationHistogram, TakesNegativeAndHugeDurations) {
  DurationHistogram histogram;
  histogram.add(-5);
  EXPECT_EQ(histogram.quantile(0.5), 0.0);
  histogram.add(std::int64_t{1} << 50);
  EXPECT_EQ(histogram.count(), 2u);
  EXPECT_EQ(histogram.max(), std::int64_t{1} << 50);
}

}  // namespace
}  // namespace icome::realtime
