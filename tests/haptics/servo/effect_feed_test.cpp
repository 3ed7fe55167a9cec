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
#include <vector>

#include "base/random.h"
#include "devices/simulated/simulated_device.h"
#include "haptics/effects/effect_text.h"
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
  feed.follow(1e-3);
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
double largest_step(const std::string& effect, bool moved, bool mirrored) {
  EffectFeed feed;
  EffectInput input;
  double largest = 0.0;
  Vector3 last = Vector3::Zero();
  for (int tick = 0; tick < 400; ++tick) {
    const bool elsewhere = moved && tick >= 200;
    const std::string text = effect + (elsewhere ? "" : " ");  // the same, written otherwise
    feed.publish({{1, text, elsewhere ? turned_at({0.03, -0.02, 0.01}) : Pose::Identity(), {}, mirrored}});
    feed.follow(1e-3);
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
    for (const bool mirrored : {false, true}) {
      const double unmoved = largest_step(effect, false, mirrored);
      EXPECT_NEAR(largest_step(effect, true, mirrored), unmoved, 1e-9) << effect << " " << mirrored;
      EXPECT_GT(unmoved, 1e-4) << effect;
    }
  }
}

// A drag as main does it: an edit every 16 ticks.
constexpr int kTicksAnEdit = 16;

Pose dragged_to(int tick) {
  const double t = 0.001 * (tick / kTicksAnEdit) * kTicksAnEdit;
  return Pose(Eigen::Translation3d(0.01 * std::sin(6.0 * t), 0.004 * std::sin(15.0 * t), 0.0));
}

/// Where what is dragged is felt: evenly on the way to where it was put last, 20 ms from there.
class Glide {
 public:
  Vector3 at(int tick) {
    const Vector3 put = dragged_to(tick).translation();
    if (put != put_) left_ = 20;
    put_ = put;
    at_ += (put_ - at_) / std::max(left_, 1);
    left_ = std::max(0, left_ - 1);
    return at_;
  }

 private:
  Vector3 at_ = dragged_to(0).translation(), put_ = at_;
  int left_ = 0;
};

TEST(EffectFeed, ADraggedSpringFollowsWithoutSteps) {
  EffectFeed feed;
  Glide glide;
  double last = 0.0, fastest = 0.0;
  for (int tick = 0; tick < 2000; ++tick) {
    if (tick % kTicksAnEdit == 0) feed.publish({{1, "point:0,0,0,100,0", dragged_to(tick)}});
    const Vector3 force = felt_at(feed, Vector3::Zero());
    EXPECT_NEAR((force - 100.0 * glide.at(tick)).norm(), 0.0, 1e-9) << tick;
    if (tick > 0) fastest = std::max(fastest, std::abs(force.x() - last));
    last = force.x();
  }
  // 60 mm/s at most: 6 mN a tick, where edits felt at once step by 96 mN.
  EXPECT_LT(fastest, 0.012);
  EXPECT_GT(fastest, 0.004);
}

/// Energy (J) of a tip in an effect whose middle is `offset` (m) from it.
using DraggedEnergy = double (*)(const Vector3& offset);

double dragged_spring_energy(const Vector3& offset) { return 50.0 * offset.squaredNorm(); }

double dragged_well_energy(const Vector3& offset) {
  const double radius = 0.02, stiffness = 1.5 * 25.0 * std::sqrt(5.0) / (16.0 * radius);
  const double s = offset.squaredNorm() / (radius * radius);
  return s < 1.0 ? -stiffness * radius * radius / 6.0 * std::pow(1.0 - s, 3) : 0.0;
}

