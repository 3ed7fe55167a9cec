#include <gtest/gtest.h>

#include <algorithm>

#include "study/analysis/analysis.h"
#include "study/analysis_test_data.h"

namespace icome::study {
namespace {

constexpr std::size_t kClickOrPush = 0, kForcesOrNone = 1;  // factors of the menu study

struct TypedTrial {
  double time, approach, distance;  // s, s, m
  int errors;
};

// Two people who clicked and two who pushed, three trials with forces and three without.
constexpr std::array<TypedTrial, 24> kTyped = {{
    {2.11, 0.91, 0.041, 0}, {1.87, 0.80, 0.039, 0}, {2.53, 1.02, 0.047, 1}, {2.40, 0.75, 0.044, 2},
    {2.95, 0.99, 0.052, 1}, {2.62, 0.88, 0.040, 3}, {1.75, 0.71, 0.038, 0}, {2.02, 0.95, 0.043, 1},
    {1.66, 0.64, 0.036, 0}, {2.31, 0.83, 0.049, 1}, {2.08, 0.90, 0.042, 2}, {2.44, 0.77, 0.045, 2},
    {4.10, 1.40, 0.088, 1}, {3.72, 1.22, 0.079, 0}, {5.05, 1.15, 0.101, 2}, {3.91, 1.61, 0.083, 3},
    {4.66, 1.02, 0.095, 2}, {4.20, 1.33, 0.090, 4}, {3.35, 1.28, 0.075, 0}, {4.48, 1.09, 0.097, 2},
    {3.90, 1.47, 0.082, 1}, {5.12, 1.36, 0.110, 3}, {4.75, 1.58, 0.099, 5}, {3.64, 1.11, 0.078, 2},
}};

StudyData typed_data() {
  StudyData data = data_of("menu");
  plan_trials(data, 3);
  for (std::size_t person = 0; person < 4; ++person) {
    StudyData::Person& who = add_person(data, person / 2);
    for (std::size_t i = 0; i < 6; ++i) {
      const TypedTrial& it = kTyped[6 * person + i];
      add_trial(who, i / 3, it.time, it.errors);
      who.progress.trials.back().measures = {it.time,     it.approach, it.time - it.approach,
                                             it.distance, it.errors,   true};
    }
  }
  return data;
}

const ThesisTable& thesis_table(const Analysis& analysis, std::size_t factor, TrialChoice trials,
                                std::optional<std::pair<std::size_t, std::size_t>> level = {}) {
  return *std::ranges::find_if(analysis.thesis_tables, [&](const ThesisTable& table) {
    return table.factor == factor && table.trials == trials && table.within_level == level;
  });
}

const ThesisRow& row_of_variable(const StudyData& data, const ThesisTable& table, const std::string& id) {
  return *std::ranges::find_if(
      table.rows, [&](const ThesisRow& row) { return data.study.dependent[row.variable].id == id; });
}

void expect_row(const StudyData& data, const ThesisTable& table, const std::string& id, double first,
                double second, double f, double p) {
  const ThesisRow& row = row_of_variable(data, table, id);
  ASSERT_EQ(row.levels.size(), 2U);
  EXPECT_NEAR(*row.levels[0], first, 1e-9) << id;
  EXPECT_NEAR(*row.levels[1], second, 1e-9) << id;
  ASSERT_TRUE(row.test.result) << id << ": " << row.test.why;
  EXPECT_NEAR(row.test.result->value / f, 1.0, 1e-9) << id;
  EXPECT_NEAR(row.test.result->p / p, 1.0, 1e-8) << id;
}

// The numbers are R 4.2.2's: aov(x ~ g * c) over the 24 trials, aov(x ~ c) over the 12 of those who clicked.
TEST(ThesisTables, OverAllTrialsAreRsTwoWayAnova) {
  const StudyData data = typed_data();
  const Analysis analysis = analyse(data);
  const ThesisTable& forces = thesis_table(analysis, kForcesOrNone, TrialChoice::All);
  expect_row(data, forces, "time", 3045.0, 10270.0 / 3.0, 4.0115373836141, 0.0589315328108112);
  expect_row(data, forces, "approach", 3160.0 / 3.0, 6565.0 / 6.0, 0.370490386692591, 0.549588650711648);
  expect_row(data, forces, "homing", 5975.0 / 3.0, 13975.0 / 6.0, 2.98845611465177, 0.0992678979254797);
  expect_row(data, forces, "distance", 383.0 / 6.0, 827.0 / 12.0, 2.26641491046412, 0.147836147860422);
  expect_row(data, forces, "wrong", 8.0, 30.0, 26.8888888888889, 4.49418109147188e-05);
  const ThesisTable& ways = thesis_table(analysis, kClickOrPush, TrialChoice::All);
  expect_row(data, ways, "time", 6685.0 / 3.0, 4240.0, 113.415828480678, 1.08660465099444e-09);
  expect_row(data, ways, "wrong", 13.0, 25.0, 8.0, 0.0103824770502658);
  EXPECT_EQ(row_of_variable(data, ways, "time").test.result->test, "two-way ANOVA over trials");
  EXPECT_EQ(row_of_variable(data, ways, "time").trials, 24U);
}

TEST(ThesisTables, WithinALevelAreRsOneWayAnovaAndChiSquared) {
  const StudyData data = typed_data();
  const ThesisTable table =
      thesis_table(analyse(data), kForcesOrNone, TrialChoice::All, std::pair{kClickOrPush, std::size_t{0}});
  expect_row(data, table, "time", 1990.0, 7400.0 / 3.0, 7.3759197806954, 0.0217139225579126);
  expect_row(data, table, "wrong", 2.0, 11.0, 16.2, 0.00241920050094857);
  ASSERT_EQ(table.choices.size(), 2U);
  EXPECT_EQ(table.choices[0].wrong, 2U);
  EXPECT_EQ(table.choices[0].choices, 8U);
  EXPECT_EQ(table.choices[1].wrong, 11U);
  EXPECT_EQ(table.choices[1].choices, 17U);
  ASSERT_TRUE(table.choices_test.result);
  EXPECT_NEAR(table.choices_test.result->p, 0.0637866370479, 1e-11);
}

TEST(ThesisTables, LastTrialsAreTheLastOfEachCondition) {
  const StudyData data = typed_data();
  const ThesisTable table = thesis_table(analyse(data), kForcesOrNone, TrialChoice::Last);
  expect_row(data, table, "time", 3285.0, 3225.0, 0.0237486600148427, 0.884988801219046);
}

TEST(ThesisTables, CorrelationsAreRs) {
  const StudyData data = typed_data();
  const Analysis analysis = analyse(data);
  const ThesisCorrelations& found = analysis.thesis_correlations;
  ASSERT_EQ(found.variables.size(), 5U);
  EXPECT_EQ(found.counts(1, 0), 24);
  EXPECT_NEAR(found.r(1, 0), 0.782781771869383, 1e-12);
  EXPECT_NEAR(found.r(2, 1), 0.652355778932855, 1e-12);
  EXPECT_NEAR(found.r(3, 2), 0.956826104292080, 1e-12);
  EXPECT_NEAR(found.r(4, 1), 0.484768810522834, 1e-12);
}

// 180 right clicks in each condition: chisq.test(matrix(c(63, 180, 16, 180), 2, byrow = TRUE), correct =
// FALSE).
TEST(ThesisTables, TheClicksOfTheThesisAreWrongAsItSays) {
  StudyData data = data_of("menu");
  plan_trials(data, 15);
  for (std::size_t person = 0; person < 12; ++person) {
    StudyData::Person& who = add_person(data, 0);
    for (std::size_t i = 0; i < 30; ++i) {
      const std::size_t number = 15 * person + i % 15;  // of the condition's 180
      const int errors = i < 15 ? (number < 16 ? 1 : 0) : (number < 63 ? 1 : 0);
      add_trial(who, i / 15, 1.0 + 0.01 * double(i), errors);
    }
  }
  const ThesisTable table =
      thesis_table(analyse(data), kForcesOrNone, TrialChoice::All, std::pair{kClickOrPush, std::size_t{0}});
  EXPECT_EQ(table.choices[0].wrong, 16U);
  EXPECT_EQ(table.choices[0].choices, 196U);
  EXPECT_EQ(table.choices[1].wrong, 63U);
  EXPECT_EQ(table.choices[1].choices, 243U);
  EXPECT_NEAR(table.choices_test.result->p, 1.46300471280975e-06, 1e-15);
}

TEST(ThesisTables, OfTrialsThatWereNotCompletedErrorsCountAndTimesDoNot) {
  StudyData data = typed_data();
  data.people[0].progress.trials[0].measures = {60.0, 1.0, 59.0, 0.5, 7, false};
  const ThesisTable table = thesis_table(analyse(data), kForcesOrNone, TrialChoice::All);
  EXPECT_EQ(row_of_variable(data, table, "time").trials, 23U);
  EXPECT_NEAR(*row_of_variable(data, table, "time").levels[0], (12.0 * 3045.0 - 2110.0) / 11.0, 1e-9);
  EXPECT_EQ(*row_of_variable(data, table, "wrong").levels[0], 15.0);
  EXPECT_EQ(table.choices[0].choices, 11U + 15U);
}

TEST(ThesisTables, WithoutDataHaveNoNumbers) {
  const Analysis analysis = analyse(data_of("menu"));
  for (const ThesisTable& table : analysis.thesis_tables)
    for (const ThesisRow& row : table.rows) {
      EXPECT_FALSE(row.levels[0]);
      EXPECT_FALSE(row.test.result);
      EXPECT_FALSE(row.test.why.empty());
    }
}

}  // namespace
}  // namespace icome::study
