#include "stats/tables/descriptives.h"

#include <gtest/gtest.h>

#include <numeric>

#include "stats/anova_test_data.h"

namespace icome::stats {
namespace {

using anova_data::expect_digits;

TEST(Descriptives, OfASmallSample) {
  const std::vector<double> values = {2.1, 4.7, 3.3, 9.8, NAN, 4.7, 1.2, 6.0, 3.9};
  const auto all = describe(values, 0.9);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->n, 8u);
  EXPECT_EQ(all->missing, 1u);
  // R 4.2, x <- c(2.1, 4.7, 3.3, 9.8, 4.7, 1.2, 6.0, 3.9): mean(x), median(x), sd(x), var(x), quantile(x)
  expect_digits(all->mean, 4.4625, 14);
  expect_digits(all->median, 4.3, 14);
  expect_digits(all->standard_deviation, 2.641935167367176, 13);
  expect_digits(all->variance, 6.97982142857143, 13);
  EXPECT_EQ(all->minimum, 1.2);
  EXPECT_EQ(all->maximum, 9.8);
  expect_digits(all->lower_quartile, 3.0, 14);
  expect_digits(all->upper_quartile, 5.025, 14);
  EXPECT_EQ(all->modes, std::vector<double>{4.7});
  // t.test(x, conf.level = 0.9)$conf.int; sd(x) / sqrt(8)
  expect_digits(all->standard_error, 0.934065136150273, 13);
  expect_digits(all->mean_low, 2.692840177289208, 12);
  expect_digits(all->mean_high, 6.232159822710792, 12);
  // n <- 8; m <- function(k) mean((x - mean(x))^k); sqrt(n*(n-1))/(n-2) * m(3)/m(2)^1.5;
  // (n-1)/((n-2)*(n-3)) * ((n+1)*(m(4)/m(2)^2 - 3) + 6)
  expect_digits(all->skewness, 1.09553430061444, 12);
  expect_digits(all->excess_kurtosis, 1.88131482624404, 12);
}

TEST(Descriptives, TooFewValuesLeaveSomeUndefined) {
  const auto one = describe(std::vector{3.0});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->mean, 3.0);
  EXPECT_EQ(one->upper_quartile, 3.0);
  EXPECT_TRUE(std::isnan(one->standard_deviation));
  EXPECT_TRUE(std::isnan(one->mean_low));
  const auto two = describe(std::vector{3.0, 4.0});
  EXPECT_FALSE(std::isnan(two->standard_deviation));
  EXPECT_TRUE(std::isnan(two->skewness));
  const auto equal = describe(std::vector(5, 0.1));
  EXPECT_EQ(equal->variance, 0.0);
  EXPECT_TRUE(std::isnan(equal->skewness));
  EXPECT_EQ(equal->mean_low, 0.1);
}

TEST(Descriptives, SeveralModesOrNone) {
  EXPECT_EQ(describe(std::vector{3.0, 1.0, 3.0, 1.0, 2.0})->modes, (std::vector{1.0, 3.0}));
  EXPECT_TRUE(describe(std::vector{3.0, 1.0, 2.0})->modes.empty());
}

TEST(Descriptives, WhatCannotBeDescribedIsSaid) {
  EXPECT_EQ(describe({}).error().message, "there are no values to describe: give at least one");
  EXPECT_FALSE(describe(std::vector<double>{NAN, NAN}));
  EXPECT_FALSE(describe(std::vector<double>{1.0, INFINITY}));
  EXPECT_FALSE(describe(std::vector{1.0}, 1.0));
  EXPECT_FALSE(describe(std::vector{1.0}, NAN));
  EXPECT_FALSE(z_scores(std::vector{1.0, 1.0}));
  EXPECT_FALSE(describe_outliers(std::vector{1.0, 2.0}, NAN));
}

TEST(Descriptives, QuantilesOfType7) {
  std::vector<double> values(10);
  std::iota(values.begin(), values.end(), 1.0);
  // R 4.2: quantile(1:10, c(0, .1, .333, 1))
  EXPECT_EQ(quantile(values, 0.0), 1.0);
  expect_digits(quantile(values, 0.1), 1.9, 14);
  expect_digits(quantile(values, 0.333), 3.997, 14);
  EXPECT_EQ(quantile(values, 1.0), 10.0);
}

TEST(Descriptives, ZScoresHaveMeanZeroAndSpreadOne) {
  const auto scores = z_scores(std::vector<double>{1.0, NAN, 2.0, 3.0});
  ASSERT_TRUE(scores);
  EXPECT_EQ((*scores)[0], -1.0);
  EXPECT_TRUE(std::isnan((*scores)[1]));
  EXPECT_EQ((*scores)[2], 0.0);
  EXPECT_EQ((*scores)[3], 1.0);
}

TEST(Descriptives, OutliersWithAndWithout) {
  // 50 is (50 - 14) / 12.7 = 2.8 standard deviations away.
  const std::vector<double> values = {9, 10, 11, 10, NAN, 50, 9, 10, 11, 10, 10};
  const auto report = describe_outliers(values);
  ASSERT_TRUE(report);
  EXPECT_EQ(report->outliers, std::vector<std::size_t>{5});
  EXPECT_EQ(report->with.n, 10u);
  EXPECT_EQ(report->with.mean, 14.0);
  ASSERT_TRUE(report->without);
  EXPECT_EQ(report->without->n, 9u);
  EXPECT_EQ(report->without->mean, 10.0);
  EXPECT_FALSE(describe_outliers(std::vector(4, 2.0))->without);
}

TEST(Descriptives, OfCellsThatOccur) {
  const std::vector<double> values = {1, 3, 5, 7, NAN, 9};
  const std::vector<Factor> factors = {anova_data::numbered("a", {1, 1, 0, 0, 0, kNoLevel}),
                                       anova_data::numbered("b", {0, 0, 1, 1, 2, 0})};
  const auto cells = describe_cells(values, factors);
  ASSERT_TRUE(cells);
  ASSERT_EQ(cells->size(), 3u);
  EXPECT_EQ((*cells)[0].levels, (std::vector{0, 1}));
  EXPECT_EQ((*cells)[0].description.mean, 6.0);
  EXPECT_EQ((*cells)[1].levels, (std::vector{0, 2}));
  EXPECT_EQ((*cells)[1].description.n, 0u);
  EXPECT_EQ((*cells)[1].description.missing, 1u);
  EXPECT_EQ((*cells)[2].levels, (std::vector{1, 0}));
  EXPECT_EQ((*cells)[2].description.mean, 2.0);
}

TEST(Descriptives, TheIntervalOfTheMeanHoldsItAsOftenAsItSays) {
  base::Random random(20262);
  int outside = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> values(6);
    for (double& value : values) value = anova_data::normal_value(random);
    const auto all = describe(values);
    outside += all->mean_low > 0.0 || all->mean_high < 0.0 ? 1 : 0;
  }
  anova_data::expect_level(outside);
}

}  // namespace
}  // namespace icome::stats
