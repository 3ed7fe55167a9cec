#include "study/definition/trial_goal.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>

#include "interaction/object_edits.h"
#include "study/box_menu.h"
#include "study/small_study.h"
#include "study/trial_menus.h"
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
  const BoxMenuFolder folder;
  const Study& study = folder.study;
  world::World world = folder.scene();
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
  const BoxMenuFolder folder;
  const Study& study = folder.study;
  const world::World world = folder.scene();
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

Study menu_study() {
  Study study = small_study();
  study.task->target = "menu/{colour}";
  study.task->wrong = "menu/*";
  return study;
}

base::Result<TrialGoal> goal_with(const Study& study, const interaction::Element& element) {
  const StageElement stage = on_stage(element);
  return trial_goal(study, {}, measured_trial(study, {}, 0, 0), {}, &stage);
}

TEST(TrialGoal, WidgetsOfAnElementAreThings) {
  const Study study = menu_study();
  interaction::Element element = two_items();
  element.widgets.push_back(item_named("more"));
  element.widgets[2].widgets = {item_named("green")};
  element.centre = base::Vector3(0.1, 0.2, 0.3);
  const auto goal = goal_with(study, element);
  ASSERT_TRUE(goal) << goal.error().message;
  const std::string colour = study.trials.variables[0].values[measured_trial(study, {}, 0, 0).values[0]].id;
  const std::string other = colour == "red" ? "blue" : "red";
  EXPECT_TRUE(goal->is_in_element());
  EXPECT_EQ(names(*goal, &Thing::target), std::set<std::string>{"menu/" + colour});
  EXPECT_EQ(names(*goal, &Thing::wrong), (std::set<std::string>{"menu/" + other, "menu/green"}));
  EXPECT_NEAR((goal->things[0].bounds.center() - element.centre).z(), 0.0, 1e-12);
  EXPECT_TRUE(goal->things[3].bounds.isEmpty());  // its menu is not open
  EXPECT_EQ(goal->distance_to_vicinity(element.centre), std::numeric_limits<double>::infinity());
}

TEST(TrialGoal, AnElementIsChosenFromAsTheTrialHasIt) {
  Study study = menu_study();  // its first level chooses by touch, its second by click
  const interaction::Element element = two_items();
  const StageElement stage = on_stage(element);
  TrialPlan plan = measured_trial(study, {}, 0, 0);
  plan.condition = 1;
  const auto click = trial_goal(study, {}, plan, {}, &stage);
  EXPECT_TRUE(click->element->element->choosing.by_click);
  EXPECT_FALSE(click->element->element->choosing.by_push);
  EXPECT_EQ(click->near, 0.02);  // the element's own
  EXPECT_EQ(click->depth, 0.003);
  EXPECT_EQ(click->vicinity, 0.02);
  study.task->near = 0.03;
  study.task->depth = 0.004;
  study.task->vicinity = 0.05;
  const auto other = trial_goal(study, {}, plan, {}, &stage);
  EXPECT_EQ(other->element->element->choosing.near, 0.03);
  EXPECT_GT(other->element->element->choosing.recede, 0.03);
  EXPECT_EQ(other->element->element->choosing.push_depth, 0.004);
  EXPECT_EQ(other->vicinity, 0.05);
}

TEST(TrialGoal, AnElementWithoutTheTargetOrWithADisabledOneIsTold) {
  const Study study = menu_study();
  interaction::Element element = two_items();
  for (interaction::Widget& widget : element.widgets) widget.enabled = false;
  EXPECT_NE(goal_with(study, element).error().message.find("is disabled"), std::string::npos);
  element.widgets = {item_named("pink")};
  const auto none = goal_with(study, element);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("menu/pink"), std::string::npos) << none.error().message;
}

/// Says whether the first trial of a study in its scene is in stereo.
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
