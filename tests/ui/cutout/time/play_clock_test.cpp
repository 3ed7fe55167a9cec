#include "ui/cutout/time/play_clock.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::ui {
namespace {

TEST(PlayClock, EveryFrameIsDueForItsTimeAtEachRate) {
  for (const double rate : {12.0, 24.0, 25.0, 30.0}) {
    const PlayPlan plan{.rate = rate, .last = 999};
    for (int frame = 0; frame < 1000; ++frame) {
      EXPECT_EQ(moment_at(plan, frame / rate).frame, frame) << rate;
      EXPECT_EQ(moment_at(plan, (frame + 0.99) / rate).frame, frame) << rate;
    }
    EXPECT_TRUE(moment_at(plan, 1000.0 / rate).ended);
    EXPECT_EQ(moment_at(plan, 1000.0 / rate).frame, 999);
  }
}

TEST(PlayClock, ALoopGoesOnFromItsFirstFrame) {
  const PlayPlan plan{.rate = 25, .first = 0, .last = 9, .from = 4, .again = true};
  for (int step = 0; step < 200; ++step) {
    const PlayMoment moment = moment_at(plan, (step + 0.5) / plan.rate);
    EXPECT_EQ(moment.frame, (4 + step) % 10);
    EXPECT_FALSE(moment.ended);
  }
  EXPECT_NEAR(film_time(plan, 0.24), 0.0, 1e-9);
  EXPECT_NEAR(film_time(plan, 0.24 + 0.4 + 0.1), 0.1, 1e-9);
}

TEST(PlayClock, BeatsAreCountedDownBeforeTheFirstFrame) {
  const PlayPlan plan{.rate = 25, .last = 99, .from = 7, .count_in = 4, .beat = 0.5};
  EXPECT_EQ(count_in_seconds(plan), 2.0);
  EXPECT_EQ(moment_at(plan, -2.0).beats, 4);
  EXPECT_EQ(moment_at(plan, -1.49).beats, 3);
  EXPECT_EQ(moment_at(plan, -0.01).beats, 1);
  EXPECT_EQ(moment_at(plan, -0.01).frame, 7);
  EXPECT_EQ(moment_at(plan, 0.0).beats, 0);
  EXPECT_EQ(moment_at(plan, 0.0).frame, 7);
}

}  // namespace
}  // namespace icome::ui