// What the hand and who drags give, less what is stored, is never negative. The dragger's part is what the
// energy of the tip grows by where the effect alone moves.
void expect_passive_drag(const std::string& effect, DraggedEnergy stored) {
  for (const double mass : {0.05, 0.2}) {
    devices::SimulatedSettings settings;
    settings.info.effective_mass = mass;
    settings.hand = {.mass = 0.0, .stiffness = 100.0, .damping = 0.0};
    settings.trajectory = [](double t) { return Vector3(0.006 * std::sin(11.0 * t), 0.0, 0.002); };
    devices::SimulatedDevice device(settings);
    EffectFeed feed({.nominal_stiffness = 2000.0, .effective_mass = mass, .dt = 1e-3});
    Glide glide;
    EffectInput input;
    input.device_mass = mass;
    devices::PointerState state;
    Vector3 tip = device.true_position(), held = Vector3::Zero(), middle = glide.at(0);
    const double first = stored(tip - middle);
    double given = 0.0, least = 0.0, strongest = 0.0;
    for (int tick = 1; tick < 6000; ++tick) {
      device.read(state);
      given -= held.dot(device.true_position() - tip);
      tip = device.true_position();
      if (tick == 1 || tick % kTicksAnEdit == 0) feed.publish({{1, effect, dragged_to(tick)}});
      feed.follow(1e-3);
      const Vector3 next = glide.at(tick);
      given += stored(tip - next) - stored(tip - middle);
      middle = next;
      input.position = input.scp = state.position;
      input.velocity = state.velocity;
      held = feed.force(input, 0.0);
      device.write(held);
      least = std::min(least, given - (stored(tip - middle) - first));
      strongest = std::max(strongest, held.norm());
    }
    EXPECT_GE(least, -1e-6) << effect << " " << mass;
    EXPECT_GT(strongest, 0.3) << effect;
  }
}

TEST(EffectFeed, ADraggedSpringGivesNoMoreThanItsDragger) {
  expect_passive_drag("point:0,0,0,100", dragged_spring_energy);
}

TEST(EffectFeed, ADraggedWellGivesNoMoreThanItsDragger) {
  expect_passive_drag("well:0,0,0,0.02,1.5", dragged_well_energy);
}

PlacedEffect on_a_belt(const std::string& text) {
  PlacedEffect effect{1, text};
  effect.motion.linear = {0.1, 0.0, 0.0};
  return effect;
}

/// With the tip at rest, `ticks` after they were published.
Vector3 felt_on_a_belt(const std::string& text, int ticks) {
  EffectFeed feed;
  feed.publish({on_a_belt(text)});
  Vector3 force;
  for (int tick = 0; tick <= ticks; ++tick) force = felt_at(feed, Vector3::Zero());
  return force;
}

TEST(EffectFeed, AMotionCarriesWhatItsEffectHoldsAndRemembers) {
  // 10 mm away after 0.1 s, and there it stays.
  EXPECT_NEAR(felt_on_a_belt("point:0,0,0,100,0", 50).x(), 0.5 + 0.2 * 0.1, 1e-9) << "2 K dt of damping";
  EXPECT_NEAR(felt_on_a_belt("point:0,0,0,100,0", 99).x(), 0.99 + 0.2 * 0.1, 1e-9);
  EXPECT_NEAR(felt_on_a_belt("point:0,0,0,100,0", 200).x(), 1.0, 1e-9);
  EXPECT_NEAR(felt_on_a_belt("viscous:2", 50).x(), 0.2, 1e-9) << "syrup that flows";
  EXPECT_NEAR(felt_on_a_belt("viscous:2", 200).x(), 0.0, 1e-12);
  EXPECT_NEAR(felt_on_a_belt("friction:0.5,0.4", 50).x(), 0.4, 1e-9) << "a conveyor belt";
  EXPECT_NEAR(felt_on_a_belt("inertia:1", 50).norm(), 0.0, 1e-12) << "the hand's own";
}

TEST(EffectFeed, AMotionThatIsSaidAnewGoesOnWithoutAKick) {
  for (const char* const text : {"point:0,0,0,100,0", "friction:0.5,0.4", "viscous:2", "well:0,0,0,0.02,1"}) {
    EffectFeed feed, once;
    once.publish({on_a_belt(text)});
    for (int tick = 0; tick < 95; ++tick) {
      PlacedEffect effect = on_a_belt(text);
      effect.world_from_effect.translation().x() = 1e-4 * tick;
      if (tick % 10 == 0) feed.publish({effect});
      EXPECT_NEAR((felt_at(feed, Vector3::Zero()) - felt_at(once, Vector3::Zero())).norm(), 0.0, 1e-9)
          << text << " " << tick;
    }
  }
}

