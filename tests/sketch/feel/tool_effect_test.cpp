#include "sketch/feel/tool_effect.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "base/random.h"

namespace icome::sketch {
namespace {

using base::Vector3;

constexpr double kTick = 0.001;  // s

/// A hand that goes round and to and fro, always smoothly, about a place.
class WanderingHand {
 public:
  explicit WanderingHand(std::uint64_t seed) {
    base::Random random(seed);
    for (Wave& wave : waves_)
      wave = {Vector2(random.uniform(-0.03, 0.03), random.uniform(-0.03, 0.03)), random.uniform(0.5, 12.0),
              random.uniform(0.0, 6.0)};
  }
  Vector2 at(double time) const {
    Vector2 place = Vector2::Zero();
    for (const Wave& wave : waves_) place += std::sin(wave.speed * time + wave.phase) * wave.way;
    return place;
  }

 private:
  struct Wave {
    Vector2 way;
    double speed, phase;  // rad/s, rad
  };
  std::array<Wave, 4> waves_;
};

/// Work (J) of an effect on a hand over some seconds; the force of a tick is held until the next.
double work_on(ToolEffect& effect, const WanderingHand& hand, double seconds) {
  double work = 0.0;
  Vector3 force = Vector3::Zero();
  Vector2 before = hand.at(0.0);
  for (double time = 0.0; time < seconds; time += kTick) {
    const Vector2 now = hand.at(time);
    work += force.head<2>().dot(now - before);
    haptics::EffectInput input;
    input.dt = kTick;
    input.position = Vector3(now.x(), now.y(), -0.002);
    const Vector2 velocity = (now - before) / kTick;
    input.velocity = Vector3(velocity.x(), velocity.y(), 0.0);
    force = effect.force(input);
    EXPECT_TRUE(force.allFinite());
    EXPECT_EQ(force.z(), 0.0);
    before = now;
  }
  return work;
}

// Also across the centre of a turn, where its force has no potential.
TEST(ToolEffect, GivesNoEnergyWhereverAHandGoes) {
  base::Random random(6);
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const WanderingHand hand(seed);
    ToolGrip grip = {.start = hand.at(0.0)};
    if (seed % 2 == 0) grip.holding = double(random.index(4));
    if (seed % 3 != 0) grip.turned = random.uniform(0.01, 0.5);
    if (seed % 4 == 0) grip.scaled = random.uniform(0.01, 0.5);
    grip.centre = Vector2(random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02));
    ToolEffect effect(grip);
    EXPECT_LT(work_on(effect, hand, 20.0), 1e-4) << seed;
  }
}

// Nothing dampens here, and a hand goes to and fro between a small and a large arm: it takes more
// where it goes back than it gave. What it had not given is never paid out.
TEST(ToolEffect, PaysOutNoMoreThanATurnHasTaken) {
  const ToolGrip grip = {.start = {0.05, 0.0}, .turned = 0.2};
  ToolEffect effect(grip);
  double work = 0.0;
  Vector3 force = Vector3::Zero();
  Vector2 before = grip.start;
  const auto go = [&](double arm, double angle) {
    const Vector2 now = arm * Vector2(std::cos(angle), std::sin(angle));
    work += force.head<2>().dot(now - before);
    before = now;
    haptics::EffectInput input;
    input.dt = kTick;
    input.position = Vector3(now.x(), now.y(), 0.0);
    force = effect.force(input);
  };
  for (int round = 0; round < 20; ++round) {
    for (int i = 0; i <= 1000; ++i) go(0.05 - 4.9e-5 * i, 0.0);
    for (int i = 0; i <= 1000; ++i) go(0.001, 1e-3 * i);
    for (int i = 0; i <= 1000; ++i) go(0.001 + 4.9e-5 * i, 1.0);
    for (int i = 0; i <= 1000; ++i) go(0.05, 1.0 - 1e-3 * i);
  }
  EXPECT_LT(work, 1e-4);
}

TEST(ToolEffect, ThatHoldsNothingIsIdle) {
  ToolEffect effect((ToolGrip()));
  EXPECT_TRUE(effect.is_idle_at(Vector3::Zero()));
  EXPECT_EQ(effect.mass_needed(0.1, kTick), 0.0);
  haptics::EffectInput input;
  input.velocity = Vector3(1.0, 0.0, 0.0);
  EXPECT_EQ(effect.force(input), Vector3(0.0, 0.0, 0.0));
}

}  // namespace
}  // namespace icome::sketch
