#include "study/run/trial_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "study/small_study.h"
#include "study/trial_menus.h"

namespace icome::study {
namespace {

using base::Vector3;

/// A target at z = -0.1 and something wrong beside it, boxes of 2 cm.
TrialGoal goal(Choosing choosing) {
  TrialGoal goal;
  const auto box = [](double x) {
    return base::Bounds(Vector3(x - 0.01, -0.01, -0.11), Vector3(x + 0.01, 0.01, -0.09));
  };
  goal.things = {{"target", box(0.0), true, false, {}}, {"wrong", box(0.05), false, true, {}}};
  goal.choosing = choosing;
  goal.hold = 0.01;
  goal.limit = 2.0;
  return goal;
}

/// Ticks of 1 ms.
class Hand {
 public:
  explicit Hand(const TrialGoal& goal) : watch(goal) {}

  /// Is at a place for some ticks.
  void at(const Vector3& tip, int ticks = 1, int touched = -1, std::uint32_t buttons = 0, double deep = 0.0) {
    for (int i = 0; i < ticks; ++i) {
      Sample tick;
      tick.time = 0.001 * count_++;
      tick.tip = tip;
      tick.scp = tip + Vector3(0.0, 0.0, deep);
      tick.touched = touched;
      tick.buttons = buttons;
      watch.step(tick);
    }
  }

  void begin() {
    at(Vector3::Zero(), 11);
    watch.release();
    at(Vector3::Zero());
  }

  TrialWatch watch;

 private:
  int count_ = 5000;
};

const Vector3 kFront(0.0, 0.0, -0.09), kAside(0.05, 0.0, -0.09), kFree(0.0, 0.0, -0.05);

TEST(TrialWatch, WaitsForThePointerAtTheStartAndHoldsItThere) {
  Hand hand(goal(Choosing::Touch));
  hand.at(Vector3(0.0, 0.0, 0.011), 50);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Seeking);
  hand.at(Vector3(0.0, 0.0, 0.009), 5);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Holding);
  EXPECT_NEAR(hand.watch.hold_left(), 0.006, 1e-9);  // 4 of 10 ms
  EXPECT_FALSE(hand.watch.is_due());
  hand.at(Vector3::Zero(), 6);
  EXPECT_TRUE(hand.watch.is_due());
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Holding);  // until it is let go
  hand.watch.release();
  hand.at(Vector3::Zero());
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
}

TEST(TrialWatch, TouchingTheTargetEndsTheTrial) {
  Hand hand(goal(Choosing::Touch));
  hand.begin();
  hand.at(kFree, 100);
  hand.at(Vector3(0.0, 0.0, -0.065), 50);  // 25 mm off: in the vicinity of 30
  hand.at(kFront, 1, 0);
  ASSERT_EQ(hand.watch.state(), TrialWatch::State::Over);
  const TrialMeasures& measures = hand.watch.measures();
  EXPECT_TRUE(measures.completed);
  EXPECT_NEAR(measures.time, 0.151, 1e-9);
  EXPECT_NEAR(measures.approach_time, 0.101, 1e-9);
  EXPECT_NEAR(measures.homing_time, 0.050, 1e-9);
  EXPECT_NEAR(measures.distance, 0.09, 1e-9);
  EXPECT_EQ(measures.errors, 0);
  const auto& samples = hand.watch.samples();
  ASSERT_EQ(samples.size(), 163U);  // 11 held, the start, 151
  EXPECT_NEAR(samples.front().time, -0.011, 1e-9);
  EXPECT_NEAR(samples[11].time, 0.0, 1e-9);
  EXPECT_NEAR(samples.back().time, 0.151, 1e-9);
}

TEST(TrialWatch, EachThingThatIsSaidCounts) {
  Hand hand(goal(Choosing::Touch));
  hand.begin();
  hand.watch.say(1);
  hand.watch.say(0);
  hand.at(kFree, 3);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_EQ(hand.watch.measures().errors, 1);
  EXPECT_TRUE(hand.watch.measures().completed);
}

TEST(TrialWatch, WrongTouchesCountOnceAndBouncesDoNot) {
  Hand hand(goal(Choosing::Touch));
  hand.begin();
  hand.at(kAside, 300, 1);   // one touch, however long
  hand.at(kAside, 240, -1);  // a bounce
  hand.at(kAside, 10, 1);
  EXPECT_EQ(hand.watch.measures().errors, 1);
  hand.at(kAside, 260, -1);  // left for more than 250 ms
  hand.at(kAside, 10, 1);
  EXPECT_EQ(hand.watch.measures().errors, 2);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
}

TEST(TrialWatch, ASeamBetweenTwoThingsIsOneErrorOfEach) {
  TrialGoal seam = goal(Choosing::Touch);
  seam.things.push_back({"other", seam.things[1].bounds, false, true, {}});
  Hand hand(seam);
  hand.begin();
  for (int i = 0; i < 50; ++i) {
    hand.at(kAside, 1, 1);
    hand.at(kAside, 1, 2);
  }
  EXPECT_EQ(hand.watch.measures().errors, 2);
}