TEST(EffectFeed, TakesThousandsOfChangesWhileItIsFelt) {
  EffectFeed feed;
  for (int i = 0; i < 5000; ++i) {
    const double x = 0.001 * (i % 7);
    feed.publish({{1, "constant:0.1,0,0"}, {2, "point:" + std::to_string(x) + ",0,0"}});
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

constexpr int kSlideEdit = 300;  // the tick of the edit
constexpr int kSlideTicks = 700;

/// The forces on a tip that stays where it is, with a velocity that grows by 1 m/s a second, in an effect
/// whose text is changed once.
std::vector<Vector3> slide_forces(const std::string& before, const std::string& after) {
  ScriptedDevice device;
  device.position = {0.009, 0.002, 0.062};
  ServoSettings settings;
  settings.limiter.ramp_seconds = 0.0;
  Servo servo(device, settings);
  servo.publish_effects({{1, before}});
  std::vector<Vector3> forces;
  for (int tick = 0; tick < kSlideTicks; ++tick) {
    if (tick == kSlideEdit) servo.publish_effects({{1, after}});
    device.velocity.x() = 1e-3 * tick;
    servo.tick(1e-3);
    forces.push_back(device.force);
  }
  return forces;
}

/// How much the force changes in all, after it has been seen to go there evenly.
double expect_no_kick(const std::string& before, const std::string& after) {
  const std::vector<Vector3> forces = slide_forces(before, after);
  const double all = devices::DeviceInfo().max_force;
  // What eases, and 50 N s/m, the most that is stable here, against what the velocity grows by.
  const double step = all * 1e-3 / EffectFeed::kEaseSeconds + 50.0 * 1e-3 + 1e-9;
  double largest = 0.0;
  for (int tick = kSlideEdit; tick < kSlideTicks; ++tick) {
    const auto now = std::size_t(tick);
    largest = std::max(largest, (forces[now] - forces[now - 1]).norm());
  }
  EXPECT_LE(largest, step) << before << " to " << after;
  EXPECT_NEAR((forces.back() - slide_forces(after, after).back()).norm(), 0.0, 5e-3)
      << before << " to " << after;
  return (forces.back() - forces[std::size_t(kSlideEdit - 1)]).norm();
}

/// Whose number with this place is so much.
std::string with_number(const EffectKind& kind, std::size_t place, double value) {
  std::vector<double> numbers;
  for (const EffectNumber& it : effect_numbers(kind.example)) numbers.push_back(it.value);
  numbers[place] = value;
  return effect_of_numbers(kind.name, numbers);
}

// The limiter alone lets a slider that is thrown to its end bring half of the device's force in one tick.
TEST(EffectFeed, ASliderThatIsThrownFromEndToEndDoesNotKick) {
  for (const EffectKind& kind : effect_kinds()) {
    const std::vector<EffectNumber> numbers = effect_numbers(kind.example);
    double most = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const std::string least = with_number(kind, i, numbers[i].least);
      const std::string largest = with_number(kind, i, numbers[i].most);
      if (!make_effect(least) || !make_effect(largest)) continue;
      most = std::max({most, expect_no_kick(least, largest), expect_no_kick(largest, least)});
    }
    if (!numbers.empty()) {
      EXPECT_GT(most, 0.2) << kind.name << ": nothing was seen of it";
    }
  }
  EXPECT_GT(expect_no_kick("curve:0,0,0.06;0.05,0,0.06;0,0", "curve:0,0,0.06;0.05,0,0.06;1e6,9"), 2.0);
  EXPECT_GT(expect_no_kick("field:-1000,0,0", "field:1000,0,0"), 6.0);
  EXPECT_GT(expect_no_kick("viscous:1000", "constant:3,0,0"), 6.0) << "another kind";
}

// A neighbour that takes half of the device makes a spring half as hard.
TEST(EffectFeed, AnEffectThatHasToShareDoesNotKick) {
  ScriptedDevice device;
  device.position = {1e-4, 0.0, 0.0};
  ServoSettings settings;
  settings.limiter.ramp_seconds = 0.0;
  Servo servo(device, settings);
  const PlacedEffect spring{1, "point:0,0,0,10000,0"};
  servo.publish_effects({spring});
  for (int tick = 0; tick < 20; ++tick) servo.tick(1e-3);
  Vector3 last = device.force;
  EXPECT_NEAR(last.x(), -1.0, 1e-9);
  servo.publish_effects({spring, {2, "viscous:1000"}});
  for (int tick = 0; tick < 100; ++tick, last = device.force) {
    servo.tick(1e-3);
    EXPECT_LE((device.force - last).norm(),
              devices::DeviceInfo().max_force * 1e-3 / EffectFeed::kEaseSeconds + 1e-9);
  }
  EXPECT_NEAR(last.x(), -0.5, 1e-9);
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

// A picker of colours whose hue is turned, again and again, under the tip.
TEST(EffectFeed, TheServoAllocatesAndLocksNothingOnAPanelThatChanges) {
  ScriptedDevice device;
  Servo servo(device, {});
  std::atomic<bool> ended = false;
  std::thread main([&] {
    for (int i = 0; i < 2000; ++i) {
      PanelSettings panel;
      PanelTarget ring, triangle, hue;
      ring.shape = PanelTarget::Shape::Ring;
      ring.half = {0.03, 0.03};
      ring.inner = 0.022;
      ring.well = 0.2;
      triangle.shape = PanelTarget::Shape::Triangle;
      triangle.half = {0.02, 0.02};
      ring.recess = triangle.recess = 0.0006;
      hue.centre = 0.026 * Vector2(std::sin(0.01 * i), std::cos(0.01 * i));
      hue.half = {0.004, 0.004};
      hue.well = 0.4;
      panel.targets = {ring, triangle, hue};
      PlacedEffect effect;
      effect.id = 1;
      effect.panel = std::make_shared<const PanelSettings>(std::move(panel));
      servo.publish_effects({effect});
    }
    ended = true;
  });
  realtime::RealtimeGuard guard;
  int ticks = 0;
  for (; !ended || ticks < 100; ++ticks) {
    device.position = {0.026 * std::sin(0.003 * ticks), 0.026 * std::cos(0.002 * ticks), -0.001};
    servo.tick(1e-3);
    ASSERT_TRUE(device.force.allFinite());
  }
  guard.stop();
  main.join();
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer counts for itself";
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0U) << ticks << " ticks";
}

// A menu, its menu and the menu of that: two edges fade over each other beside their gaps.
TEST(EffectFeed, SheetsBesideEachOtherTogetherChangeByNoMoreThanOneMay) {
  EffectFeed feed({.effective_mass = 0.1, .dt = 1e-3, .max_force = 10.0});
  std::vector<PlacedEffect> sheets;
  for (std::size_t i = 0; i < 3; ++i) {
    PanelSettings panel;
    panel.half = {0.02, 0.03};
    panel.edge = 0.004;
    PanelTarget target;
    target.half = {0.018, 0.012};
    target.well = 0.4;
    target.recess = 0.0006;
    panel.targets = {target};
    PlacedEffect effect;
    effect.id = i + 1;
    effect.world_from_effect = Pose(Eigen::Translation3d(0.042 * (double(i) - 1.0), 0.0, 0.0));
    effect.panel = std::make_shared<const PanelSettings>(std::move(panel));
    sheets.push_back(std::move(effect));
  }
  feed.publish(sheets);
  base::Random random(1);
  const auto anywhere = [&] {
    return Vector3(random.uniform(-0.07, 0.07), random.uniform(-0.04, 0.04), random.uniform(-0.015, 0.015));
  };
  EffectInput input;
  input.position = {0.0, 0.0, 0.05};
  Vector3 last = Vector3::Zero();
  double most = 0.0, strongest = 0.0;
  for (int leg = 0; leg < 2000; ++leg) {
    const Vector3 from = input.position, to = anywhere();
    const double speed = random.uniform(0.1, 2.0);
    const int ticks = 1 + int((to - from).norm() / speed * 1000.0);
    for (int i = 1; i <= ticks; ++i) {
      const Vector3 before = input.position;
      input.position = from + double(i) / ticks * (to - from);
      input.velocity = (input.position - before) * 1000.0;
      input.scp = input.position;
      input.time += 1e-3;
      feed.follow(1e-3);
      const Vector3 force = feed.force(input, 0.0);
      most = std::max(most, (force - last).norm());
      strongest = std::max(strongest, force.norm());
      last = force;
    }
  }
  EXPECT_LE(most, Panel::kMostChange * 1e-3 + 1e-9);
  EXPECT_GT(strongest, 2.0);
}

}  // namespace
}  // namespace icome::haptics
