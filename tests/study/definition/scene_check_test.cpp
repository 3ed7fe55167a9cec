#include "study/definition/scene_check.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "study/box_menu.h"
#include "study/definition/spoken_choices.h"

namespace icome::study {
namespace {

StudyCheck checked(const TemplateFolder& folder, const Study& study) {
  StudyCheck check;
  check_scenes(study, folder.path(), check);
  return check;
}

TEST(SceneCheck, ScenesOfTemplatesHaveAllThatTrialsAskFor) {
  for (const char* const name : {"blank", "head-tracking", "menu"}) {
    const TemplateFolder folder(name);
    const StudyCheck check = checked(folder, folder.study());
    EXPECT_TRUE(check.reasons.empty()) << name << ": " << check.reasons[0].sentence;
    EXPECT_TRUE(check.warnings.empty()) << name << ": " << check.warnings[0].sentence;
  }
}

TEST(SceneCheck, EachSceneWithoutTheTargetIsTold) {
  const TemplateFolder folder("head-tracking");
  Study study = folder.study();
  study.task->target = "goal";
  const StudyCheck check = checked(folder, study);
  ASSERT_EQ(check.reasons.size(), study.trials.scenes.size() + 1);  // practice, too
  EXPECT_EQ(check.reasons[0].place.line, study.task->place.line);
  EXPECT_NE(
      check.reasons[0].sentence.find(": the task's target is 'goal', and nothing in the scene is called"),
      std::string::npos);
  EXPECT_TRUE(check.warnings.empty());
}

TEST(SceneCheck, EveryValueOfATrialIsLookedAt) {
  const TemplateFolder folder("menu");
  Study study = folder.study();
  study.trials.variables[0].values[3].id = "pink";
  const StudyCheck one = checked(folder, study);
  ASSERT_EQ(one.reasons.size(), 1U);
  EXPECT_NE(one.reasons[0].sentence.find("the task's target is 'menu/pink'"), std::string::npos);
  EXPECT_EQ(one.reasons[0].sentence.find("either"), std::string::npos);
  ASSERT_EQ(one.warnings.size(), 1U);
  EXPECT_NE(one.warnings[0].sentence.find("the task shows 'cube-pink', and nothing"), std::string::npos);
  study.trials.variables[0].values[5].id = "brown";
  const StudyCheck two = checked(folder, study);
  ASSERT_EQ(two.reasons.size(), 1U);
  EXPECT_NE(two.reasons[0].sentence.find("Trials with 'menu/brown' as the target have none either."),
            std::string::npos);
}

TEST(SceneCheck, OfManyCombinationsEachValueIsLookedAt) {
  const TemplateFolder folder("menu");
  Study study = folder.study();
  TrialVariable other = study.trials.variables[0];
  other.id = "size";
  other.values.resize(200, {"big", {"Big"}, {}, {}});
  study.trials.variables.push_back(other);
  study.task->wrong = "menu/{size}";
  EXPECT_TRUE(checked(folder, study).reasons.empty());
  study.trials.variables[0].values[6].id = "pink";
  EXPECT_EQ(checked(folder, study).reasons.size(), 1U);
}

TEST(SceneCheck, ATargetThatIsTakenAwayIsNone) {
  const TemplateFolder folder("menu");
  Study study = folder.study();
  study.task->target = "cube-red";
  EXPECT_EQ(checked(folder, study).reasons.size(), 1U);
  study.task->shown.clear();
  EXPECT_TRUE(checked(folder, study).reasons.empty());
}

/// The check of a study whose things are chosen by saying their names, with another name for the block.
StudyCheck checked_aloud(const char* block) {
  const TemplateFolder folder("blank");
  Study study = folder.study();
  const std::filesystem::path scene = folder.path() / study.trials.scenes[0].file;
  std::stringstream text;
  text << std::ifstream(scene).rdbuf();
  std::ofstream(scene) << std::regex_replace(text.str(), std::regex("DEF block"),
                                             fmt::format("DEF {}", block));
  study.independent[0].levels[1].needs = {"speech"};
  return checked(folder, study);
}

TEST(SceneCheck, NamesThatSoundAlikeAreToldWhereTheyAreSaid) {
  EXPECT_TRUE(checked_aloud("block").reasons.empty());
  const StudyCheck alike = checked_aloud("Target");
  ASSERT_EQ(alike.reasons.size(), 1U);
  EXPECT_NE(alike.reasons[0].sentence.find("sound alike"), std::string::npos) << alike.reasons[0].sentence;
  // What is wrong need not have a name; what is looked for must.
  EXPECT_TRUE(checked_aloud("___").reasons.empty());
}

TEST(SpokenChoices, ATargetWithoutWordsIsRefused) {
  TrialGoal goal;
  goal.things = {{"___", {}, true, false, {}}, {"ball", {}, false, true, {}}};
  const auto choices = spoken_choices(goal);
  ASSERT_FALSE(choices);
  EXPECT_NE(choices.error().message.find("'___' is the target, and has no name"), std::string::npos);
  goal.things[0].name = "★";  // a word, without sounds
  EXPECT_FALSE(spoken_choices(goal));
  goal.things[0].name = "Box 2";
  const auto said = spoken_choices(goal);
  ASSERT_TRUE(said);
  EXPECT_EQ(said->chosen({"select", "the", "box", "two"}), 0);
  EXPECT_EQ(said->chosen({"ball"}), 1);
  EXPECT_EQ(said->chosen({"cone"}), -1);
}

TEST(SceneCheck, WhatIsNeverWrongIsWorthAThought) {
  const TemplateFolder folder("head-tracking");
  Study study = folder.study();
  study.task->wrong = "nothing-*";
  const StudyCheck check = checked(folder, study);
  EXPECT_TRUE(check.reasons.empty());
  ASSERT_EQ(check.warnings.size(), 1U);
  EXPECT_NE(check.warnings[0].sentence.find("choosing 'nothing-*' is an error"), std::string::npos);
}

TEST(SceneCheck, FilesThatAreNoScenesAreTold) {
  const TemplateFolder folder("blank");
  const Study& study = folder.study();
  const std::filesystem::path scene = folder.path() / study.trials.scenes[0].file;
  std::ofstream(scene, std::ios::trunc) << "hello";
  StudyCheck check = checked(folder, study);
  ASSERT_EQ(check.reasons.size(), 1U);
  EXPECT_EQ(check.reasons[0].place.line, study.trials.scenes[0].place.line);
  EXPECT_NE(check.reasons[0].sentence.find("pointing-room.wrl: is not VRML 2.0"), std::string::npos);
  std::filesystem::remove(scene);
  check = checked(folder, study);
  ASSERT_EQ(check.reasons.size(), 1U);
  EXPECT_NE(check.reasons[0].sentence.find("there is no file"), std::string::npos);
}

TEST(SceneCheck, APracticeSceneMattersWhereSomebodyPractises) {
  const TemplateFolder folder("blank");
  Study study = folder.study();
  std::ofstream(folder.path() / "bare.wrl") << "#VRML V2.0 utf8\n";
  study.trials.practice_scene = TrialScene{"bare", "bare.wrl", {}, {}, {}};
  study.trials.practice = 0;
  study.trials.criterion.reset();
  EXPECT_TRUE(checked(folder, study).reasons.empty());
  study.trials.criterion = PracticeCriterion{};
  const StudyCheck check = checked(folder, study);
  ASSERT_EQ(check.reasons.size(), 1U);
  EXPECT_NE(check.reasons[0].sentence.find("scene 'bare': "), std::string::npos);
}

TEST(SceneCheck, ScenesWithoutFilesAndStudiesWithoutTaskAreForOtherChecks) {
  const TemplateFolder folder("blank");
  Study study = folder.study();
  study.task.reset();
  EXPECT_TRUE(checked(folder, study).reasons.empty());
  study = folder.study();
  study.task->wrong = "nothing";
  study.trials.scenes[0].file.clear();
  EXPECT_TRUE(checked(folder, study).reasons.empty());
  EXPECT_TRUE(checked(folder, study).warnings.empty());
}

TEST(SceneCheck, AMenuOfBoxesIsStillOne) {
  const BoxMenuFolder folder;
  StudyCheck check;
  check_scenes(folder.study, folder.path(), check);
  EXPECT_TRUE(check.reasons.empty()) << check.reasons[0].sentence;
  EXPECT_TRUE(check.warnings.empty());
}

TEST(SceneCheck, AnElementThatCannotBeReadIsTold) {
  const TemplateFolder folder("menu");
  std::ofstream(folder.path() / "scenes/colour-menu.toml", std::ios::trunc) << "[[item]]\nnmae = \"red\"\n";
  const StudyCheck check = checked(folder, folder.study());
  ASSERT_EQ(check.reasons.size(), 1U);
  EXPECT_NE(check.reasons[0].sentence.find("colour-menu.toml:2:1"), std::string::npos)
      << check.reasons[0].sentence;
  EXPECT_EQ(check.reasons[0].place.line, folder.study().trials.scenes[0].element->place.line);
  std::filesystem::remove(folder.path() / "scenes/colour-menu.toml");
  EXPECT_EQ(checked(folder, folder.study()).reasons.size(), 1U);
}

TEST(SceneCheck, ALanguageThatAnElementLacksIsWorthAThought) {
  const TemplateFolder folder("menu");
  Study study = folder.study();
  study.languages.push_back("fr");
  const StudyCheck check = checked(folder, study);
  EXPECT_TRUE(check.reasons.empty());
  ASSERT_EQ(check.warnings.size(), 1U);
  EXPECT_NE(check.warnings[0].sentence.find("has no texts in 'fr'"), std::string::npos);
}

}  // namespace
}  // namespace icome::study
