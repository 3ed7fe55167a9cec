#include "stats/tests/correlation.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

// Hollander and Wolfe (1973), p. 187: lightness and panel score of tuna, R's ?cor.test.
const std::vector<double> kLightness = {44.4, 45.9, 41.9, 53.3, 44.7, 44.1, 50.7, 45.2, 60.1};
const std::vector<double> kScore = {2.6, 3.1, 2.5, 5.0, 3.6, 4.0, 5.2, 2.8, 3.8};

std::vector<double> joined_with(std::vector<double> values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
  return values;
}

std::vector<double> negative(std::vector<double> values) {
  for (double& value : values) value = -value;
  return values;
}

TEST(Correlation, Pearson) {
  // R 4.2: cor.test(x, y).
  const auto test = pearson(kLightness, kScore);
  ASSERT_TRUE(test.has_value());
  expect_near(test->r, 0.571181557563829);
  expect_near(test->p, 0.108173054349494);
  expect_near(test->interval.low, -0.149742633036757);
  expect_near(test->interval.high, 0.895579461838739);
  EXPECT_EQ(test->df, 7.0);
}

TEST(Correlation, SmallDifferencesBetweenLargeValuesKeepTheirDigits) {
  std::vector<double> x, far, y;
  for (int i = 0; i < 12; ++i) {
    x.push_back(3.0 * i + (i % 3) * 7.0);
    far.push_back(1e15 + x.back());  // exact
    y.push_back(std::sin(2.0 * i));
  }
  EXPECT_DOUBLE_EQ(pearson(x, far)->r, 1.0);
  EXPECT_NEAR(pearson(far, y)->r, pearson(x, y)->r, 1e-15);
}

