#include "devices/evdev/rumble_pacer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace icome::devices {
namespace {

constexpr std::int64_t kPacerMillisecond = 1'000'000;  // ns

TEST(RumblePacer, TellsChangesAHundredTimesASecondAtMost) {
  RumblePacer pacer;
  base::Random random(1);
  int commands = 0;
  std::int64_t last = -RumblePacer::kShortest;
  for (std::int64_t now = 0; now < 1000 * kPacerMillisecond; now += kPacerMillisecond) {
    if (!pacer.next(random.uniform() < 0.3 ? 0.0 : random.uniform(), now)) continue;
    EXPECT_GE(now - last, RumblePacer::kShortest);
    last = now;
    ++commands;
  }
  EXPECT_LE(commands, 100);
  EXPECT_GE(commands, 90);
}

TEST(RumblePacer, TellsNothingWhileNothingChanges) {
  RumblePacer pacer;
  for (std::int64_t now = 0; now < 1000 * kPacerMillisecond; now += kPacerMillisecond)
    EXPECT_FALSE(pacer.next(0.0, now));
}

TEST(RumblePacer, TellsAStrengthAgainBeforeItEnds) {
  RumblePacer pacer;
  int commands = 0;
  for (std::int64_t now = 0; now < 1000 * kPacerMillisecond; now += kPacerMillisecond)
    commands += pacer.next(0.5, now) ? 1 : 0;
  EXPECT_EQ(commands, 10);
  EXPECT_LT(RumblePacer::kAgain, std::int64_t{RumblePacer::kLasts} * kPacerMillisecond);
}

TEST(RumblePacer, TheEndIsToldHoweverSmallTheStrengthWas) {
  RumblePacer pacer;
  EXPECT_EQ(pacer.next(0.016, 100 * kPacerMillisecond), 0.016);
  EXPECT_EQ(pacer.next(0.0, 110 * kPacerMillisecond), 0.0);
  EXPECT_FALSE(pacer.next(0.0, 300 * kPacerMillisecond));
}

TEST(RumblePacer, NonsenseIsNoRumbleAndTooMuchIsAll) {
  RumblePacer pacer;
  EXPECT_EQ(pacer.next(7.0, 100 * kPacerMillisecond), 1.0);
  EXPECT_EQ(pacer.next(std::nan(""), 200 * kPacerMillisecond), 0.0);
  EXPECT_FALSE(pacer.next(-std::numeric_limits<double>::infinity(), 300 * kPacerMillisecond));
}

}  // namespace
}  // namespace icome::devices
