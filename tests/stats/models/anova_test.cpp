#include "stats/models/anova.h"

#include <gtest/gtest.h>

#include "stats/anova_test_data.h"

namespace icome::stats {
namespace {

using anova_data::expect_digits;
using anova_data::row_of;

struct NistSet {
  const char* name;
  double f;  // certified in the file's header
  int digits;
};

class NistAnova : public testing::TestWithParam<NistSet> {};

/// The columns under the line that begins with "Data:" and names both.
void read_nist(const std::string& name, std::vector<std::string>& treatment, std::vector<double>& response) {
  std::ifstream file(anova_data::shared_file(std::string("nist-strd-anova/").append(name).append(".dat")));
  std::string line, level;
  while (std::getline(file, line) && line.find("Response") == std::string::npos &&
         line.find("Resistance") == std::string::npos) {
  }
  double value = 0.0;
  while (file >> level >> value) {
    treatment.push_back(level);
    response.push_back(value);
  }
}

TEST_P(NistAnova, AgreesWithTheCertifiedF) {
  std::vector<std::string> treatment;
  std::vector<double> response;
  read_nist(GetParam().name, treatment, response);
  if (response.empty()) GTEST_SKIP() << "no shared data: " << GetParam().name;
  const auto anova = one_way_anova(response, factor_of("treatment", treatment));
  ASSERT_TRUE(anova) << anova.error().message;
  RecordProperty("log_relative_error",
                 std::to_string(-std::log10(std::abs(anova->terms[0].f / GetParam().f - 1.0))));
  expect_digits(anova->terms[0].f, GetParam().f, GetParam().digits);
}

// SmLs04's values have 7 leading digits in common, which leaves 9 of their differences.
INSTANTIATE_TEST_SUITE_P(Sets, NistAnova,
                         testing::Values(NistSet{"SiRstv", 1.18046237440255, 12}, NistSet{"SmLs01", 21.0, 13},
                                         NistSet{"SmLs02", 201.0, 13}, NistSet{"SmLs03", 2001.0, 13},
                                         NistSet{"SmLs04", 21.0, 9}),
                         [](const auto& set) { return std::string(set.param.name); });

// weight, group of R's PlantGrowth (Dobson 1983, table 6.2).
const std::vector<double> kPlantWeights = {4.17, 5.58, 5.18, 6.11, 4.50, 4.61, 5.17, 4.53, 5.33, 5.14,
                                           4.81, 4.17, 4.41, 3.59, 5.87, 3.83, 6.03, 4.89, 4.32, 4.69,
                                           6.31, 5.12, 5.54, 5.50, 5.37, 5.29, 4.92, 6.15, 5.80, 5.26};

Factor plant_groups() {
  Factor group{"group", {"ctrl", "trt1", "trt2"}, {}, false};
  for (int i = 0; i < 30; ++i) group.of.push_back(i / 10);
  return group;
}

TEST(OneWayAnova, OfPlantGrowth) {
  const auto anova = one_way_anova(kPlantWeights, plant_groups());
  ASSERT_TRUE(anova);
  // R 4.2: summary(aov(weight ~ group, PlantGrowth))
  const AnovaTerm& group = anova->terms[0];
  EXPECT_EQ(group.term, "group");
  EXPECT_EQ(group.df, 2);
  EXPECT_EQ(anova->residual.df, 27);
  expect_digits(group.ss, 3.76634, 12);
  expect_digits(anova->residual.ss, 10.49209, 12);
  expect_digits(group.f, 4.84608786238014, 12);
  expect_digits(group.p, 0.0159099583256229, 10);
  expect_digits(anova->total_ss, 14.25843, 12);
  // By their definitions from these.
  expect_digits(group.eta_sq, 3.76634 / 14.25843, 12);
  expect_digits(group.partial_eta_sq, 3.76634 / 14.25843, 12);
  expect_digits(group.generalised_eta_sq, 3.76634 / 14.25843, 12);
  const double mse = 10.49209 / 27;
  expect_digits(group.omega_sq, (3.76634 - 2 * mse) / (14.25843 + mse), 12);
  expect_digits(group.partial_omega_sq, 2 * (group.f - 1) / (2 * (group.f - 1) + 30), 12);
  EXPECT_TRUE(anova->warnings.empty());
}

TEST(OneWayAnova, MissingValuesAndLevelsAreLeftOutAndSaid) {
  std::vector<double> weights = kPlantWeights;
  Factor group = plant_groups();
  group.levels.push_back("never");
  weights.push_back(NAN);
  group.of.push_back(3);
  weights.push_back(100.0);
  group.of.push_back(kNoLevel);
  const auto anova = one_way_anova(weights, group);
  ASSERT_TRUE(anova);
  expect_digits(anova->terms[0].f, 4.84608786238014, 12);
  EXPECT_EQ(anova->n, 30u);
  EXPECT_EQ(anova->missing, 2u);
  EXPECT_EQ(anova_data::warnings_with(anova->warnings, "2 of 32 observations"), 1);
  EXPECT_EQ(anova_data::warnings_with(anova->warnings, "'never' of 'group' has no observation"), 1);
}

TEST(OneWayAnova, WhatCannotBeComparedIsSaid) {
  const auto error = [](std::vector<double> values, std::vector<int> of) {
    const auto anova = one_way_anova(values, anova_data::numbered("x", std::move(of)));
    return anova ? std::string("none") : anova.error().message;
  };
  EXPECT_EQ(error({}, {}), "no observation has a value and all its levels: give at least two");
  EXPECT_EQ(error({1, 2}, {0, 0}), "factor 'x' has only the level '0': a comparison needs two");
  EXPECT_EQ(error({1, NAN}, {0, 1}), "factor 'x' has only the level '0': a comparison needs two");
  EXPECT_EQ(error({1, 2, 3}, {0, 1}), "factor 'x' has 2 rows and the values 3: give each value one level");
  EXPECT_EQ(error({1, INFINITY}, {0, 1}), "value 2 is inf: leave it out, or divide all by a constant");
  EXPECT_EQ(error({1, -1e200}, {0, 1}), "value 2 is -1e+200: leave it out, or divide all by a constant");
  EXPECT_EQ(error({0, 1e-200}, {0, 1}), "the values differ by less than 1e-140: multiply all by a constant");
  EXPECT_EQ(error({1, 2}, {0, -2}), "factor 'x' has no level number -2: number its levels from 0");
}

TEST(OneWayAnova, NoErrorOrNoDifferenceAtAll) {
  const auto of = [](std::vector<double> values, std::vector<int> levels) {
    return *one_way_anova(values, anova_data::numbered("x", std::move(levels)));
  };
  const Anova perfect = of({1, 1, 2, 2}, {0, 0, 1, 1});
  EXPECT_EQ(perfect.terms[0].f, INFINITY);
  EXPECT_EQ(perfect.terms[0].p, 0.0);
  EXPECT_EQ(anova_data::warnings_with(perfect.warnings, "perfect fit"), 1);
  const Anova constant = of({0.1, 0.1, 0.1, 0.1}, {0, 0, 1, 1});
  EXPECT_TRUE(std::isnan(constant.terms[0].f));
  EXPECT_TRUE(std::isnan(constant.terms[0].p));
  EXPECT_EQ(anova_data::warnings_with(constant.warnings, "All values are equal"), 1);
  const Anova single = of({1, 2, 3}, {0, 1, 2});
  EXPECT_TRUE(std::isnan(single.terms[0].f));
  EXPECT_EQ(anova_data::warnings_with(single.warnings, "No degrees of freedom"), 1);
  EXPECT_EQ(anova_data::warnings_with(single.warnings, "each level has one observation only"), 1);
  EXPECT_EQ(anova_data::warnings_with(single.warnings, "interaction"), 0);
}

TEST(OneWayAnova, ErrsAsOftenAsItSays) {
  base::Random random(20261);
  const Factor group = anova_data::numbered("x", {0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2, 2, 2, 2});
  int below = 0, welch_below = 0;
  for (int i = 0; i < 2000; ++i) {
    std::vector<double> values, spread;
    for (const int level : group.of) {
      values.push_back(anova_data::normal_value(random));
      spread.push_back(values.back() * (3.0 - level));  // the smallest group varies most
    }
    below += one_way_anova(values, group)->terms[0].p < 0.05 ? 1 : 0;
    welch_below += welch_anova(spread, group)->p < 0.05 ? 1 : 0;
  }
  anova_data::expect_level(below);
  // Welch's test is approximate: 0.055 +- 0.02 in groups as small as these.
  EXPECT_NEAR(welch_below / 2000.0, 0.055, 0.02);
}

TEST(WelchAnova, OfPlantGrowth) {
  const auto welch = welch_anova(kPlantWeights, plant_groups());
  ASSERT_TRUE(welch);
  // R 4.2: oneway.test(weight ~ group, PlantGrowth)
  expect_digits(welch->f, 5.1809724081131892, 12);
  EXPECT_EQ(welch->df, 2.0);
  expect_digits(welch->error_df, 17.128418616644129, 12);
  expect_digits(welch->p, 0.017392821490170001, 10);
}

TEST(WelchAnova, OfSleepAsInRsReferenceOutput) {
  const std::vector<double> extra = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0,
                                     1.9, 0.8,  1.1,  0.1,  -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};
  Factor group{"group", {"1", "2"}, std::vector<int>(20, 0), false};
  std::fill(group.of.begin() + 10, group.of.end(), 1);
  const auto welch = welch_anova(extra, group);
  ASSERT_TRUE(welch);
  // shared/data/stats/r-reference-output/oneway.test.Rout.txt, as printed there.
  EXPECT_NEAR(welch->f, 3.4626, 5e-5);
  EXPECT_NEAR(welch->error_df, 17.776, 5e-4);
  EXPECT_NEAR(welch->p, 0.07939, 5e-6);
}

TEST(WelchAnova, NeedsSpreadInEveryLevel) {
  const auto constant = welch_anova(std::vector<double>{1, 1, 2, 3}, anova_data::numbered("x", {0, 0, 1, 1}));
  ASSERT_FALSE(constant);
  EXPECT_EQ(constant.error().message,
            "the observations of '0' do not vary: without equal variances each level needs two that differ");
  EXPECT_FALSE(welch_anova(std::vector<double>{1, 2, 3}, anova_data::numbered("x", {0, 0, 1})));
}

}  // namespace
}  // namespace icome::stats
