#include "stats/tests/rank_tests.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

// Hollander and Wolfe (1973): depression before and after (p. 29), permeability (p. 69); R's ?wilcox.test.
const std::vector<double> kBefore = {1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30};
const std::vector<double> kAfter = {0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29};
const std::vector<double> kTerm = {0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
const std::vector<double> kEarly = {1.15, 0.88, 0.90, 0.74, 1.21};

void expect_ranks(const base::Result<RankTest>& test, double statistic, double p, bool exact) {
  ASSERT_TRUE(test.has_value()) << test.error().message;
  EXPECT_DOUBLE_EQ(test->statistic, statistic);
  expect_near(test->p, p);
  EXPECT_EQ(test->exact, exact);
}

RankTestSettings approximate(bool continuity) {
  RankTestSettings settings;
  settings.method = RankMethod::Approximate;
  settings.continuity = continuity;
  return settings;
}

RankTestSettings against(Alternative alternative, double shift = 0.0) {
  RankTestSettings settings;
  settings.alternative = alternative;
  settings.null_shift = shift;
  return settings;
}

TEST(RankTests, EqualValuesShareTheirRanks) {
  EXPECT_EQ(ranks(std::vector{3.0, 1.0, 3.0, 2.0}), (std::vector{3.5, 1.0, 3.5, 2.0}));
  EXPECT_TRUE(ranks({}).empty());
}

TEST(RankTests, SignedRanksExactly) {
  // R 4.2: wilcox.test(x, y, paired = TRUE, alternative = "greater"): V = 40, p = 0.01953 (the book's, too).
  expect_ranks(signed_rank_test(kBefore, kAfter, against(Alternative::Greater)), 40, 0.01953125, true);
  const auto test = signed_rank_test(kBefore, kAfter);
  expect_ranks(test, 40, 0.0390625, true);
  EXPECT_DOUBLE_EQ(test->rank_biserial, (40.0 - 5.0) / 45.0);
  // wilcox.test((1:49) - 20.25).
  std::vector<double> many;
  for (int i = 1; i <= 49; ++i) many.push_back(i - 20.25);
  expect_ranks(signed_rank_test(many), 825, 0.0341261507155544, true);
}

TEST(RankTests, SignedRanksApproximately) {
  // R 4.2: wilcox.test(x, y, paired = TRUE, exact = FALSE), then correct = FALSE.
  expect_ranks(signed_rank_test(kBefore, kAfter, approximate(true)), 40, 0.0440109840129515, false);
  expect_ranks(signed_rank_test(kBefore, kAfter, approximate(false)), 40, 0.0381517101734152, false);
  // R 4.2: wilcox.test(a, b, paired = TRUE) of the sleep data, which has a tie and a zero.
  const auto test = signed_rank_test(kFirstDrug, kSecondDrug);
  expect_ranks(test, 0, 0.00909069801592506, false);
  EXPECT_EQ(test->zeros, 1u);
  EXPECT_EQ(test->ties, 2u);
  EXPECT_EQ(test->rank_biserial, -1.0);
}

TEST(RankTests, RankSumExactly) {
  // R 4.2: wilcox.test(x, y, alternative = "g"): W = 35, p = 0.1272; then two-sided.
  expect_ranks(rank_sum_test(kTerm, kEarly, against(Alternative::Greater)), 35, 0.127206127206127, true);
  const auto test = rank_sum_test(kTerm, kEarly);
  expect_ranks(test, 35, 0.254412254412254, true);
  EXPECT_DOUBLE_EQ(test->rank_biserial, 2.0 * 35.0 / 50.0 - 1.0);
  // wilcox.test(1:49 + 0.5, seq(10, 58) + 0.25).
  std::vector<double> first, second;
  for (int i = 1; i <= 49; ++i) {
    first.push_back(i + 0.5);
    second.push_back(i + 9.25);
  }
  expect_ranks(rank_sum_test(first, second), 820, 0.0065563649835856, true);
}

TEST(RankTests, RankSumApproximately) {
  // R 4.2: wilcox.test(x, y, exact = FALSE); wilcox.test(x, y, alternative = "l", mu = 0.3), which has ties.
  expect_ranks(rank_sum_test(kTerm, kEarly, approximate(true)), 35, 0.244623605126983, false);
  auto cars = shared_groups("r-datasets/mtcars.csv", "mpg", "am");
  if (cars.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  // wilcox.test(mpg ~ am, mtcars), then alternative = "less".
  expect_ranks(rank_sum_test(cars["0"], cars["1"]), 42, 0.00187139133317856, false);
  expect_ranks(rank_sum_test(cars["0"], cars["1"], against(Alternative::Less)), 42, 0.000935695666589278,
               false);
}

TEST(RankTests, KruskalWallis) {
  // R 4.2: kruskal.test(list(x, y, z)) of Hollander and Wolfe (1973), p. 116: H = 0.77143, p = 0.68.
  const auto test =
      kruskal_wallis({{2.9, 3.0, 2.5, 2.6, 3.2}, {3.8, 2.7, 4.0, 2.4}, {2.8, 3.4, 3.7, 2.2, 2.0}});
  ASSERT_TRUE(test.has_value());
  expect_near(test->h, 0.771428571428572);
  EXPECT_EQ(test->df, 2.0);
  expect_near(test->p, 0.679964773578894);
  expect_near(test->epsilon_squared, 0.771428571428572 / 13.0);
}

TEST(RankTests, KruskalWallisOfSharedData) {
  // R 4.2: kruskal.test(weight ~ group, PlantGrowth), kruskal.test(breaks ~ tension, warpbreaks); both with
  // ties.
  auto plants = shared_groups("r-datasets/PlantGrowth.csv", "weight", "group");
  auto warps = shared_groups("r-datasets/warpbreaks.csv", "breaks", "tension");
  if (plants.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const auto growth = kruskal_wallis({plants["ctrl"], plants["trt1"], plants["trt2"]});
  expect_near(growth->h, 7.98822874944372);
  expect_near(growth->p, 0.018423755731472);
  const auto breaks = kruskal_wallis({warps["L"], warps["M"], warps["H"]});
  expect_near(breaks->h, 10.8092652706172);
  expect_near(breaks->p, 0.00449570566138045);
}

TEST(RankTests, Friedman) {
  // Hollander and Wolfe (1973), p. 140; friedman.test.Rout.txt: 11.143, p = 0.003805; more digits from R 4.2.
  const auto test = friedman(kRoundingTimes);
  ASSERT_TRUE(test.has_value());
  expect_near(test->chi_squared, 11.1428571428571);
  EXPECT_EQ(test->df, 2.0);
  expect_near(test->p, 0.00380504077551136);
  expect_near(test->kendall_w, 11.1428571428571 / 44.0);
  // Every block in the same order is full concordance.
  EXPECT_DOUBLE_EQ(friedman({{1, 2, 3}, {4, 5, 6}, {0, 7, 9}})->kendall_w, 1.0);
}

TEST(RankTests, RefuseWhatCannotBeTested) {
  const std::vector<double> none, same = {2.0, 2.0}, hole = {1.0, kNotANumber};
  expect_refused(rank_sum_test(none, same), "first group");
  expect_refused(rank_sum_test(same, same), "equal");
  expect_refused(rank_sum_test(hole, same), "value 2");
  expect_refused(signed_rank_test(none), "0 values");
  expect_refused(signed_rank_test(std::vector{0.0, 0.0}), "no difference");
  expect_refused(signed_rank_test(same, none), "pairs");
  expect_refused(rank_sum_test(same, hole, against(Alternative::Less)), "value 2");
  expect_refused(rank_sum_test(kTerm, kEarly, against(Alternative::Less, kEndless)), "shift");
  RankTestSettings exact;
  exact.method = RankMethod::Exact;
  expect_refused(signed_rank_test(kFirstDrug, kSecondDrug, exact), "ties");
  expect_refused(rank_sum_test(kTerm, std::vector<double>(101, 9.0), exact), "ties");
  expect_refused(kruskal_wallis({kTerm}), "1 group");
  expect_refused(kruskal_wallis({kTerm, {}}), "group 2");
  expect_refused(kruskal_wallis({same, same}), "equal");
  expect_refused(friedman({{1, 2}, {1, 2, 3}}), "row 2");
  expect_refused(friedman({{1, 1}, {2, 2}}), "equal");
  expect_refused(friedman({{1, 2}}), "1 group");
}

TEST(RankTests, FindNothingAsOftenAsTheyShould) {
  base::Random random(8);
  // Exact tests have steps: of U for 7 and 8, P(p < 0.05) = 2 P(U <= 10) = 0.0401 (R 4.2: 2 * pwilcox(10, 7,
  // 8)).
  expect_false_positives([&] { return rank_sum_test(normal_sample(random, 7), normal_sample(random, 8))->p; },
                         0.0401);
  expect_false_positives([&] { return signed_rank_test(normal_sample(random, 60))->p; });
  expect_false_positives([&] {
    return kruskal_wallis({normal_sample(random, 20), normal_sample(random, 25), normal_sample(random, 30)})
        ->p;
  });
  expect_false_positives([&] {
    Groups blocks;
    for (int i = 0; i < 30; ++i) blocks.push_back(normal_sample(random, 4));
    return friedman(blocks)->p;
  });
}

}  // namespace
}  // namespace icome::stats
