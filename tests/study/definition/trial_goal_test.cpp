#include "study/definition/trial_goal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "interaction/object_edits.h"
#include "study/small_study.h"
#include "study/trial_scenes.h"
#include "world/edit/edit.h"

namespace icome::study {
namespace {

std::set<std::string> names(const TrialGoal& goal, bool Thing::*which) {
  std::set<std::string> names;
  for (const Thing& thing : goal.things)
    if (thing.*which) names.insert(thing.name);
  return names;
}

TEST(TrialGoal, TheRoomsOfTheHeadTrackingStudyHaveATargetAmongObstacles) {
  const TemplateFolder folder("head-tracking");
  const Study& study = folder.study();
  for (std::size_t number = 0; number < 4; ++number) {
    const TrialPlan plan = measured_trial(study, {}, 0, number);
    const auto goal =
        trial_goal(study, {}, plan, folder.scene("room-" + std::to_string(number + 1) + ".wrl"));
    ASSERT_TRUE(goal) << goal.error().message;
    EXPECT_EQ(names(*goal, &Thing::target), std::set<std::string>{"target"});
    EXPECT_TRUE(names(*goal, &Thing::wrong).contains("cube"));
    EXPECT_EQ(goal->hold, 10.0);
    EXPECT_GT(goal->distance_to_vicinity(goal->start), goal->vicinity);
    for (const Thing& thing : goal->things) EXPECT_FALSE(thing.bounds.contains(goal->start)) << thing.name;
  }
}

TEST(TrialGoal, RoomsGrowMoreComplex) {
  const TemplateFolder folder("head-tracking");
  std::size_t before = folder.scene("practice-room.wrl").objects().size();
  for (const char* const room : {"room-1.wrl", "room-2.wrl", "room-3.wrl"}) {
    const std::size_t now = folder.scene(room).objects().size();
    EXPECT_GT(now, before) << room;
    before = now;
  }
}

TEST(TrialGoal, OneCubeIsShownAndItsItemIsTheTarget) {
  const TemplateFolder folder("menu");
  const Study& study = folder.study();
  world::World world = folder.scene("menu-room.wrl");
  const TrialPlan plan = measured_trial(study, {}, 0, 0);
  const auto hidden = hidden_things(study, plan, world);
  EXPECT_EQ(hidden.size(), 6U);
  ASSERT_TRUE(world::apply(world, interaction::delete_objects(world, hidden)));
  const auto goal = trial_goal(study, {}, plan, world);
  ASSERT_TRUE(goal) << goal.error().message;
  const std::string colour = study.trials.variables[0].values[plan.values[0]].id;
  EXPECT_EQ(names(*goal, &Thing::target), std::set<std::string>{"item-" + colour});
  EXPECT_EQ(names(*goal, &Thing::wrong).size(), 6U);
  const auto cubes =
      std::ranges::count_if(goal->things, [](const Thing& thing) { return thing.name.starts_with("cube-"); });
  EXPECT_EQ(cubes, 1);
}

TEST(TrialGoal, LevelsOfGroupAndConditionSayHowThingsAreChosen) {
  const TemplateFolder folder("menu");
  const Study& study = folder.study();
  const world::World world = folder.scene("menu-room.wrl");
  Participant person;
  TrialPlan plan = measured_trial(study, person, 0, 0);
  for (const std::size_t group : {0U, 1U}) {
    for (const std::size_t condition : {0U, 1U}) {
      person.group = group;
      plan.condition = condition;
      const auto goal = trial_goal(study, person, plan, world);
      ASSERT_TRUE(goal);
      EXPECT_EQ(goal->choosing, group == 0 ? Choosing::Click : Choosing::Push);
      EXPECT_EQ(goal->forces, condition == 0);
    }
  }
}

TEST(TrialGoal, WithoutTaskOrTargetItSaysWhatIsMissing) {
  const TemplateFolder folder("blank");
  Study study = folder.study();
  const world::World world = folder.scene("pointing-room.wrl");
  const TrialPlan plan = measured_trial(study, {}, 0, 0);
  study.task->target = "goal";
  const auto none = trial_goal(study, {}, plan, world);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("'goal'"), std::string::npos);
  EXPECT_NE(none.error().message.find("block, cube"), std::string::npos);
  study.task.reset();
  EXPECT_NE(trial_goal(study, {}, plan, world).error().message.find("[task]"), std::string::npos);
}

TEST(TrialGoal, NamesHoldValuesOfTheTrial) {
  const Study study = small_study();
  TrialPlan plan;
  plan.values = {1};
  EXPECT_EQ(name_in_trial(study, plan, "a-{colour}-{colour}"), "a-blue-blue");
  EXPECT_EQ(name_in_trial(study, plan, "{size}"), "{size}");
  EXPECT_TRUE(is_meant("item-*", "item-red"));
  EXPECT_FALSE(is_meant("item-*", "an item-red"));
}

TEST(TrialGoal, TheNearestOfEquallyNearThingsIsTheFirst) {
  TrialGoal goal;
  const base::Bounds box(base::Vector3(-1, -1, -1), base::Vector3(1, 1, 1));
  goal.things = {
      {"floor", box, false, false, {}}, {"one", box, false, true, {}}, {"two", box, true, false, {}}};
  EXPECT_EQ(goal.nearest(base::Vector3(0, 0, 1.005)), 1);
  EXPECT_EQ(goal.nearest(base::Vector3(0, 0, 1.02)), -1);
}

/// What the first trial of a study in its scene says of stereo.
std::optional<bool> stereo_of(const TemplateFolder& folder, const Study& study, std::size_t condition) {
  TrialPlan plan = measured_trial(study, {}, 0, 0);
  plan.condition = condition;
  const auto goal = trial_goal(study, {}, plan, folder.scene("room-1.wrl"));
  EXPECT_TRUE(goal);
  return goal ? goal->stereo : std::nullopt;
}

TEST(TrialGoal, StereoIsOnWhereAStudyALevelOrTheTaskHasIt) {
  const TemplateFolder folder("head-tracking");
  Study study = folder.study();
  EXPECT_EQ(stereo_of(folder, study, 0), std::nullopt) << "as a person has chosen it";
  study.needs.push_back("stereo");
  EXPECT_EQ(stereo_of(folder, study, 1), true);
  study = folder.study();
  study.independent[0].levels[0].needs.push_back("stereo");
  EXPECT_EQ(stereo_of(folder, study, 0), true);
  EXPECT_EQ(stereo_of(folder, study, 1), false) << "the other level is without";
  study = folder.study();
  study.independent[0].levels[1].stereo = true;
  EXPECT_EQ(stereo_of(folder, study, 0), false);
  EXPECT_EQ(stereo_of(folder, study, 1), true);
  study.independent[0].levels[1].stereo = false;
  study.task->stereo = true;
  EXPECT_EQ(stereo_of(folder, study, 0), true);
  EXPECT_EQ(stereo_of(folder, study, 1), false);
}

}  // namespace
}  // namespace icome::study
