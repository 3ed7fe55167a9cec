#include "stats/tests/contingency.h"

#include "stats/test_samples.h"
#include "stats/tests/binomial_test.h"
#include "stats/tests/fisher_exact.h"

namespace icome::stats {
namespace {

// Thesis 6.5, tables 6.1 to 6.5 as far as they can be recomputed: wrong and right clicks without and with
// head tracking, 63 of 243 and 16 of 196.
const CountTable kClicks = {{63, 243 - 63}, {16, 196 - 16}};
// Agresti (2007), p. 39: party by gender.
const CountTable kParties = {{762, 327, 468}, {484, 239, 477}};

TEST(Contingency, WrongClicksOfTheThesis) {
  // R 4.2: chisq.test(clicks, correct = FALSE), then with Yates's correction, and fisher.test(clicks).
  const auto test = contingency_test(kClicks);
  ASSERT_TRUE(test.has_value());
  expect_near(test->chi_squared, 23.1960111752155);
  EXPECT_EQ(test->df, 1.0);
  expect_near(test->p, 1.46300471280975e-06);
  expect_near(test->cramers_v, std::sqrt(23.1960111752155 / 439.0));
  EXPECT_LT(test->p, 0.001);  // what the thesis says
  const auto corrected = contingency_test(kClicks, Yates::On);
  expect_near(corrected->chi_squared, 22.0079560789671);
  expect_near(corrected->p, 2.7152260419283e-06);
  EXPECT_EQ(corrected->cramers_v, test->cramers_v);
  expect_near(fisher_exact_2x2(kClicks)->p, 8.35139245511913e-07);
}

TEST(Contingency, PreferenceOfTheThesis) {
  // 16 against 6 of 22, significant at 5 % by the chi-squared test that the thesis uses: R 4.2,
  // chisq.test(c(16, 6)).
  const auto test = goodness_of_fit(std::vector{16.0, 6.0});
  ASSERT_TRUE(test.has_value());
  expect_near(test->chi_squared, 4.54545454545455);
  expect_near(test->p, 0.0330062576612324);
  // The exact test stays just above: R 4.2, binom.test(16, 22).
  const auto exact = binomial_test(16, 22);
  expect_near(exact->p, 0.0524787902832032);
  expect_near(exact->interval.low, 0.497778798733651);
  expect_near(exact->interval.high, 0.892710751629603);
}

TEST(Contingency, DepthPerceptionOfTheThesis) {
  // 14 better, 7 same, 1 worse of 22: R 4.2, chisq.test(c(14, 7, 1)) and binom.test(14, 15), the sign test.
  const auto test = goodness_of_fit(std::vector{14.0, 7.0, 1.0});
  expect_near(test->chi_squared, 11.5454545454545);
  expect_near(test->p, 0.00311126067644443);
  EXPECT_TRUE(test->warning.empty());
  expect_near(sign_test(14, 1)->p, 0.0009765625);
}

TEST(Contingency, GoodnessOfFit) {
  // chisq.test.Rout.txt: 2.5, p = 0.2865; 9.9901, p = 0.04059; 5.7947, p = 0.215 with a warning. Digits:
  // R 4.2.
  expect_near(goodness_of_fit(std::vector{20.0, 15.0, 25.0})->p, 0.28650479686019);
  const std::vector<double> counts = {89, 37, 30, 28, 2};
  const auto first = goodness_of_fit(counts, std::vector{0.4, 0.2, 0.2, 0.15, 0.05});
  expect_near(first->chi_squared, 9.99014336917563);
  expect_near(first->p, 0.0405940433447812);
  const auto second = goodness_of_fit(counts, std::vector{0.4, 0.2, 0.2, 0.19, 0.01});
  expect_near(second->chi_squared, 5.79470854555744);
  expect_near(second->p, 0.215013095920786);
  EXPECT_NE(second->warning.find("1.86"), std::string::npos) << second->warning;
}

TEST(Contingency, PartiesByGender) {
  // chisq.test.Rout.txt: 30.07, df = 2, p = 2.954e-07, with residuals; digits from R 4.2.
  const auto test = contingency_test(kParties);
  expect_near(test->chi_squared, 30.0701490957547);
  EXPECT_EQ(test->df, 2.0);
  expect_near(test->p, 2.95358918321176e-07);
  EXPECT_NEAR(test->expected[0][1], 319.6453, 5e-5);
  expect_near(test->residuals[1][2], 3.23867344353658);
  expect_near(test->residuals[0][0], 2.1988557660159);
  // R 4.2: chisq.test(matrix(c(12, 5, 7, 7), 2)), 0.4233 in chisq.test.Rout.txt; then correct = FALSE.
  const CountTable small = {{12, 7}, {5, 7}};
  expect_near(contingency_test(small, Yates::On)->p, 0.423305424322418);
  expect_near(contingency_test(small)->p, 0.241529274763687);
}

TEST(Contingency, YatesTakesNoMoreThanTheDifference) {
  // R 4.2: chisq.test(matrix(c(10, 10, 10, 11), 2)): the difference is below 1/2, so 0 and p = 1.
  const auto test = contingency_test({{10, 10}, {10, 11}}, Yates::On);
  EXPECT_EQ(test->chi_squared, 0.0);
  EXPECT_EQ(test->p, 1.0);
}

TEST(Contingency, SharedHairAndEyes) {
  // R 4.2: chisq.test(apply(HairEyeColor, 1:2, sum)).
  const auto hair = shared_column("r-datasets/HairEyeColor.csv", "Hair");
  if (hair.empty()) GTEST_SKIP() << "the shared statistics data is not here";
  const auto eye = shared_column("r-datasets/HairEyeColor.csv", "Eye");
  const auto count = shared_numbers("r-datasets/HairEyeColor.csv", "Freq");
  std::map<std::string, std::map<std::string, double>> cells;
  for (std::size_t i = 0; i < hair.size(); ++i) cells[hair[i]][eye[i]] += count[i];
  CountTable table;
  for (const auto& [name, row] : cells) {
    table.emplace_back();
    for (const auto& [colour, sum] : row) table.back().push_back(sum);
  }
  const auto test = contingency_test(table);
  expect_near(test->chi_squared, 138.289841626008);
  EXPECT_EQ(test->df, 9.0);
  expect_near(test->p, 2.32528678709881e-25);
}

TEST(Contingency, McNemar) {
  // Agresti (1990), p. 350, R's ?mcnemar.test: approval twice. R 4.2, then correct = FALSE, then
  // binom.test(86, 236).
  const CountTable approval = {{794, 150}, {86, 570}};
  const auto test = mcnemar_test(approval);
  expect_near(test->chi_squared, 16.8177966101695);
  expect_near(test->p, 4.11456228134594e-05);
  expect_near(test->exact_p, 3.71593613957143e-05);
  expect_near(test->odds_ratio, 150.0 / 86.0);
  expect_near(mcnemar_test(approval, Yates::Off)->p, 3.09929344104522e-05);
  // R 4.2: mcnemar.test(matrix(c(10, 4, 7, 9, 20, 3, 5, 8, 30), 3)).
  const auto three = mcnemar_test({{10, 9, 5}, {4, 20, 8}, {7, 3, 30}});
  expect_near(three->chi_squared, 4.52913752913753);
  EXPECT_EQ(three->df, 3.0);
  expect_near(three->p, 0.209705964778846);
}

TEST(Contingency, RefuseWhatCannotBeTested) {
  expect_refused(goodness_of_fit(std::vector{3.0}), "at least two");
  expect_refused(goodness_of_fit(std::vector{0.0, 0.0}), "all counts are 0");
  expect_refused(goodness_of_fit(std::vector{1.0, -1.0}), "-1");
  expect_refused(goodness_of_fit(std::vector{1.0, 1.5}), "1.5");
  expect_refused(goodness_of_fit(std::vector{1.0, kNotANumber}), "nan");
  expect_refused(goodness_of_fit(std::vector{1.0, 2.0}, std::vector{1.0}), "one for each");
  expect_refused(goodness_of_fit(std::vector{1.0, 2.0}, std::vector{1.0, 0.0}), "above 0");
  expect_refused(goodness_of_fit(std::vector{1.0, 2.0}, std::vector{0.5, 0.6}), "sum to 1.1");
  expect_refused(contingency_test({}), "at least two rows");
  expect_refused(contingency_test({{1}, {2}}), "at least two rows");
  expect_refused(contingency_test({{1, 2}, {3}}), "differ in length");
  expect_refused(contingency_test({{1, 2}, {0, 0}}), "zeros only");
  expect_refused(contingency_test({{1, 0}, {2, 0}}), "zeros only");
  expect_refused(contingency_test({{1, 0.5}, {2, 0}}), "0.5");
  expect_refused(mcnemar_test({{1, 2, 3}, {3, 4, 5}}), "square");
  expect_refused(mcnemar_test({{5, 0}, {0, 5}}), "nobody changed");
}

TEST(Contingency, FindsNothingAsOftenAsItShould) {
  base::Random random(3);
  expect_false_positives([&] {
    CountTable table(2, std::vector<double>(3, 0.0));
    for (int i = 0; i < 150; ++i) table[random.index(2)][random.index(3)] += 1.0;
    return contingency_test(table)->p;
  });
  expect_false_positives([&] {
    std::vector<double> counts(5, 0.0);
    for (int i = 0; i < 200; ++i) counts[random.index(5)] += 1.0;
    return goodness_of_fit(counts)->p;
  });
}

}  // namespace
}  // namespace icome::stats
