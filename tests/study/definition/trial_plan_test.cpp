#include "study/definition/trial_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "study/small_study.h"

namespace icome::study {
namespace {

TEST(TrialPlan, TheSameTrialIsDrawnTheSameAgain) {
  const Study study = small_study();
  Participant person;
  person.number = 3;
  for (std::size_t number = 0; number < 6; ++number)
    EXPECT_EQ(measured_trial(study, person, 1, number), measured_trial(study, person, 1, number));
}

TEST(TrialPlan, ShuffledValuesAndScenesComeOnceBeforeOneComesAgain) {
  const Study study = small_study();
  for (std::size_t who = 0; who < 20; ++who) {
    Participant person;
    person.number = who;
    for (std::size_t block = 0; block < 3; ++block) {
      std::set<std::size_t> colours, scenes;
      for (std::size_t i = 0; i < 2; ++i) {
        const TrialPlan plan = measured_trial(study, person, 0, 2 * block + i);
        colours.insert(plan.values[0]);
        scenes.insert(*plan.scene);
      }
      EXPECT_EQ(colours.size(), 2U);
      EXPECT_EQ(scenes.size(), 2U);
    }
  }
}

TEST(TrialPlan, PeopleConditionsAndPracticeAreDrawnApart) {
  const Study study = small_study();
  std::size_t differ = 0;
  for (std::size_t who = 0; who < 40; ++who) {
    Participant person, other;
    person.number = who;
    other.number = who + 40;
    differ +=
        measured_trial(study, person, 0, 0).values != measured_trial(study, other, 0, 0).values ? 1U : 0U;
    differ +=
        measured_trial(study, person, 0, 0).values != measured_trial(study, person, 1, 0).values ? 1U : 0U;
    differ +=
        measured_trial(study, person, 0, 0).values != practice_trial(study, person, 0, 0).values ? 1U : 0U;
  }
  EXPECT_GT(differ, 30U);  // of 120, half by chance
  EXPECT_LT(differ, 90U);
}

TEST(TrialPlan, FreeDrawsGiveEveryValueAboutAsOften) {
  Study study = small_study();
  study.trials.variables[0].shuffled = false;
  std::size_t red = 0;
  for (std::size_t who = 0; who < 100; ++who) {
    Participant person;
    person.number = who;
    for (std::size_t number = 0; number < 10; ++number)
      red += measured_trial(study, person, 0, number).values[0] == 0 ? 1U : 0U;
  }
  EXPECT_NEAR(double(red), 500.0, 64.0);  // four standard deviations of 1,000 coins
}

TEST(TrialPlan, PracticeTakesPlaceInItsOwnScene) {
  Study study = small_study();
  study.trials.practice_scene = study.trials.scenes[1];
  study.trials.practice_scene->id = "practice";
  const TrialPlan practice = practice_trial(study, {}, 0, 0);
  EXPECT_EQ(scene_of(study, practice)->id, "practice");
  EXPECT_NE(scene_of(study, measured_trial(study, {}, 0, 0))->id, "practice");
}

TEST(TrialPlan, WithoutScenesThereIsNone) {
  Study study = small_study();
  study.trials.scenes.clear();
  EXPECT_EQ(scene_of(study, measured_trial(study, {}, 0, 0)), nullptr);
}

}  // namespace
}  // namespace icome::study
