#include "stats/tests/fisher_exact.h"

#include "stats/test_samples.h"

namespace icome::stats {
namespace {

// p from R 4.2's fisher.test. Its odds ratios and intervals are found to about four digits only, so those
// here are the roots of the same equations, in R by uniroot(tol = 1e-14) over dhyper.
TEST(FisherExact, TeaTaster) {
  const CountTable tea = {{3, 1}, {1, 3}};
  const auto test = fisher_exact_2x2(tea);
  ASSERT_TRUE(test.has_value());
  expect_near(test->p, 0.485714285714286);  // 17 / 35
  expect_near(test->odds_ratio, 6.40831965819968);
  expect_near(test->interval.low, 0.211735595446578);
  expect_near(test->interval.high, 626.243530588814);
  const auto greater = fisher_exact_2x2(tea, {1.0, Alternative::Greater, 0.95});
  expect_near(greater->p, 17.0 / 70.0);
  expect_near(greater->interval.low, 0.313573767504985);
  EXPECT_EQ(greater->interval.high, kEndless);
  expect_near(fisher_exact_2x2(tea, {2.0, Alternative::TwoSided, 0.95})->p, 0.551401869158879);
}

TEST(FisherExact, ConvictionsOfTwins) {
  const CountTable convictions = {{2, 15}, {10, 3}};  // Fisher's, R's ?fisher.test
  const auto test = fisher_exact_2x2(convictions);
  expect_near(test->p, 0.000536724119143436);
  expect_near(test->odds_ratio, 0.04693663904968);
  expect_near(test->interval.low, 0.00331716395065736);
  expect_near(test->interval.high, 0.363189602356681);
  expect_near(fisher_exact_2x2(convictions, {1.0, Alternative::Less, 0.95})->p, 0.000465180943362905);
}

TEST(FisherExact, TablesWithZeros) {
  const auto none = fisher_exact_2x2({{0, 5}, {4, 3}});
  EXPECT_EQ(none->odds_ratio, 0.0);
  EXPECT_EQ(none->interval.low, 0.0);
  const auto all = fisher_exact_2x2({{5, 0}, {3, 4}});
  EXPECT_EQ(all->odds_ratio, kEndless);
  EXPECT_EQ(all->interval.high, kEndless);
  const auto empty = fisher_exact_2x2({{0, 0}, {3, 4}});
  EXPECT_EQ(empty->p, 1.0);
  EXPECT_TRUE(std::isnan(empty->odds_ratio));
  EXPECT_EQ(*fisher_exact_p({{0, 0, 0}, {3, 4, 5}}), 1.0);
  EXPECT_EQ(*fisher_exact_p({{0, 0}, {0, 0}}), 1.0);
}

TEST(FisherExact, LargerTables) {
  // R 4.2: fisher.test(Job) (Agresti 2002, p. 57; R's own help says 0.7827), and other tables.
  EXPECT_NEAR(*fisher_exact_p({{1, 3, 10, 6}, {2, 3, 10, 7}, {1, 6, 14, 12}, {0, 1, 9, 11}}),
              0.782684938965639, 1e-8);
  expect_near(*fisher_exact_p({{4, 8}, {1, 5}, {2, 9}}), 0.744166378349301);
  expect_near(*fisher_exact_p({{20, 16, 2}, {5, 9, 4}, {7, 30, 6}}), 0.00520509412446486);
  // Mehta and Patel (1986), table 6, in R's ?fisher.test (MP6).
  EXPECT_NEAR(*fisher_exact_p({{1, 2, 2, 1, 1, 0, 1},
                               {2, 0, 0, 2, 3, 0, 0},
                               {0, 1, 1, 1, 2, 7, 3},
                               {1, 1, 2, 0, 0, 0, 1},
                               {0, 1, 1, 1, 1, 0, 0}}),
              0.0392896436553323, 1e-10);
}

TEST(FisherExact, BothWaysAgreeAndOrderDoesNotMatter) {
  const CountTable table = {{63, 180}, {16, 180}};
  expect_near(*fisher_exact_p(table), fisher_exact_2x2(table)->p);
  expect_near(*fisher_exact_p({{8, 5, 9}, {4, 1, 2}}), *fisher_exact_p({{4, 8}, {1, 5}, {2, 9}}));
}

TEST(FisherExact, RefusesWhatItCannotDo) {
  expect_refused(fisher_exact_p({{32, 11, 10, 3}, {53, 50, 25, 15}, {10, 10, 7, 7}, {3, 30, 5, 8}}, 20'000),
                 "too large");
  expect_refused(fisher_exact_p({{1e12, 1}, {1, 1}}), "too large");
  expect_refused(fisher_exact_p({{1, 2}, {3, -4}}), "-4");
  expect_refused(fisher_exact_2x2({{1, 2, 3}, {3, 4, 5}}), "2 x 2");
  expect_refused(fisher_exact_2x2({{1, 2}, {3, 4}}, {0.0}), "above 0");
  expect_refused(fisher_exact_2x2({{1e9, 2e9}, {3e9, 1e9}}), "too many");
  expect_refused(fisher_exact_2x2({{1, 2}, {3, 4}}, {1.0, Alternative::Less, 2.0}), "confidence");
}

}  // namespace
}  // namespace icome::stats
