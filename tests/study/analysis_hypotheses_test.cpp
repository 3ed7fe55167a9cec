#include <gtest/gtest.h>

#include <algorithm>

#include "study/analysis.h"
#include "study/analysis_test_data.h"

namespace icome::study {
namespace {

/// Three ways, which everybody has, and three groups of people.
constexpr const char* kCrossedStudy = R"(
name = "crossed"
languages = ["en"]
title = "Crossed"
independent = [
  { id = "way", name = "Way", kind = "within", levels = [{ id = "a", name = "A" }, { id = "b", name = "B" }, { id = "c", name = "C" }] },
  { id = "group", name = "Group", kind = "between", levels = [{ id = "p", name = "P" }, { id = "q", name = "Q" }, { id = "r", name = "R" }] },
]
dependent = [
  { id = "time", name = "Time", type = "ratio", values = "continuous", unit = "s", from = "time" },
  { id = "ease", name = "Ease", type = "ordinal", from = "each.ease" },
  { id = "overall", name = "Overall", type = "ordinal", from = "end.overall" },
  { id = "picked", name = "Picked", type = "nominal", from = "each.picked" },
  { id = "liked", name = "Liked", type = "nominal", from = "end.liked" },
]
[trials]
measured = 1
[[questionnaires]]
id = "each"
title = "Each"
when = "after-condition"
[[questionnaires.items]]
id = "ease"
kind = "rating"
text = "Was it easy?"
points = 7
low = "no"
high = "yes"
[[questionnaires.items]]
id = "picked"
kind = "choice"
text = "Would you pick it?"
choices = [{ id = "yes", name = "Yes" }, { id = "no", name = "No" }]
[[questionnaires]]
id = "end"
title = "End"
when = "end"
[[questionnaires.items]]
id = "overall"
kind = "rating"
text = "How was it all?"
points = 5
low = "bad"
high = "good"
[[questionnaires.items]]
id = "liked"
kind = "choice"
text = "Did you like it?"
choices = [{ id = "yes", name = "Yes" }, { id = "no", name = "No" }]
)";

// Times in s: the third way differs from both others, which are alike.
const std::vector<std::vector<double>> kThirdIsSlow = {{1.00, 1.06, 5.0}, {1.20, 1.15, 5.3},
                                                       {0.90, 0.93, 4.8}, {1.10, 1.08, 5.2},
                                                       {1.30, 1.34, 4.9}, {1.05, 1.04, 5.1}};

/// A row of times a person, spread over groups that are given.
StudyData crossed_data(const std::vector<std::vector<double>>& times,
                       const std::vector<std::size_t>& groups) {
  StudyData data;
  data.study = read_study(kCrossedStudy, "crossed").value();
  for (std::size_t i = 0; i < times.size(); ++i) {
    StudyData::Person& person = add_person(data, groups[i % groups.size()]);
    for (std::size_t way = 0; way < 3; ++way) {
      add_trial(person, way, times[i][way]);
      const std::size_t position = position_of(data, person.participant, way);
      add_answer(person, "each.ease", std::to_string(1 + (i + 2 * way) % 5 + way), position);
      add_answer(person, "each.picked", (i + way) % 3 == 0 ? "yes" : "no", position);
    }
    add_answer(person, "end.overall", std::to_string(1 + i % 5));
    add_answer(person, "end.liked", i % 3 == 0 ? "yes" : "no");
  }
  return data;
}

/// What becomes of a hypothesis; `expected` as "a < b", or empty.
HypothesisResult result_of(StudyData data, const std::string& dependent, const std::string& factor,
                           study::Test test, const std::string& expected = {}) {
  Hypothesis hypothesis;
  hypothesis.dependent = dependent;
  hypothesis.factor = factor;
  hypothesis.test = test;
  if (!expected.empty()) {
    hypothesis.direction = expected[2] == '<' ? Direction::Less : Direction::Greater;
    hypothesis.first = expected.substr(0, 1);
    hypothesis.second = expected.substr(4);
  }
  data.study.hypotheses = {hypothesis};
  return analyse(data).hypotheses.front();
}

bool notes_say(const TestResult& result, const std::string& words) {
  return std::ranges::any_of(result.notes,
                             [&](const std::string& note) { return note.find(words) != std::string::npos; });
}

TEST(Hypotheses, AnExpectationOfTwoOfThreeLevelsIsDecidedByThese) {
  const StudyData data = crossed_data(kThirdIsSlow, {0});
  const HypothesisResult means = result_of(data, "time", "way", study::Test::Anova, "a < b");
  ASSERT_TRUE(means.test.result) << means.test.why;
  EXPECT_EQ(means.test.result->test, "paired t-test");
  EXPECT_NEAR(means.test.result->p, 0.644994904167004, 1e-12);  // t.test(a, b, paired = TRUE) in R 4.2.2
  EXPECT_EQ(means.decision, Decision::NotShown);
  EXPECT_TRUE(notes_say(*means.test.result, "All 3 levels: repeated measures ANOVA, F("));
  EXPECT_EQ(result_of(data, "time", "way", study::Test::Anova, "a < c").decision, Decision::Shown);
  EXPECT_EQ(result_of(data, "time", "way", study::Test::Anova, "c < a").decision, Decision::Opposite);
  EXPECT_EQ(result_of(data, "time", "way", study::Test::Anova).test.result->test, "repeated measures ANOVA");
  const HypothesisResult ranks = result_of(data, "time", "way", study::Test::Friedman, "a < b");
  ASSERT_TRUE(ranks.test.result) << ranks.test.why;
  EXPECT_NEAR(ranks.test.result->p, 0.6875, 1e-12);  // wilcox.test(a, b, paired = TRUE)
  EXPECT_TRUE(notes_say(*ranks.test.result, "All 3 levels: Friedman's test, χ²(2) = "));
}

// Times in s of four people of each of three groups, of which the last is slow.
const std::vector<std::vector<double>> kLastGroupIsSlow = {
    {1.1, 1.1, 1.1}, {1.3, 1.3, 1.3}, {5.2, 5.2, 5.2}, {1.2, 1.2, 1.2}, {1.5, 1.5, 1.5}, {4.9, 4.9, 4.9},
    {1.4, 1.4, 1.4}, {1.0, 1.0, 1.0}, {5.5, 5.5, 5.5}, {0.9, 0.9, 0.9}, {1.6, 1.6, 1.6}, {5.1, 5.1, 5.1}};

TEST(Hypotheses, AnExpectationOfTwoOfThreeGroupsIsDecidedByThese) {
  const StudyData data = crossed_data(kLastGroupIsSlow, {0, 1, 2});
  const HypothesisResult ranks = result_of(data, "time", "group", study::Test::Kruskal, "p < q");
  ASSERT_TRUE(ranks.test.result) << ranks.test.why;
  EXPECT_EQ(ranks.test.result->test, "Wilcoxon's rank sum test");
  EXPECT_NEAR(ranks.test.result->p, 0.342857142857143, 1e-12);  // wilcox.test(p, q) in R 4.2.2
  EXPECT_EQ(ranks.decision, Decision::NotShown);
  EXPECT_TRUE(notes_say(*ranks.test.result, "All 3 levels: Kruskal-Wallis test, H(2) = "));
  const HypothesisResult means = result_of(data, "time", "group", study::Test::Anova, "p < q");
  ASSERT_TRUE(means.test.result) << means.test.why;
  EXPECT_NEAR(means.test.result->p, 0.28201786801045, 1e-12);  // t.test(p, q)
  EXPECT_EQ(result_of(data, "time", "group", study::Test::Kruskal, "r > q").decision, Decision::Shown);
}

TEST(Hypotheses, MeansOfAnOrdinalVariableAreNoted) {
  const StudyData data = crossed_data(kThirdIsSlow, {0});
  const HypothesisResult result = result_of(data, "ease", "way", study::Test::Anova);
  ASSERT_TRUE(result.test.result) << result.test.why;
  EXPECT_TRUE(notes_say(*result.test.result, "means of an ordinal variable"));
}

TEST(Hypotheses, AGroupOfNobodyIsLeftOutWithANote) {
  const StudyData data = crossed_data(kLastGroupIsSlow, {0, 2});
  const HypothesisResult ranks = result_of(data, "time", "group", study::Test::Kruskal);
  ASSERT_TRUE(ranks.test.result) << ranks.test.why;
  EXPECT_EQ(ranks.test.result->df, (std::vector<double>{1.0}));
  EXPECT_TRUE(notes_say(*ranks.test.result, "nobody is of Q, which is left out."));
  EXPECT_TRUE(result_of(data, "time", "group", study::Test::Anova).test.result);
  EXPECT_EQ(result_of(data, "time", "group", study::Test::Kruskal, "p < q").test.why, "nobody is of Q.");
  const Analysis analysis = analyse(data);
  const auto levene = std::ranges::find(analysis.checks, "Levene", &AssumptionCheck::test);
  ASSERT_NE(levene, analysis.checks.end());
  EXPECT_EQ(levene->why, "");
}

/// Nine of ten people are faster with the first way, and one much slower: its mean is greater.
StudyData one_is_much_slower() {
  std::vector<std::vector<double>> times;
  for (int i = 1; i <= 9; ++i) times.push_back({2.0, 2.0 + 0.1 * i, 3.0});
  times.push_back({50.0, 2.0, 3.0});
  return crossed_data(times, {0});
}

TEST(Hypotheses, RanksHaveTheDirectionOfTheirTest) {
  StudyData data = one_is_much_slower();
  const HypothesisResult one = result_of(data, "time", "way", study::Test::Wilcoxon, "a < b");
  ASSERT_TRUE(one.test.result) << one.test.why;
  EXPECT_NEAR(one.test.result->p, 0.0419921875, 1e-12);  // psignrank(10, 10) in R 4.2.2
  EXPECT_TRUE(*one.as_expected);
  EXPECT_EQ(one.decision, Decision::Shown);
  EXPECT_EQ(result_of(data, "time", "way", study::Test::Wilcoxon, "b < a").decision, Decision::NotShown);
}

TEST(Hypotheses, TestsOfTwoLevelsHaveTheDirectionOfMeanRanks) {
  StudyData data = one_is_much_slower();
  data.study.independent[0].levels.pop_back();
  data.study.order = OrderMethod::Fixed;
  const HypothesisResult same = result_of(data, "time", "way", study::Test::Friedman, "a < b");
  EXPECT_EQ(same.test.result->test, "Friedman's test");
  EXPECT_EQ(same.decision, Decision::Shown);
  EXPECT_EQ(result_of(data, "time", "way", study::Test::Friedman, "a > b").decision, Decision::Opposite);
  EXPECT_EQ(result_of(data, "time", "way", study::Test::Friedman, "b > a").decision, Decision::Shown);
  StudyData groups = crossed_data(kLastGroupIsSlow, {0, 1});
  for (std::size_t i = 0; i < groups.people.size(); ++i)
    groups.people[i].participant.group = kLastGroupIsSlow[i][0] > 4.0 ? 1 : 0;
  groups.study.independent[1].levels.pop_back();
  EXPECT_EQ(result_of(groups, "time", "group", study::Test::Kruskal, "p < q").decision, Decision::Shown);
  EXPECT_EQ(result_of(groups, "time", "group", study::Test::Kruskal, "q < p").decision, Decision::Opposite);
}

TEST(Hypotheses, CountsHaveNoDirection) {
  const StudyData data = crossed_data(kThirdIsSlow, {0, 1, 2});
  for (const study::Test test : {study::Test::ChiSquared, study::Test::Fisher, study::Test::McNemar}) {
    const HypothesisResult result = result_of(data, "liked", "group", test, "p < q");
    EXPECT_EQ(result.decision, Decision::NotComputed);
    EXPECT_EQ(result.test.why,
              "counts of answers have no direction; leave `expected` out, or ask for a rating.");
  }
}

TEST(Hypotheses, NoTestStandsInForTheOneThatIsNamed) {
  const StudyData data = crossed_data(kThirdIsSlow, {0, 1, 2});
  const auto why = [&](const char* dependent, const char* factor, study::Test test) {
    return result_of(data, dependent, factor, test).test.why;
  };
  EXPECT_EQ(why("liked", "", study::Test::Fisher),
            "Fisher's test compares groups of people; test = \"chisq\" does without a factor.");
  const std::string pairs =
      "McNemar's test compares answers of the same people under two levels; test = \"chisq\" others.";
  EXPECT_EQ(why("liked", "group", study::Test::McNemar), pairs);
  EXPECT_EQ(why("liked", "", study::Test::McNemar), pairs);
  const std::string once = "the question was asked once, not in each condition.";
  EXPECT_EQ(why("liked", "way", study::Test::McNemar), once);
  EXPECT_EQ(why("liked", "way", study::Test::ChiSquared), once);
  EXPECT_EQ(why("liked", "way", study::Test::Fisher), once);
  EXPECT_EQ(why("picked", "way", study::Test::Fisher),
            "the same people answered in each condition; test = \"mcnemar\" compares those.");
  EXPECT_EQ(why("liked", "", study::Test::ChiSquared), "");
}

TEST(Hypotheses, AfterTheOnlyConditionEverybodyAnswersOnce) {
  StudyData data = crossed_data(kThirdIsSlow, {0, 1, 2});
  const auto why = [&](study::Test test) { return result_of(data, "picked", "group", test).test.why; };
  const std::string several = "everybody answered several times, so counts depend on each other.";
  EXPECT_EQ(why(study::Test::Fisher), several);
  std::erase_if(data.study.independent, [](const IndependentVariable& factor) { return !factor.between; });
  EXPECT_NE(why(study::Test::Fisher), several);
}

TEST(Hypotheses, OrdinalVariablesAreRankedWhereNoTestIsNamed) {
  StudyData data = crossed_data(kThirdIsSlow, {0, 1, 2});
  const auto test = [&](const char* dependent, const char* factor) {
    const Tested tested = result_of(data, dependent, factor, study::Test::None).test;
    return tested.result ? tested.result->test : tested.why;
  };
  EXPECT_EQ(test("ease", "way"), "Friedman's test");
  EXPECT_EQ(test("overall", "group"), "Kruskal-Wallis test");
  EXPECT_EQ(test("time", "way"), "mixed ANOVA");
  data = crossed_data(kThirdIsSlow, {0, 1});
  data.study.independent[1].levels.pop_back();
  EXPECT_EQ(test("overall", "group"), "Wilcoxon's rank sum test");
  data.study.independent[0].levels.pop_back();
  data.study.order = OrderMethod::Fixed;
  EXPECT_EQ(test("ease", "way"), "Wilcoxon's signed rank test");
}

}  // namespace
}  // namespace icome::study
