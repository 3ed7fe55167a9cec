// Effects of a design in the servo: felt in the next tick, where their objects are, and with what they know.
#include "haptics/servo/effect_feed.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <thread>

#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"
#include "realtime/guard/guard.h"

namespace icome::haptics {
namespace {

Pose turned_at(const Vector3& place) {
  return Eigen::Translation3d(place) * Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitZ());
}

/// What a tick with the tip there feels.
Vector3 felt_at(EffectFeed& feed, const Vector3& position) {
  EffectInput input;
  input.position = input.scp = position;
  feed.follow();
  return feed.force(input, 0.0);
}

TEST(EffectFeed, IsFeltInTheNextTickAndGone) {
  ScriptedDevice device;
  ServoSettings settings;
  settings.limiter.ramp_seconds = 0.0;
  settings.limiter.max_rate = 1e6;
  Servo servo(device, settings);
  servo.tick(1e-3);
  EXPECT_EQ(device.force, Vector3::Zero());
  servo.publish_effects({{1, "constant:0.3,0,0", turned_at(Vector3::Zero())}});
  servo.tick(1e-3);
  EXPECT_NEAR((device.force - Vector3(0, 0.3, 0)).norm(), 0.0, 1e-12) << device.force.transpose();
  servo.publish_effects({});
  servo.tick(1e-3);
  EXPECT_EQ(device.force, Vector3::Zero());
}

TEST(EffectFeed, LiesInTheFrameOfItsObject) {
  EffectFeed feed;
  feed.publish({{1, "point:0.01,0,0,100,0", turned_at({0.1, 0.2, 0.3})}});
  // The object's x is the world's y: the spring holds at (0.1, 0.21, 0.3).
  const Vector3 force = felt_at(feed, {0.1, 0.2, 0.32});
  EXPECT_NEAR((force - Vector3(0, 1.0, -2.0)).norm(), 0.0, 1e-12) << force.transpose();
}

TEST(EffectFeed, TheSameObjectKeepsWhatItsEffectKnows) {
  EffectFeed feed;
  const PlacedEffect rough{7, "friction:0.5,0.4"};
  feed.publish({rough});
  felt_at(feed, Vector3::Zero());  // drops its anchor
  feed.publish({{3, "viscous:1"}, rough});
  EXPECT_NEAR(felt_at(feed, {1e-4, 0, 0}).x(), -0.1, 1e-9) << "1000 N/m from the same anchor";
  feed.publish({{7, "friction:0.6,0.3"}});
  EXPECT_NEAR(felt_at(feed, {2e-4, 0, 0}).x(), -0.2, 1e-9) << "so it does when its numbers are changed";
  feed.publish({{8, "friction:0.6,0.3"}});
  EXPECT_EQ(felt_at(feed, {2e-4, 0, 0}), Vector3::Zero()) << "another object's begins anew";
  feed.reset();
  EXPECT_EQ(felt_at(feed, {9e-4, 0, 0}), Vector3::Zero());
}

// A tip on a curved way, and after half of it the effect's object is elsewhere and turned.
double largest_step(const std::string& effect, bool moved) {
  EffectFeed feed;
  EffectInput input;
  double largest = 0.0;
  Vector3 last = Vector3::Zero();
  for (int tick = 0; tick < 400; ++tick) {
    const bool elsewhere = moved && tick >= 200;
    const std::string text = effect + (elsewhere ? "" : " ");  // the same, written otherwise
    feed.publish({{1, text, elsewhere ? turned_at({0.03, -0.02, 0.01}) : Pose::Identity()}});
    feed.follow();
    const double t = 0.001 * tick;
    input.position = 0.01 * Vector3(std::sin(5.0 * t), std::cos(3.0 * t), t);
    input.velocity = 0.01 * Vector3(5.0 * std::cos(5.0 * t), -3.0 * std::sin(3.0 * t), 1.0);
    const Vector3 force = feed.force(input, 0.0);
    largest = std::max(largest, (force - last).norm());
    last = force;
  }
  return largest;
}

TEST(EffectFeed, AnEffectWithoutAPlaceDoesNotKickWhenItsObjectIsMovedAndTurned) {
  for (const char* const effect : {"friction:0.5,0.4", "inertia:0.5", "viscous:2"}) {
    EXPECT_NEAR(largest_step(effect, true), largest_step(effect, false), 1e-9) << effect;
    EXPECT_GT(largest_step(effect, false), 1e-4) << effect;
  }
}

TEST(EffectFeed, TakesThousandsOfChangesWhileItIsFelt) {
  EffectFeed feed;
  for (int i = 0; i < 5000; ++i) {
    const double x = 0.001 * (i % 7);
    feed.publish({{1, "constant:0.1,0,0"}, {2, "point:0,0,0", Pose(Eigen::Translation3d(x, 0, 0))}});
    if (i % 3 == 0) {
      EXPECT_NEAR(felt_at(feed, Vector3::Zero()).x(), 0.1 + 200.0 * x, 1e-9);
    }
  }
}

TEST(EffectFeed, HoldsFewVersionsWhileTheHandIsLaidAside) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer counts memory itself";
  ScriptedDevice device;
  device.parked = true;
  Servo servo(device, {});
  const auto change = [&](int i) {
    servo.publish_effects({{1, "constant:0.1,0,0"}, {2, "point:0,0,0,200," + std::to_string(1 + i % 5)}});
    servo.tick(1e-3);
  };
  for (int i = 0; i < 10; ++i) change(i);
  const std::size_t before = mallinfo2().uordblks;
  for (int i = 0; i < 20000; ++i) change(i);
  EXPECT_LT(mallinfo2().uordblks, before + 100'000) << "bytes";
}

TEST(EffectFeed, TheNewestIsFeltHoweverManyTheServoMissed) {
  EffectFeed feed;
  for (int i = 1; i <= 1000; ++i) feed.publish({{1, "constant:0,0," + std::to_string(0.001 * i)}});
  EXPECT_NEAR(felt_at(feed, Vector3::Zero()).z(), 1.0, 1e-12);
}

// One thread changes effects, moves them, takes them away; the servo's neither allocates, frees nor locks.
TEST(EffectFeed, TheServoAllocatesAndLocksNothingWhileEffectsChange) {
  ScriptedDevice device;
  Servo servo(device, {});
  std::atomic<bool> ended = false;
  std::thread main([&] {
    for (int i = 0; i < 3000; ++i) {
      std::vector<PlacedEffect> effects = {{1, "friction:0.5,0.4", turned_at({0.001 * (i % 7), 0, 0})},
                                           {2, "field:sin(t),0,x+" + std::to_string(i % 3)}};
      if (i % 2 == 0) effects.push_back({3, "curve:0,0,0;0.1,0,0;0.1,0.1,0"});
      servo.publish_effects(effects);
    }
    ended = true;
  });
  realtime::RealtimeGuard guard;
  int ticks = 0;
  for (; !ended || ticks < 100; ++ticks) {
    device.position.x() = 0.01 * std::sin(0.01 * ticks);
    servo.tick(1e-3);
    ASSERT_TRUE(device.force.allFinite());
  }
  guard.stop();
  main.join();
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer counts for itself";
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0U) << ticks << " ticks";
}

}  // namespace
}  // namespace icome::haptics
