#include "stats/models/post_hoc.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

Groups plant_growth() {
  auto groups = shared_groups("r-datasets/PlantGrowth.csv", "weight", "group");
  return groups.empty() ? Groups{} : Groups{groups["ctrl"], groups["trt1"], groups["trt2"]};
}

Groups mpg_by_cylinders() {
  auto groups = shared_groups("r-datasets/mtcars.csv", "mpg", "cyl");
  return groups.empty() ? Groups{} : Groups{groups["4"], groups["6"], groups["8"]};
}

void expect_pair(const PairComparison& pair, double difference, double p) {
  expect_near(pair.difference, difference);
  EXPECT_NEAR(pair.p, p, 1e-9);
}

void expect_p(const base::Result<std::vector<PairComparison>>& pairs, const std::vector<double>& p_values) {
  ASSERT_TRUE(pairs.has_value()) << pairs.error().message;
  ASSERT_EQ(pairs->size(), p_values.size());
  for (std::size_t i = 0; i < p_values.size(); ++i) expect_near((*pairs)[i].p, p_values[i]);
}

TEST(PostHoc, HolmAndBonferroni) {
  // R 4.2: p.adjust(c(0.01, 0.04, 0.03, 0.005, NA, 0.2), "holm"), "bonferroni".
  const std::vector<double> p_values = {0.01, 0.04, 0.03, 0.005, kNotANumber, 0.2};
  const std::vector<double> by_holm = {0.04, 0.09, 0.09, 0.025, kNotANumber, 0.2};
  const std::vector<double> by_bonferroni = {0.05, 0.2, 0.15, 0.025, kNotANumber, 1.0};
  for (const std::size_t i : {0, 1, 2, 3, 5}) {
    expect_near(holm(p_values)[i], by_holm[i]);
    expect_near(bonferroni(p_values)[i], by_bonferroni[i]);
  }
  EXPECT_TRUE(std::isnan(holm(p_values)[4]));
  EXPECT_TRUE(holm({}).empty());
}

