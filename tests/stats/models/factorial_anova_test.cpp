#include <gtest/gtest.h>

#include <array>

#include "stats/anova_test_data.h"
#include "stats/models/anova.h"
#include "stats/tables/sums.h"

namespace icome::stats {
namespace {

using anova_data::expect_digits;
using anova_data::row_of;

/// Tooth length by supplement and dose (R's ToothGrowth; Crampton 1947).
struct ToothGrowth {
  std::vector<double> lengths;
  std::vector<Factor> factors;
};

/// Without some rows, counted from 1 as R does. Nothing where there is no shared data.
ToothGrowth tooth_growth(std::vector<std::size_t> left_out = {}) {
  auto columns = anova_data::csv_columns(anova_data::shared_file("r-datasets/ToothGrowth.csv"));
  if (columns.empty()) return {};
  for (std::size_t& row : left_out) --row;
  for (auto& [name, column] : columns) column = anova_data::without_rows(column, left_out);
  return {anova_data::numbers(columns["len"]),
          {factor_of("supp", columns["supp"]), factor_of("dose", columns["dose"])}};
}
const std::vector<std::size_t> kLeftOut = {1, 2, 3, 12, 35, 59};

/// A row against Df, Sum Sq, F value, Pr(>F).
void expect_factorial_row(const Anova& anova, const char* term, int df, double ss, double f, double p) {
  SCOPED_TRACE(term);
  const AnovaTerm& row = row_of(anova.terms, term);
  EXPECT_EQ(row.df, df);
  expect_digits(row.ss, ss, 11);
  expect_digits(row.f, f, 10);
  expect_digits(row.p, p, 8);
}

TEST(FactorialAnova, BalancedTypesAgree) {
  const ToothGrowth data = tooth_growth();
  if (data.lengths.empty()) GTEST_SKIP() << "no shared data: ToothGrowth.csv";
  for (const auto type : {SumsOfSquares::TypeI, SumsOfSquares::TypeII, SumsOfSquares::TypeIII}) {
    const auto anova = factorial_anova(data.lengths, data.factors, {type});
    ASSERT_TRUE(anova) << anova.error().message;
    // R 4.2: anova(lm(len ~ supp * factor(dose), ToothGrowth))
    expect_factorial_row(*anova, "supp", 1, 205.35, 15.5719794524972, 0.000231182809773424);
    expect_factorial_row(*anova, "dose", 2, 2426.434333333333, 91.9999648928671, 4.04629119599225e-18);
    expect_factorial_row(*anova, "supp:dose", 2, 108.319, 4.10699109402252, 0.021860268964791);
    EXPECT_EQ(anova->residual.df, 54);
    expect_digits(anova->residual.ss, 712.106, 12);
    EXPECT_TRUE(anova->warnings.empty());
  }
}

TEST(FactorialAnova, UnbalancedTypeI) {
  const ToothGrowth data = tooth_growth(kLeftOut);
  if (data.lengths.empty()) GTEST_SKIP() << "no shared data: ToothGrowth.csv";
  const auto anova = factorial_anova(data.lengths, data.factors, {SumsOfSquares::TypeI});
  ASSERT_TRUE(anova);
  // R 4.2: u <- ToothGrowth[-c(1, 2, 3, 12, 35, 59), ]; anova(lm(len ~ supp * factor(dose), u))
  expect_factorial_row(*anova, "supp", 1, 85.4486121286125, 6.11648485058689, 0.016984623312076);
  expect_factorial_row(*anova, "dose", 2, 2034.85421451121, 72.8283038551722, 2.89077317650685e-15);
  expect_factorial_row(*anova, "supp:dose", 2, 109.617194524206, 3.92324634051391, 0.0264172749284772);
  expect_digits(anova->residual.ss, 670.570349206349, 12);
}

TEST(FactorialAnova, UnbalancedTypeII) {
  const ToothGrowth data = tooth_growth(kLeftOut);
  if (data.lengths.empty()) GTEST_SKIP() << "no shared data: ToothGrowth.csv";
  const auto anova = factorial_anova(data.lengths, data.factors, {SumsOfSquares::TypeII});
  ASSERT_TRUE(anova);
  // R 4.2: anova(lm(len ~ dose, u), lm(len ~ supp + dose, u), lm(len ~ supp * dose, u)), row 2, and likewise
  expect_factorial_row(*anova, "supp", 1, 153.676272058919, 11.0002791915248, 0.00174178077821624);
  expect_factorial_row(*anova, "dose", 2, 2034.8542145112, 72.8283038551721, 2.89077317650688e-15);
  expect_factorial_row(*anova, "supp:dose", 2, 109.617194524206, 3.92324634051391, 0.0264172749284772);
}

TEST(FactorialAnova, UnbalancedTypeIII) {
  const ToothGrowth data = tooth_growth(kLeftOut);
  if (data.lengths.empty()) GTEST_SKIP() << "no shared data: ToothGrowth.csv";
  const auto anova = factorial_anova(data.lengths, data.factors, {SumsOfSquares::TypeIII});
  ASSERT_TRUE(anova);
  // R 4.2, contr.sum: drop1(lm(len ~ supp * dose, u), . ~ ., test = "F")
  expect_factorial_row(*anova, "supp", 1, 160.678374841643, 11.5014957066429, 0.00140021904327257);
  expect_factorial_row(*anova, "dose", 2, 2024.29867703844, 72.4505166481384, 3.17512188235656e-15);
  expect_factorial_row(*anova, "supp:dose", 2, 109.617194524206, 3.92324634051391, 0.0264172749284772);
}

TEST(FactorialAnova, MainEffectsOnlyPoolTheLackOfFit) {
  const ToothGrowth data = tooth_growth(kLeftOut);
  if (data.lengths.empty()) GTEST_SKIP() << "no shared data: ToothGrowth.csv";
  const auto anova = factorial_anova(data.lengths, data.factors, {SumsOfSquares::TypeI, 1});
  ASSERT_TRUE(anova);
  ASSERT_EQ(anova->terms.size(), 2u);
  // R 4.2: anova(lm(len ~ supp + dose, u))
  expect_factorial_row(*anova, "supp", 1, 85.4486121286125, 5.47615844518808, 0.0233098607486988);
  expect_factorial_row(*anova, "dose", 2, 2034.85421451121, 65.2040086663432, 1.16910701477833e-14);
  EXPECT_EQ(anova->residual.df, 50);
  expect_digits(anova->residual.ss, 780.187543730556, 12);
}

TEST(FactorialAnova, MissingCell) {
  auto columns = anova_data::csv_columns(anova_data::shared_file("r-datasets/warpbreaks.csv"));
  if (columns.empty()) GTEST_SKIP() << "no shared data: warpbreaks.csv";
  for (std::size_t i = 0; i < columns["wool"].size(); ++i) {
    if (columns["wool"][i] == "B" && columns["tension"][i] == "H") columns["breaks"][i] = "NA";
  }
  const std::vector<double> breaks = anova_data::numbers(columns["breaks"]);
  const std::vector<Factor> factors = {factor_of("wool", columns["wool"]),
                                       factor_of("tension", columns["tension"])};
  // R 4.2: w <- subset(warpbreaks, !(wool == "B" & tension == "H")); anova(lm(breaks ~ wool * tension, w))
  const auto first = factorial_anova(breaks, factors, {SumsOfSquares::TypeI});
  ASSERT_TRUE(first);
  expect_factorial_row(*first, "wool", 1, 69.5148148148149, 0.500686913955691, 0.483301108174284);
  expect_factorial_row(*first, "tension", 2, 1467.12962962963, 5.28356875141717, 0.00920094489234776);
  expect_factorial_row(*first, "wool:tension", 1, 1002.77777777778, 7.22260013604898, 0.0104390106153057);
  EXPECT_EQ(first->residual.df, 40);
  EXPECT_EQ(anova_data::warnings_with(first->warnings, "1 of 6 combinations"), 1);
  EXPECT_EQ(anova_data::warnings_with(first->warnings, "'wool:tension' is estimated in part: 1 of its 2"), 1);
  // contr.sum: drop1(lm(breaks ~ wool * tension, w), . ~ ., test = "F")
  const auto third = factorial_anova(breaks, factors, {SumsOfSquares::TypeIII});
  ASSERT_TRUE(third);
  EXPECT_EQ(row_of(third->terms, "wool").df, 0);
  EXPECT_TRUE(std::isnan(row_of(third->terms, "wool").p));
  expect_factorial_row(*third, "tension", 1, 900.0, 6.48233364011044, 0.0148512193133713);
  EXPECT_EQ(anova_data::warnings_with(third->warnings, "'wool' cannot be estimated"), 1);
  EXPECT_EQ(anova_data::warnings_with(third->warnings, "prefer type II"), 1);
}

TEST(FactorialAnova, ThreeFactorsWithManyMissingCells) {
  auto columns = anova_data::csv_columns(anova_data::shared_file("r-datasets/mtcars.csv"));
  if (columns.empty()) GTEST_SKIP() << "no shared data: mtcars.csv";
  const std::vector<Factor> factors = {factor_of("cyl", columns["cyl"]), factor_of("am", columns["am"]),
                                       factor_of("gear", columns["gear"])};
  const auto anova = factorial_anova(anova_data::numbers(columns["mpg"]), factors, {SumsOfSquares::TypeI});
  ASSERT_TRUE(anova);
  // R 4.2: anova(lm(mpg ~ factor(cyl) * factor(am) * factor(gear), mtcars))
  expect_factorial_row(*anova, "cyl", 2, 824.784590097403, 38.8735390561001, 6.00824285351018e-08);
  expect_factorial_row(*anova, "am", 1, 36.7669194925444, 3.4657783329757, 0.0760647852739896);
  expect_factorial_row(*anova, "gear", 2, 6.73720765509536, 0.317536370167242, 0.731220990297441);
  expect_factorial_row(*anova, "cyl:am", 2, 18.8883164088037, 0.890239359994463, 0.424837618177637);
  expect_factorial_row(*anova, "cyl:gear", 2, 5.48182051282052, 0.258367780341887, 0.774621928606408);
  EXPECT_EQ(anova->residual.df, 22);
  EXPECT_EQ(row_of(anova->terms, "am:gear").df, 0);
  EXPECT_EQ(row_of(anova->terms, "cyl:am:gear").df, 0);
}

/// Two factors of 3 and 2 levels, `each` observations in cell (i, j).
std::vector<Factor> three_by_two(const std::vector<int>& each) {
  std::vector<int> a, b;
  for (int cell = 0; cell < 6; ++cell) {
    a.insert(a.end(), static_cast<std::size_t>(each[static_cast<std::size_t>(cell)]), cell / 2);
    b.insert(b.end(), static_cast<std::size_t>(each[static_cast<std::size_t>(cell)]), cell % 2);
  }
  return {anova_data::numbered("a", a), anova_data::numbered("b", b)};
}

TEST(FactorialAnova, ACommonOffsetTakesNoDigits) {
  const std::vector<Factor> factors = three_by_two({2, 3, 2, 2, 4, 2});
  std::vector<double> values;
  for (std::size_t i = 0; i < 15; ++i) values.push_back(static_cast<double>((i * 7) % 11));
  const auto plain = factorial_anova(values, factors);
  for (double& value : values) value += 0x1p50;
  const auto offset = factorial_anova(values, factors);
  ASSERT_TRUE(plain && offset);
  for (std::size_t i = 0; i < 3; ++i) expect_digits(offset->terms[i].f, plain->terms[i].f, 12);
}

TEST(FactorialAnova, MeasuredFactorsCountInGeneralisedEtaSquared) {
  std::vector<Factor> factors = three_by_two({2, 2, 2, 2, 2, 2});
  const std::vector<double> values = {1, 4, 2, 6, 3, 5, 7, 9, 2, 2, 8, 4};
  factors[1].measured = true;
  const auto anova = factorial_anova(values, factors);
  ASSERT_TRUE(anova);
  const double a = anova->terms[0].ss, b = anova->terms[1].ss, ab = anova->terms[2].ss;
  const double error = anova->residual.ss;
  // Olejnik and Algina (2003), equation 5: the measured factor and its interactions count with the error.
  expect_digits(anova->terms[0].generalised_eta_sq, a / (a + b + ab + error), 13);
  expect_digits(anova->terms[1].generalised_eta_sq, b / (b + ab + error), 13);
  expect_digits(anova->terms[2].generalised_eta_sq, ab / (b + ab + error), 13);
}

TEST(FactorialAnova, OneObservationACellLeavesNoError) {
  const auto anova = factorial_anova(std::vector<double>{1, 4, 2, 6, 3, 5}, three_by_two({1, 1, 1, 1, 1, 1}));
  ASSERT_TRUE(anova);
  EXPECT_EQ(anova->residual.df, 0);
  EXPECT_TRUE(std::isnan(anova->terms[0].f));
  EXPECT_EQ(anova_data::warnings_with(anova->warnings, "No degrees of freedom"), 1);
  // Without the interaction there is one.
  EXPECT_EQ(factorial_anova(std::vector<double>{1, 4, 2, 6, 3, 5}, three_by_two({1, 1, 1, 1, 1, 1}),
                            {SumsOfSquares::TypeII, 1})
                ->residual.df,
            2);
}

TEST(FactorialAnova, OneColumnTwiceIsOneEffect) {
  Factor a = anova_data::numbered("a", {0, 0, 1, 1, 2, 2}), b = a;
  b.name = "b";
  const auto anova = factorial_anova(std::vector<double>{1, 2, 3, 5, 8, 7}, std::vector{a, b});
  ASSERT_TRUE(anova);
  EXPECT_EQ(anova->terms[0].df, 0);
  EXPECT_EQ(anova->residual.df, 3);
}

TEST(FactorialAnova, WhatCannotBeDoneIsSaid) {
  const std::vector<double> values = {1, 2, 3, 4};
  EXPECT_EQ(factorial_anova(values, {}).error().message, "there is no factor: give at least one");
  const Factor a = anova_data::numbered("a", {0, 0, 1, 1});
  EXPECT_EQ(factorial_anova(values, std::vector{a, a}).error().message,
            "two factors are named 'a': give each column once");
  EXPECT_FALSE(factorial_anova(values, std::vector{a}, {SumsOfSquares::TypeI, 0}));
  std::vector<int> many(2000);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = static_cast<int>(i);
  std::vector<int> two(2000, 0);
  two.back() = 1;
  const auto large =
      factorial_anova(std::vector<double>(2000, 1.0),
                      std::vector{anova_data::numbered("a", many), anova_data::numbered("b", two)});
  ASSERT_FALSE(large);
  EXPECT_EQ(
      large.error().message,
      "the model has 4000 parameters for 2000 cells, which is too many: leave out interactions or factors");
}

TEST(FactorialAnova, ErrsAsOftenAsItSaysWhateverTheCells) {
  base::Random random(20263);
  const std::vector<Factor> factors = three_by_two({2, 5, 3, 3, 6, 2});
  std::array<int, 3> below = {};
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> values;
    for (int k = 0; k < 21; ++k) values.push_back(anova_data::normal_value(random));
    const auto anova = factorial_anova(values, factors, {SumsOfSquares::TypeIII});
    for (std::size_t term = 0; term < 3; ++term) below[term] += anova->terms[term].p < 0.05 ? 1 : 0;
  }
  for (const int count : below) anova_data::expect_level(count);
}

TEST(FactorialAnova, ManyCellsOfOneObservation) {
  // 40 x 25 cells: of a balanced design the main effects are sums of squares of level means (equation 6.17).
  std::vector<int> a, b;
  std::vector<double> values;
  std::vector<double> mean_a(40, 0.0), mean_b(25, 0.0);
  for (int i = 0; i < 1000; ++i) {
    a.push_back(i / 25);
    b.push_back(i % 25);
    values.push_back(5000.0 + (i * 37) % 101);
    mean_a[static_cast<std::size_t>(a.back())] += values.back() / 25.0;
    mean_b[static_cast<std::size_t>(b.back())] += values.back() / 40.0;
  }
  const std::vector<Factor> factors = {anova_data::numbered("a", a), anova_data::numbered("b", b)};
  for (const auto type : {SumsOfSquares::TypeI, SumsOfSquares::TypeII, SumsOfSquares::TypeIII}) {
    const auto anova = factorial_anova(values, factors, {type, 1});
    ASSERT_TRUE(anova) << anova.error().message;
    const double ss_a = 25.0 * squared_deviations(mean_a), ss_b = 40.0 * squared_deviations(mean_b);
    expect_digits(anova->terms[0].ss, ss_a, 10);
    expect_digits(anova->terms[1].ss, ss_b, 10);
    expect_digits(anova->residual.ss, squared_deviations(values) - ss_a - ss_b, 10);
    EXPECT_EQ(anova->residual.df, 999 - 39 - 24);
  }
}

TEST(FactorialAnova, AMillionObservations) {
  base::Random random(20264);
  std::vector<double> values(1000000);
  std::vector<int> a(values.size()), b(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    a[i] = static_cast<int>(random.index(10));
    b[i] = static_cast<int>(random.index(20));
    values[i] = random.uniform() + 0.01 * a[i];
  }
  const auto anova =
      factorial_anova(values, std::vector{anova_data::numbered("a", a), anova_data::numbered("b", b)});
  ASSERT_TRUE(anova);
  EXPECT_EQ(anova->cells, 200u);
  EXPECT_EQ(anova->residual.df, 999800);
  // Uniform values vary by 1 / 12; the ten means, 0.01 apart, by 0.000825.
  EXPECT_NEAR(anova->residual.ms, 1.0 / 12.0, 3e-4);
  EXPECT_NEAR(anova->terms[0].eta_sq, 0.000825 / (0.000825 + 1.0 / 12.0), 5e-4);
}

}  // namespace
}  // namespace icome::stats