TEST(Correlation, PearsonOfSharedCars) {
  // R 4.2: cor.test(mtcars$mpg, mtcars$wt), then alternative = "less", conf.level = 0.9.
  const auto mpg = shared_numbers("r-datasets/mtcars.csv", "mpg");
  const auto wt = shared_numbers("r-datasets/mtcars.csv", "wt");
  if (mpg.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const auto test = pearson(mpg, wt);
  expect_near(test->r, -0.867659376517228);
  expect_near(test->t, -9.55904414697211);
  expect_near(test->p, 1.29395870135052e-10);
  expect_near(test->interval.low, -0.933826413284994);
  expect_near(test->interval.high, -0.744087196460113);
  const auto less = pearson(mpg, wt, {Alternative::Less, 0.9});
  expect_near(less->p, 6.46979350675258e-11);
  EXPECT_EQ(less->interval.low, -1.0);
  expect_near(less->interval.high, -0.795249270134097);
  // cor.test(mpg, wt, method = "spearman") and of hp, wt; with ties, so by t.
  expect_near(spearman(mpg, wt)->rho, -0.886422033270298);
  expect_near(spearman(mpg, wt)->p, 1.48759485812743e-11);
  const auto rank = spearman(shared_numbers("r-datasets/mtcars.csv", "hp"), wt);
  expect_near(rank->rho, 0.774676733391384);
  expect_near(rank->s, 1229.36374261661);
  expect_near(rank->p, 1.95379549457803e-07);
  EXPECT_FALSE(rank->exact);
}

TEST(Correlation, CriticalValuesOfTheLookupTable) {
  // R 4.2: q <- qt(0.975, df); q / sqrt(df + q^2). Printed tables have 0.576 and 0.423 for 10 and 20.
  expect_near(critical_r(10), 0.575982986442264);
  expect_near(critical_r(20), 0.422713504166002);
  expect_near(critical_r(437), 0.0936053846106966);
  const auto test = pearson(kLightness, kScore);
  EXPECT_EQ(test->critical_r, critical_r(7));
  EXPECT_EQ(std::abs(test->r) > test->critical_r, test->p < 0.05);
}

TEST(Correlation, KeepsDigits) {
  // 2^40 + {1, 2, 3, 4} against {1, 3, 2, 4}: 0.8 whatever the offset and the unit.
  const std::vector<double> x = {0x1p40 + 1, 0x1p40 + 2, 0x1p40 + 3, 0x1p40 + 4};
  expect_near(pearson(x, std::vector{1e-200, 3e-200, 2e-200, 4e-200})->r, 0.8, 1e-14);
  expect_near(pearson(x, std::vector{1e300, 3e300, 2e300, 4e300})->r, 0.8, 1e-14);
  const auto full = pearson(x, x);
  EXPECT_EQ(full->r, 1.0);
  EXPECT_EQ(full->p, 0.0);
  EXPECT_EQ(full->interval.high, 1.0);
}

TEST(Correlation, SpearmanExactly) {
  // R 4.2: cor.test(x, y, method = "spearman"): S = 48, p = 0.0968; one-sided, mirrored.
  const auto test = spearman(kLightness, kScore);
  ASSERT_TRUE(test.has_value());
  expect_near(test->rho, 0.6);
  EXPECT_EQ(test->s, 48.0);
  EXPECT_TRUE(test->exact);
  expect_near(test->p, 0.0967978395061728);
  expect_near(spearman(kLightness, kScore, Alternative::Greater)->p, 0.0483989197530864);
  expect_near(spearman(kLightness, negative(kScore), Alternative::Less)->p, 0.0483989197530864);
}

TEST(Correlation, SpearmanBySeries) {
  // R 4.2: the same with three more pairs (12: AS 89); less; negated.
  const std::vector<double> x = joined_with(kLightness, {47.3, 49.9, 55.5});
  const std::vector<double> y = joined_with(kScore, {1.9, 4.4, 5.9});
  const auto test = spearman(x, y);
  expect_near(test->rho, 0.615384615384615);
  EXPECT_EQ(test->s, 110.0);
  EXPECT_FALSE(test->exact);
  expect_near(test->p, 0.0373345113663698);
  expect_near(spearman(x, negative(y))->p, 0.0373345113663698);
  expect_near(spearman(x, y, Alternative::Less)->p, 0.982599938572328);
  expect_near(spearman(x, negative(y), Alternative::Less)->p, 0.0186672556831849);
}

TEST(Correlation, MatrixUsesCompletePairs) {
  const std::vector<double> holed = {2.6, kNotANumber, 2.5, 5.0, 3.6, 4.0, 5.2, 2.8, 3.8};
  const std::vector<double> level(9, 1.0);
  const auto matrix = correlation_matrix({kLightness, kScore, holed, level});
  ASSERT_TRUE(matrix.has_value());
  expect_near(matrix->r(0, 1), 0.571181557563829);
  EXPECT_EQ(matrix->r(0, 1), matrix->r(1, 0));
  EXPECT_EQ(matrix->counts(0, 1), 9);
  EXPECT_EQ(matrix->counts(2, 0), 8);
  EXPECT_NEAR(matrix->r(1, 2), 1.0, 1e-15);
  EXPECT_EQ(matrix->r(2, 2), 1.0);
  EXPECT_TRUE(std::isnan(matrix->r(3, 0)) && std::isnan(matrix->p(3, 0)));
  const auto by_rank = correlation_matrix({kLightness, kScore}, CorrelationKind::Spearman);
  expect_near(by_rank->r(0, 1), 0.6);
  expect_near(by_rank->p(1, 0), 0.0967978395061728);
}

TEST(Correlation, RefusesWhatCannotBeTested) {
  const std::vector<double> two = {1.0, 2.0}, same = {1.0, 1.0, 1.0}, hole = {1.0, kNotANumber, 3.0};
  expect_refused(pearson(two, two), "at least 3");
  expect_refused(pearson(two, same), "in pairs");
  expect_refused(pearson(same, std::vector{1.0, 2.0, 3.0}), "does not vary");
  expect_refused(pearson(hole, same), "value 2 of x");
  expect_refused(spearman({}, {}), "0 values");
  expect_refused(spearman(std::vector{1.0, 2.0, 3.0}, same), "does not vary");
  expect_refused(pearson(kLightness, kScore, {Alternative::Less, 0.0}), "confidence");
  expect_refused(correlation_matrix({two}), "two columns");
  expect_refused(correlation_matrix({two, same}), "differ in length");
  expect_refused(correlation_matrix({two, {1.0, kEndless}}), "infinite");
}

TEST(Correlation, FindsNothingAsOftenAsItShould) {
  base::Random random(11);
  expect_false_positives([&] { return pearson(normal_sample(random, 10), normal_sample(random, 10))->p; });
  expect_false_positives([&] { return spearman(normal_sample(random, 25), normal_sample(random, 25))->p; });
}

}  // namespace
}  // namespace icome::stats