TEST(PostHoc, TukeyOfPlantGrowth) {
  // R 4.2: TukeyHSD(aov(weight ~ group, PlantGrowth)); its intervals with the exact quantile (see
  // studentized_range_test.cpp): uniroot(ptukey) * sqrt(MSE / 10).
  const Groups groups = plant_growth();
  if (groups.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const auto pairs = tukey_hsd(groups);
  ASSERT_TRUE(pairs.has_value());
  expect_pair((*pairs)[0], -0.371, 0.390871144202125);
  expect_pair((*pairs)[1], 0.494, 0.197995991299708);
  expect_pair((*pairs)[2], 0.865, 0.0120064239794527);
  EXPECT_EQ((*pairs)[2].first, 1u);
  EXPECT_EQ((*pairs)[2].second, 2u);
  expect_near((*pairs)[0].interval.high, -0.371 + 0.691216051403596);
}

TEST(PostHoc, TukeyKramerOfUnequalGroups) {
  // R 4.2: TukeyHSD(aov(mpg ~ factor(cyl), mtcars)), of 11, 7 and 14 cars.
  const Groups groups = mpg_by_cylinders();
  if (groups.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const auto pairs = tukey_hsd(groups);
  expect_pair((*pairs)[0], -6.92077922077922, 0.000342372049701112);
  expect_pair((*pairs)[1], -11.5636363636364, 2.54398024868152e-09);
  expect_pair((*pairs)[2], -4.64285714285714, 0.0112286813531052);
  EXPECT_NEAR((*pairs)[0].interval.low, -10.7693498289673, 1e-5);  // R's qtukey has four digits
}

TEST(PostHoc, TukeyOfAFactorialDesign) {
  // R 4.2: TukeyHSD(aov(breaks ~ wool + tension, warpbreaks), "tension"), with that analysis's error term; p
  // also in warpbreaks.Rout.txt.
  const auto pairs =
      tukey_hsd({{36.3888888888889, 26.3888888888889, 21.6666666666667}, {18, 18, 18}, 134.957777777778, 50});
  ASSERT_TRUE(pairs.has_value());
  expect_pair((*pairs)[0], -10.0, 0.0336262189113792);
  expect_pair((*pairs)[1], -14.7222222222222, 0.00112178771703253);
  expect_pair((*pairs)[2], -4.7222222222222, 0.447421021431457);
}

TEST(PostHoc, PairwiseTTests) {
  // R 4.2: pairwise.t.test(mpg, cyl), p.adjust.method = "bonferroni", pool.sd = FALSE with "none".
  const Groups cars = mpg_by_cylinders();
  if (cars.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  expect_p(pairwise_t_tests(cars), {0.000238939228663175, 2.57046274389791e-09, 0.0041522085362088});
  expect_p(pairwise_t_tests(cars, Adjustment::Bonferroni),
           {0.000358408842994763, 2.57046274389791e-09, 0.0124566256086264});
  expect_p(pairwise_t_tests(cars, Adjustment::None, PairwiseError::Separate),
           {0.000404849534170228, 1.6413477331304e-06, 4.5403546151771e-05});
  expect_p(pairwise_t_tests(plant_growth()), {0.194387880054301, 0.175363350125367, 0.0133777078146164});
}

TEST(PostHoc, PairwisePairedTests) {
  // R 4.2: pairwise.t.test(c(RoundingTimes), rep(1:3, each = 22), paired = TRUE), the data of ?friedman.test.
  Groups ways(3);
  for (const auto& player : kRoundingTimes)
    for (std::size_t i = 0; i < 3; ++i) ways[i].push_back(player[i]);
  expect_p(pairwise_t_tests(ways, Adjustment::Holm, PairwiseError::Paired),
           {0.732481326855865, 0.0284153313727484, 0.00202632071278553});
}

TEST(PostHoc, RefusesWhatCannotBeCompared) {
  expect_refused(tukey_hsd(Groups{{1, 2}}), "1 group");
  expect_refused(tukey_hsd(Groups{{1, 2}, {}}), "group 2");
  expect_refused(tukey_hsd(Groups{{1}, {2}}), "single value");
  expect_refused(tukey_hsd(Groups{{1, 1}, {2, 2}}), "no variance");
  expect_refused(tukey_hsd(Groups{{1e308, 2e307}, {2, 3}}), "too large to square");
  expect_refused(tukey_hsd(Groups{{1, 2}, {2, kNotANumber}}), "group 2");
  expect_refused(tukey_hsd(Groups{{1, 2}, {2, 4}}, 1.0), "confidence");
  expect_refused(tukey_hsd({{1, 2}, {3}, 1, 5}), "a count for each");
  expect_refused(tukey_hsd({{1, 2}, {3, 0}, 1, 5}), "above 0");
  expect_refused(tukey_hsd({{1, 2}, {3, 3}, 0, 5}), "no variance");
  expect_refused(tukey_hsd({{1, 2}, {3, 3}, 1, 0}), "degree of freedom");
  expect_refused(pairwise_t_tests({{1, 1}, {2, 2}}), "no variance");
  expect_refused(pairwise_t_tests({{1, 2}, {1, 2, 3}}, Adjustment::Holm, PairwiseError::Paired), "pairs");
  expect_refused(pairwise_t_tests({{1, 2}, {3}}, Adjustment::Holm, PairwiseError::Separate), "group 2");
}

TEST(PostHoc, FindsSomethingAsSeldomAsItShould) {
  base::Random random(21);
  const auto least_p = [](const base::Result<std::vector<PairComparison>>& pairs) {
    double least = 1.0;
    for (const PairComparison& pair : *pairs) least = std::min(least, pair.p);
    return least;
  };
  const auto draw = [&random] {
    Groups groups;
    for (int i = 0; i < 4; ++i) groups.push_back(normal_sample(random, 8));
    return groups;
  };
  // Tukey's family-wise rate is exact for equal counts; Holm's is at most 0.05, a little less for dependent
  // pairs.
  expect_false_positives([&] { return least_p(tukey_hsd(draw())); }, 0.05, 500);
  expect_false_positives([&] { return least_p(pairwise_t_tests(draw())); }, 0.042, 1000);
}

}  // namespace
}  // namespace icome::stats
