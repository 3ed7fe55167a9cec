#include <gtest/gtest.h>

#include <algorithm>

#include "study/analysis/analysis.h"
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
  EXPECT_EQ(result.test.result->doubts.back(),
            "these are means of an ordinal variable, which a test of ranks fits");
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

/// People of the study `blank` who took so long with the old and the new technique (s), and preferred one.
StudyData techniques_data(const std::vector<double>& before, const std::vector<double>& after,
                          std::size_t prefer_old) {
  StudyData data = data_of("blank");  // expects new < old
  plan_trials(data, 1);
  for (std::size_t i = 0; i < 22; ++i) {
    StudyData::Person& person = add_person(data, 0);
    add_answer(person, "comparison.preferred", i < prefer_old ? "old" : "new");
    if (i >= before.size()) continue;
    add_trial(person, 0, before[i]);
    add_trial(person, 1, after[i]);
  }
  return data;
}

const std::vector<double> kOldTimes = {3.1, 2.9, 3.6, 3.3, 2.7, 3.8, 3.0, 3.4, 2.8, 3.5};
const std::vector<double> kNewTimes = {2.8, 3.0, 3.2, 3.4, 2.5, 3.3, 3.1, 3.0, 2.9, 3.2};

TEST(Decisions, AreMadeByHolmOverAllHypotheses) {
  StudyData data = techniques_data(kOldTimes, kNewTimes, 16);
  data.study.hypotheses[1].test = study::Test::ChiSquared;
  const Analysis both = analyse(data);
  // R 4.2.2: p <- c(t.test(new, old, paired = TRUE, alternative = "less")$p.value,
  //                 chisq.test(c(16, 6))$p.value); p.adjust(p, "holm")
  EXPECT_NEAR(both.hypotheses[0].test.result->p, 0.0280033745363936, 1e-12);
  EXPECT_NEAR(both.hypotheses[1].test.result->p, 0.0330062576612324, 1e-12);
  for (const HypothesisResult& result : both.hypotheses) {
    EXPECT_NEAR(*result.p_holm, 0.0560067490727872, 1e-12);
    EXPECT_EQ(result.decision, Decision::NotShown);
  }
  data.study.hypotheses.pop_back();
  EXPECT_EQ(analyse(data).hypotheses[0].decision, Decision::Shown) << "alone it is its own family";
}

/// Answers of the head-tracking study, whose hypotheses test them as its file says.
HypothesisResult depth_result(std::size_t tracked, std::size_t same, std::size_t fixed) {
  StudyData data = data_of("head-tracking");
  std::erase_if(data.study.hypotheses, [](const Hypothesis& it) { return it.id != "felt-depth"; });
  const auto answer = [&](std::size_t people, const char* choice) {
    for (std::size_t i = 0; i < people; ++i) add_answer(add_person(data, 0), "comparison.depth", choice);
  };
  answer(tracked, "tracked");
  answer(same, "same");
  answer(fixed, "fixed");
  return analyse(data).hypotheses.front();
}

TEST(Decisions, OfAPrimaryHypothesisAreByItsOwnP) {
  StudyData data = techniques_data(kOldTimes, kNewTimes, 16);
  data.study.hypotheses[1].test = study::Test::ChiSquared;
  data.study.hypotheses[0].primary = true;
  const Analysis time_first = analyse(data);
  EXPECT_EQ(time_first.hypotheses[0].decision, Decision::Shown);
  EXPECT_NEAR(*time_first.hypotheses[0].p_holm, 0.0280033745363936, 1e-12);
  EXPECT_EQ(time_first.hypotheses[1].decision, Decision::Shown) << "alone among the others";
  EXPECT_NEAR(*time_first.hypotheses[1].p_holm, 0.0330062576612324, 1e-12);
  data.study.hypotheses[0].alpha = 0.01;
  const Analysis not_shown = analyse(data);
  EXPECT_EQ(not_shown.hypotheses[0].decision, Decision::NotShown);
  EXPECT_EQ(not_shown.hypotheses[1].decision, Decision::NotShown) << "only after the primary one";
  EXPECT_TRUE(not_shown.hypotheses[1].held_back);
  for (StudyData::Person& person : data.people) person.progress.trials.clear();
  const Analysis not_computed = analyse(data);
  EXPECT_EQ(not_computed.hypotheses[0].decision, Decision::NotComputed);
  EXPECT_TRUE(not_computed.hypotheses[1].held_back);
}

TEST(Preferences, AreNotShownByFewWhoSeeNoDifference) {
  // binom.test(8, 20) in R 4.2.2: p = .50; chisq.test(c(8, 2, 12)): p = .03, for the sake of the two.
  EXPECT_EQ(depth_result(8, 2, 12).decision, Decision::NotShown);
  EXPECT_EQ(depth_result(14, 7, 1).decision, Decision::Shown);
}

TEST(Preferences, HaveTheThesissTestBesideThemOnlyWhereItFindsTheSame) {
  EXPECT_TRUE(depth_result(14, 7, 1).beside);
  EXPECT_TRUE(depth_result(16, 0, 6).beside);
  EXPECT_FALSE(depth_result(8, 2, 12).beside) << "unequal for the sake of the two only";
  EXPECT_FALSE(depth_result(12, 2, 8).beside);
  EXPECT_FALSE(depth_result(8, 7, 7).beside);
}

TEST(Preferences, OfNobodyAreASentence) {
  EXPECT_EQ(depth_result(0, 5, 0).test.why, "nobody chose either of the two answers.");
  EXPECT_EQ(depth_result(0, 0, 0).test.why, "nobody chose either of the two answers.");
  const HypothesisResult one = depth_result(1, 0, 0);
  ASSERT_TRUE(one.test.result);
  EXPECT_EQ(one.test.result->p, 1.0);
  EXPECT_EQ(one.test.result->counts, "1 With head tracking, 0 Without head tracking, 0 ties");
}

TEST(Preferences, HaveTheDirectionThatIsExpected) {
  StudyData data = techniques_data({}, {}, 6);  // 16 prefer the new one
  data.study.hypotheses.erase(data.study.hypotheses.begin());
  Hypothesis& preferred = data.study.hypotheses.front();
  preferred.answers.clear();
  preferred.direction = Direction::Greater;
  preferred.first = "new";
  preferred.second = "old";
  const HypothesisResult more = analyse(data).hypotheses.front();
  // binom.test(16, 22, alternative = "greater") in R 4.2.2
  EXPECT_NEAR(more.test.result->p, 0.0262393951416016, 1e-12);
  EXPECT_TRUE(more.one_sided);
  EXPECT_EQ(more.decision, Decision::Shown);
  preferred.direction = Direction::Less;
  EXPECT_EQ(analyse(data).hypotheses.front().decision, Decision::NotShown);
}

}  // namespace
}  // namespace icome::study
