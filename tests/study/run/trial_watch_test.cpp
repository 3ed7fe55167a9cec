#include "study/run/trial_watch.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace icome::study
