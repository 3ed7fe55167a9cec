#include "study/definition/study_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "study/definition/conditions.h"
#include "study/definition/needs.h"
#include "study/definition/study_reader.h"
#include "study/definition/templates.h"

namespace icome::study {
namespace {

Study study_of_template(const char* name) {
  return read_study(study_template(name, "test").value(), name).value();
}

bool says(const std::vector<Finding>& findings, const std::string& words) {
  return std::ranges::any_of(
      findings, [&](const Finding& one) { return one.sentence.find(words) != std::string::npos; });
}

TEST(StudyCheck, HeadTrackingCanBeRun) {
  const StudyCheck check = check_study(study_of_template("head-tracking"));
  EXPECT_EQ(check.conditions, 2U);
  EXPECT_EQ(check.groups, 1U);
  EXPECT_EQ(check.balanced_by, 2U);
  EXPECT_EQ(check.trials, 16U);  // 4 scenes, twice, in both conditions
  EXPECT_TRUE(check.reasons.empty());
  // power.t.test(n = 22, delta = 0.5, sd = 1, type = "paired", strict = TRUE) in R 4.2.
  ASSERT_EQ(check.powers.size(), 3U);
  EXPECT_NEAR(check.powers[0].power, 0.609184804184, 1e-9);
  EXPECT_EQ(check.powers[0].needed, 34U);
  EXPECT_TRUE(says(check.warnings, "power 0.61, 34 would with 0.8: 'time', 'distance', 'touches'"));
}

TEST(StudyCheck, TrialsNeedATaskAndScenesWithFiles) {
  Study study = study_of_template("blank");
  EXPECT_TRUE(check_study(study).reasons.empty());
  study.trials.scenes[0].file.clear();
  EXPECT_TRUE(says(check_study(study).reasons, "no file shows what these scenes are: 'room'"));
  study.trials.scenes.clear();
  EXPECT_TRUE(says(check_study(study).reasons, "there are no scenes"));
  study.task.reset();
  EXPECT_TRUE(says(check_study(study).reasons, "there is no [task]"));
}

TEST(Needs, AreLeftOutWithTheLevelsThatHaveThem) {
  const Study whole = study_of_template("head-tracking");
  const auto rest = without_needs(whole, {"head-tracking"});
  ASSERT_TRUE(rest);
  ASSERT_EQ(rest->independent[0].levels.size(), 1U);
  EXPECT_EQ(rest->independent[0].levels[0].id, "fixed");
  EXPECT_TRUE(check_study(*rest).reasons.empty());
  EXPECT_NE(rest->hash, whole.hash);
  EXPECT_EQ(without_needs(whole, {})->hash, whole.hash);
  const auto menus = without_needs(study_of_template("menu"), {"haptic-menu"});
  EXPECT_EQ(menus->independent[1].levels.size(), 2U);  // no level needs it alone
  EXPECT_TRUE(check_study(*menus).reasons.empty());
}

TEST(Needs, SimulatedPeopleHaveAHeadAndTwoEyesButNoVoice) {
  const Study study = study_of_template("head-tracking");
  EXPECT_EQ(all_needs(study), (std::vector<std::string>{"pointer", "force-feedback", "head-tracking"}));
  EXPECT_TRUE(unmet_needs(study).empty());
  EXPECT_TRUE(needs_not_simulated(study).empty());
  ASSERT_EQ(needs_beyond_pointer(study).size(), 1U);
  EXPECT_EQ(needs_beyond_pointer(study)[0].of, "level 'tracked' of 'viewpoint'");
  Study spoken = study;
  spoken.needs = {"speech", "stereo"};
  ASSERT_EQ(needs_not_simulated(spoken).size(), 1U);
  EXPECT_EQ(needs_not_simulated(spoken)[0].id, "speech");
  EXPECT_TRUE(unmet_needs(spoken).empty());
  EXPECT_EQ(needs_beyond_pointer(spoken)[0].id, "speech");
}

TEST(Needs, SomethingMustBeLeft) {
  Study study = study_of_template("head-tracking");
  study.independent[0].levels[1].needs = {"head-tracking"};
  const auto none = without_needs(study, {"head-tracking"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, "no level of 'viewpoint' can be run without head-tracking.");
}

TEST(StudyCheck, MenusCanBeRun) {
  const StudyCheck check = check_study(study_of_template("menu"));
  EXPECT_EQ(check.groups, 2U);
  EXPECT_EQ(check.conditions, 2U);
  EXPECT_EQ(check.balanced_by, 4U);
  EXPECT_EQ(check.trials, 30U);
  EXPECT_TRUE(check.reasons.empty());
  EXPECT_TRUE(needs_not_simulated(study_of_template("menu")).empty());
  EXPECT_FALSE(says(check.warnings, "do not balance"));
}

TEST(StudyCheck, BlankCanBeRun) {
  const StudyCheck check = check_study(study_of_template("blank"));
  EXPECT_TRUE(check.reasons.empty());
  // 2 conditions of 13 trials of 9 s, a minute between them, and questions.
  EXPECT_GT(check.session, 294.0);
  EXPECT_LT(check.session, 600.0);
}

TEST(StudyCheck, WeakDesignsAreTold) {
  Study study = study_of_template("blank");
  study.participants = 15;
  study.order = OrderMethod::LatinSquare;
  study.consent.clear();
  study.dependent[0].from.clear();
  study.trials.practice = 0;
  study.trials.criterion.reset();
  study.hypotheses.pop_back();
  const StudyCheck check = check_study(study);
  EXPECT_TRUE(says(check.warnings, "15 people do not balance the design: choose a multiple of 2"));
  EXPECT_TRUE(says(check.warnings, "no consent text"));
  EXPECT_TRUE(says(check.warnings, "nothing measures 'time'"));
  EXPECT_TRUE(says(check.warnings, "hypothesis 'faster' is about 'time', which nothing measures"));
  EXPECT_TRUE(says(check.warnings, "nobody practises"));
  EXPECT_TRUE(says(check.warnings, "no hypothesis is about 'preference'"));
  EXPECT_TRUE(check.reasons.empty());
}

TEST(StudyCheck, TestsMustSuitTheirVariables) {
  Study study = study_of_template("blank");
  study.dependent[0].scale = Scale::Ordinal;
  study.hypotheses[1].test = study::Test::Anova;
  EXPECT_TRUE(says(check_study(study).warnings, "compares means of an ordinal variable"));
  EXPECT_TRUE(says(check_study(study).warnings, "is about a nominal variable"));
  study.hypotheses[0].test = study::Test::Kruskal;
  EXPECT_TRUE(says(check_study(study).warnings, "'technique' is within; use friedman"));
  study.hypotheses[1].test = study::Test::ChiSquared;
  study.hypotheses[1].direction = Direction::Less;
  EXPECT_TRUE(says(check_study(study).warnings, "counts of answers, which have no direction"));
  study.hypotheses[0].test = study::Test::None;
  EXPECT_TRUE(says(check_study(study).warnings, "has no test"));
}

TEST(StudyCheck, TestsOfPairsMustSayWhichOfThreeLevels) {
  Study study = study_of_template("blank");  // expects new < old
  study.independent[0].levels.push_back({"third", {"Third"}, {}, {}});
  EXPECT_FALSE(says(check_study(study).warnings, "compares two levels"));
  study.hypotheses[0].direction = Direction::Differ;
  EXPECT_TRUE(says(check_study(study).warnings, "compares two levels, and 'technique' has 3"));
}

/// What is warned of a test of the "preferred" question or of time in the study of the blank template.
bool cannot_be_tested(Study study, const char* dependent, const char* factor, Test test) {
  Hypothesis& hypothesis = study.hypotheses[0];
  hypothesis.dependent = dependent;
  hypothesis.factor = factor;
  hypothesis.direction = Direction::Differ;
  hypothesis.test = test;
  return says(check_study(study).warnings, "hypothesis '" + hypothesis.id + "' cannot be tested: ");
}

Item& preferred(Study& study, AskWhen when) {
  for (Questionnaire& questionnaire : study.questionnaires) {
    if (questionnaire.id != "comparison") continue;
    questionnaire.when = when;
    return questionnaire.items[0];
  }
  throw std::runtime_error("the template has no comparison");
}

/// With a between factor "room" besides the within factor "technique".
Study study_of_groups() {
  Study study = study_of_template("blank");
  study.independent.push_back(study.independent[0]);
  study.independent[1].id = "room";
  study.independent[1].between = true;
  study.dependent[1].scale = Scale::Nominal;
  return study;
}

TEST(StudyCheck, TemplatesCanBeTested) {
  for (const char* const name : {"blank", "head-tracking", "menu"})
    EXPECT_FALSE(says(check_study(study_of_template(name)).warnings, "cannot be tested")) << name;
}

TEST(StudyCheck, CountsAreOfAnswersThatAreGivenOnce) {
  Study study = study_of_groups();
  for (const study::Test test : {study::Test::ChiSquared, study::Test::Fisher}) {
    EXPECT_TRUE(cannot_be_tested(study, "time", "room", test));
    EXPECT_FALSE(cannot_be_tested(study, "preference", "room", test));
    EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", test));
  }
  EXPECT_FALSE(cannot_be_tested(study, "preference", "", study::Test::ChiSquared));
  Item& item = preferred(study, AskWhen::AfterCondition);
  EXPECT_TRUE(cannot_be_tested(study, "preference", "room", study::Test::ChiSquared));
  EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", study::Test::ChiSquared));
  preferred(study, AskWhen::End);
  item.kind = ItemKind::Choices;
  EXPECT_TRUE(cannot_be_tested(study, "preference", "room", study::Test::ChiSquared));
  item.kind = ItemKind::Number;
  EXPECT_TRUE(cannot_be_tested(study, "preference", "room", study::Test::Fisher));
  item.kind = ItemKind::Rating;
  EXPECT_FALSE(cannot_be_tested(study, "preference", "room", study::Test::Fisher));
}

TEST(StudyCheck, ChangesAreOfChoicesUnderTheTwoLevelsOfTheOnlyWithinFactor) {
  Study study = study_of_groups();
  EXPECT_TRUE(cannot_be_tested(study, "time", "technique", study::Test::McNemar));
  EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", study::Test::McNemar));  // it is asked once
  Item& item = preferred(study, AskWhen::AfterCondition);
  EXPECT_FALSE(cannot_be_tested(study, "preference", "technique", study::Test::McNemar));
  EXPECT_TRUE(cannot_be_tested(study, "preference", "room", study::Test::McNemar));
  item.kind = ItemKind::Rating;
  EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", study::Test::McNemar));
  item.kind = ItemKind::Choice;
  study.independent[0].levels.push_back({"third", {"Third"}, {}, {}});
  EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", study::Test::McNemar));
  study.independent[0].levels.pop_back();
  study.independent[1].between = false;
  EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", study::Test::McNemar));
}

TEST(StudyCheck, LevelsAreComparedByNumbersThatAreAskedForInEach) {
  Study study = study_of_groups();
  study.dependent[1].scale = Scale::Ordinal;
  Item& item = preferred(study, AskWhen::End);
  EXPECT_TRUE(cannot_be_tested(study, "preference", "room", study::Test::Kruskal));  // choices are no numbers
  item.kind = ItemKind::Rating;
  EXPECT_FALSE(cannot_be_tested(study, "preference", "room", study::Test::Kruskal));
  for (const study::Test test :
       {study::Test::Friedman, study::Test::Wilcoxon, study::Test::Anova, study::Test::TTest}) {
    preferred(study, AskWhen::End);
    EXPECT_TRUE(cannot_be_tested(study, "preference", "technique", test));
    preferred(study, AskWhen::AfterCondition);
    EXPECT_FALSE(cannot_be_tested(study, "preference", "technique", test));
    EXPECT_FALSE(cannot_be_tested(study, "time", "technique", test));
  }
}

TEST(StudyCheck, ConditionsAreCrossedTheLastFactorFastest) {
  Study study = study_of_template("blank");
  study.independent.push_back(study.independent[0]);
  study.independent[1].levels.push_back({"third", {"Third"}, {}, {}});
  const auto all = crossings(study, false);
  ASSERT_EQ(all.size(), 6U);
  EXPECT_EQ(all[1], (Crossing{0, 1}));
  EXPECT_EQ(all[3], (Crossing{1, 0}));
  EXPECT_EQ(crossing_name(study, false, all[5]), "new, third");
  EXPECT_EQ(crossings(study, true), (std::vector<Crossing>{{}}));
  EXPECT_EQ(crossing_name(study, true, {}), "all");
  EXPECT_EQ(crossing_count(study, false, 64), 6U);
  EXPECT_EQ(crossing_count(study, false, 5), 6U);
}

TEST(Templates, AreFoundByName) {
  EXPECT_EQ(template_names().size(), 3U);
  EXPECT_EQ(study_template("menus", "x").error().message,
            "there is no template 'menus'; did you mean 'menu'?");
  EXPECT_NE(study_template("blank", "mine")->find("\nname = \"mine\""), std::string::npos);
  EXPECT_NE(study_template("blank", "not an id")->find("\nname = \"blank\""), std::string::npos);
}

TEST(StudyCheck, BinomialTestsHoldTwoAnswersAgainstEachOther) {
  Study study = study_of_template("head-tracking");
  EXPECT_FALSE(says(check_study(study).warnings, "cannot be tested"));
  const auto depth = std::ranges::find(study.hypotheses, "felt-depth", &Hypothesis::id);
  depth->answers.clear();
  EXPECT_TRUE(says(check_study(study).warnings,
                   "'felt-depth' cannot be tested: 'depth' has 3 answers, and binomial compares two"));
  depth->dependent = "time";
  EXPECT_TRUE(says(check_study(study).warnings, "'felt-depth' cannot be tested: trials measure 'time'"));
}

TEST(StudyCheck, SharesOfThreeAnswersAreAdvisedOn) {
  Study study = study_of_template("head-tracking");
  EXPECT_FALSE(says(check_study(study).warnings, "write test = \"binomial\""));
  const auto depth = std::ranges::find(study.hypotheses, "felt-depth", &Hypothesis::id);
  depth->test = study::Test::ChiSquared;
  EXPECT_TRUE(says(check_study(study).warnings,
                   "hypothesis 'felt-depth' asks whether all 3 answers are given equally often"));
}

TEST(StudyCheck, PowerIsToldToBeOfPlainP) {
  Study study = study_of_template("blank");
  EXPECT_TRUE(says(check_study(study).warnings, "Holm's adjustment for several hypotheses asks for more"));
  study.hypotheses.resize(1);
  EXPECT_FALSE(says(check_study(study).warnings, "Holm"));
}

}  // namespace
}  // namespace icome::study