TEST(TrialWatch, WhoPullsThePointerAwayWhileItIsHeldBringsItBack) {
  Hand hand(goal(Choosing::Touch));
  hand.at(Vector3::Zero(), 8);
  hand.at(Vector3(0.0, 0.0, 0.021));
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Seeking);
  hand.at(Vector3::Zero(), 8);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Holding);
  EXPECT_FALSE(hand.watch.is_due());  // it counts from the beginning
  EXPECT_EQ(hand.watch.samples().size(), 8U);
}

TEST(TrialWatch, WhatIsNeitherTargetNorWrongDoesNotCount) {
  TrialGoal free = goal(Choosing::Touch);
  free.things[1].wrong = false;
  Hand hand(free);
  hand.begin();
  hand.at(kAside, 10, 1);
  EXPECT_EQ(hand.watch.measures().errors, 0);
}

TEST(TrialWatch, AClickChoosesWhatIsNear) {
  Hand hand(goal(Choosing::Click));
  hand.begin();
  hand.at(kFree, 10, -1, 1);  // a click at nothing
  EXPECT_EQ(hand.watch.lit(), -1);
  hand.at(kAside + Vector3(0.0, 0.0, 0.009), 10);
  EXPECT_EQ(hand.watch.lit(), 1);
  hand.at(kAside + Vector3(0.0, 0.0, 0.009), 10, -1, 1);  // one click, held down
  EXPECT_EQ(hand.watch.measures().errors, 1);
  hand.at(kFront + Vector3(0.0, 0.0, 0.009), 10, -1, 1);  // dragged there: no click
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
  hand.at(kFront + Vector3(0.0, 0.0, 0.011), 1);
  hand.at(kFront + Vector3(0.0, 0.0, 0.011), 1, -1, 1);  // 11 mm off
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
  hand.at(kFront, 1);
  hand.at(kFront, 1, -1, 1);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_EQ(hand.watch.measures().errors, 1);
}

TEST(TrialWatch, APushMustBeDeepAndCountsOnceAContact) {
  Hand hand(goal(Choosing::Push));
  hand.begin();
  hand.at(kAside, 10, 1, 0, 0.0019);
  EXPECT_EQ(hand.watch.measures().errors, 0);
  hand.at(kAside, 10, 1, 0, 0.0021);
  hand.at(kAside, 10, 1, 0, 0.001);
  hand.at(kAside, 10, 1, 0, 0.003);  // still the same contact
  EXPECT_EQ(hand.watch.measures().errors, 1);
  hand.at(kFree, 10);
  hand.at(kAside, 10, 1, 0, 0.003);
  EXPECT_EQ(hand.watch.measures().errors, 2);
  hand.at(kFront, 1, 0, 0, 0.003);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Over);
}

TEST(TrialWatch, HomingBeginsAtAnyOfWhatIsChosenFrom) {
  Hand hand(goal(Choosing::Click));
  hand.begin();
  hand.at(kAside + Vector3(0.0, 0.0, 0.02), 100);  // by the wrong one
  hand.at(kFront, 1);
  hand.at(kFront, 1, -1, 1);
  EXPECT_NEAR(hand.watch.measures().approach_time, 0.001, 1e-9);
}

TEST(TrialWatch, ATrialEndsAtItsLimit) {
  Hand hand(goal(Choosing::Touch));
  hand.begin();
  hand.at(kFree, 3000);
  ASSERT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_FALSE(hand.watch.measures().completed);
  EXPECT_NEAR(hand.watch.measures().time, 2.0, 1e-9);
  EXPECT_NEAR(hand.watch.measures().approach_time, 2.0, 1e-9);  // never came near
  EXPECT_EQ(hand.watch.measures().homing_time, 0.0);
}

/// A trial whose target is the red one of two items, in a scene without objects; the menu stands at the
/// origin and the pointer starts 10 cm before it.
TrialGoal menu_goal(Choosing choosing, interaction::Element element = two_items()) {
  Study study = small_study();
  study.task->target = "menu/red";
  study.task->wrong = "menu/*";
  study.task->shown.clear();
  study.task->choosing = choosing;
  study.independent.clear();
  const StageElement stage = on_stage(std::move(element));
  TrialGoal goal = trial_goal(study, {}, measured_trial(study, {}, 0, 0), {}, &stage).value();
  goal.hold = 0.01;
  return goal;
}

/// A hand before the menu that has been let go at the start.
struct MenuHand : Hand {
  explicit MenuHand(const TrialGoal& goal) : Hand(goal) {
    at(goal.start, 11);
    watch.release();
    at(goal.start);
  }
  /// Before (> 0) or behind an item, m.
  Vector3 before(const std::string& name, double front) const {
    return middle_of(*watch.element(), name) + front * watch.element()->frame().normal();
  }
  int errors() const { return watch.measures().errors; }
};

TEST(TrialWatch, AClickNearAnItemOfAnElementChoosesIt) {
  MenuHand hand(menu_goal(Choosing::Click));
  hand.at(hand.before("blue", 0.025), 20, -1, 1);  // too far off (20 mm) to choose
  EXPECT_EQ(hand.watch.lit(), -1);
  hand.at(hand.before("blue", 0.015), 20);
  EXPECT_EQ(hand.watch.goal().things[std::size_t(hand.watch.lit())].name, "menu/blue");
  hand.at(hand.before("blue", 0.015), 20, -1, 1);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
  hand.at(hand.before("red", 0.015), 20);
  hand.at(hand.before("red", 0.015), 1, -1, 1);
  ASSERT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_TRUE(hand.watch.measures().completed);
  EXPECT_EQ(hand.errors(), 1);
  const Sample& last = hand.watch.samples().back();
  EXPECT_EQ(hand.watch.goal().things[std::size_t(last.chosen)].name, "menu/red");
  EXPECT_EQ(last.lit, last.chosen);
  EXPECT_EQ(last.touched, -1);
  // From its 20 ms on, after those at 25 mm: it lights up where the approach is over.
  EXPECT_NEAR(hand.watch.measures().approach_time, 0.021, 1e-9);
  EXPECT_NEAR(hand.watch.measures().time, 0.081, 1e-9);
}

TEST(TrialWatch, APushIntoAnItemCountsOnceHoweverTheHandTrembles) {
  MenuHand hand(menu_goal(Choosing::Push));
  hand.at(hand.before("blue", 0.01), 5, -1, 1);  // the button does nothing
  for (int i = 0; i < 300; ++i) hand.at(hand.before("blue", -0.003 + 0.0015 * std::sin(0.3 * i)));
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
  hand.at(hand.before("blue", 0.002), 5);
  hand.at(hand.before("blue", -0.0029), 5);
  const Sample pressed = hand.watch.samples().back();
  EXPECT_EQ(hand.watch.goal().things[std::size_t(pressed.touched)].name, "menu/blue");
  EXPECT_NEAR((pressed.scp - pressed.tip).norm(), 0.0029, 1e-12);
  hand.at(hand.before("blue", 0.01), 5);
  hand.at(hand.before("red", 0.01), 5);
  hand.at(hand.before("red", -0.0031));
  ASSERT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_EQ(hand.errors(), 1);
}

TEST(TrialWatch, AnElementIsNotPushedFromBehind) {
  MenuHand hand(menu_goal(Choosing::Push));
  hand.at(hand.before("red", 0.0) + Vector3(0.2, 0.0, -0.05), 5);  // round it
  for (const double front : {-0.05, -0.01, -0.004, -0.001, 0.001, 0.01})
    hand.at(hand.before("red", front), 5);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Running);
  for (const Sample& sample : hand.watch.samples()) EXPECT_EQ(sample.touched, -1);
  hand.at(hand.before("red", -0.004));
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Over);
}

TEST(TrialWatch, PassingBesideAnElementIsNoApproach) {
  MenuHand hand(menu_goal(Choosing::Click));
  const double half = hand.watch.element()->layout().sheets.front().half.x();
  hand.at(Vector3(half + 0.006, 0.0, 0.01), 100);  // 5 mm are the margin
  hand.at(Vector3(half + 0.004, 0.0, 0.019), 1);
  hand.at(hand.before("red", 0.01), 5);
  hand.at(hand.before("red", 0.01), 1, -1, 1);
  ASSERT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_NEAR(hand.watch.measures().approach_time, 0.101, 1e-9);
}

TEST(TrialWatch, AMenuOnTheWayIsNoError) {
  interaction::Element element = two_items();
  element.widgets.push_back(item_named("more"));
  element.widgets[2].widgets = {element.widgets[0], item_named("green")};
  element.widgets.erase(element.widgets.begin());
  MenuHand hand(menu_goal(Choosing::Click, element));
  for (const char* const name : {"more", "red"}) {
    hand.at(hand.before(name, 0.01), 5);
    hand.at(hand.before(name, 0.01), 2, -1, 1);
    if (hand.watch.state() == TrialWatch::State::Running) hand.at(hand.before("more", 0.01), 2);
  }
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Over);
  EXPECT_EQ(hand.errors(), 0);
}

TEST(TrialWatch, WhatIsTouchedOfAnElementCanBeTheTask) {
  MenuHand hand(menu_goal(Choosing::Touch));
  hand.at(hand.before("blue", 0.01), 5);
  hand.at(hand.before("blue", -0.001), 5);
  EXPECT_EQ(hand.errors(), 1);
  hand.at(hand.before("red", 0.01), 5);
  hand.at(hand.before("red", -0.001), 1);
  EXPECT_EQ(hand.watch.state(), TrialWatch::State::Over);
}

}  // namespace
}  // namespace icome::study
