// Forces that share a device: what each gets adds up to no more than the device has, wherever the tip is, and
// together they are as stable as each alone.
#include "haptics/effects/mass_shares.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "base/random.h"
#include "devices/device_profiles.h"
#include "devices/simulated/simulated_device.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"
#include "repeats.h"

namespace icome::haptics {
namespace {

Reach any_reach(base::Random& random) {
  Reach reach;
  reach.centre = random.uniform(0.0, 0.1) * random.direction();
  reach.radius = random.uniform(0.0, 0.05);
  const double kind = random.uniform(0.0, 3.0);
  if (kind > 1.0) reach.axis = kind > 2.0 ? Vector3(Vector3::UnitZ()) : random.direction();
  return reach;
}

bool acts_at(const Reach& reach, const Vector3& place) {
  const Vector3 way = place - reach.centre;
  const double along = way.dot(reach.axis);
  return way.squaredNorm() - along * along <= reach.radius * reach.radius;
}

TEST(Reach, MeetsWhatSharesAPlaceWithIt) {
  const Reach ball{.centre = Vector3(0.05, 0, 0), .radius = 0.02};
  const Reach axis{.centre = Vector3(0, 0, 1), .axis = Vector3::UnitZ(), .radius = 0.01};
  EXPECT_FALSE(meet(ball, axis));
  EXPECT_TRUE(meet({.centre = Vector3(0.029, 0, -5), .radius = 0.02}, axis));
  EXPECT_TRUE(meet(ball, {}));
  EXPECT_TRUE(meet({}, {}));
  const Reach crossing{.centre = Vector3(7, 0.05, 0), .axis = Vector3::UnitX(), .radius = 0.02};
  EXPECT_FALSE(meet(axis, crossing)) << "50 mm between two lines";
  EXPECT_TRUE(meet(axis, {.centre = Vector3(7, 0.03, 0), .axis = Vector3::UnitX(), .radius = 0.02}));
  EXPECT_FALSE(meet(axis, {.centre = Vector3(0.05, 0, 0), .axis = -Vector3::UnitZ(), .radius = 0.02}));
  // A quarter turn about y and a step take the axis from z to x.
  const base::Pose turned = Eigen::Translation3d(0, 0, 0.05) *
                            Eigen::AngleAxisd(0.5 * EIGEN_PI, Vector3::UnitY()) *
                            Eigen::Translation3d(0, 0, -1);
  EXPECT_FALSE(meet(transformed(turned, axis), {.centre = Vector3(3, 0, 0), .radius = 0.03}));
  EXPECT_TRUE(meet(transformed(turned, axis), {.centre = Vector3(3, 0, 0.02), .radius = 0.03}));
}

TEST(MassShares, AddUpToNoMoreThanTheDeviceWhereverTheTipIs) {
  constexpr double kDevice = 0.1, kBeside = 0.03;  // kg
  base::Random random(5);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<MassNeed> needs(20);
    for (MassNeed& need : needs) need = {random.uniform(0.0, 0.05), any_reach(random)};
    const std::vector<double> together = needed_together(needs);
    for (int point = 0; point < 200; ++point) {
      const Vector3 place = random.uniform(0.0, 0.12) * random.direction();
      // Who gets more than it needs uses what it needs.
      const double most = *std::max_element(together.begin(), together.end());
      double used = std::min(kBeside, mass_share(kDevice, kBeside, kBeside + most));
      for (std::size_t i = 0; i < needs.size(); ++i)
        if (acts_at(needs[i].reach, place))
          used += std::min(needs[i].mass, mass_share(kDevice, needs[i].mass, together[i] + kBeside));
      ASSERT_LE(used, kDevice * (1.0 + 1e-12)) << trial;
    }
  }
}

TEST(MassShares, WhoNeverActTogetherTakeNothingFromEachOther) {
  std::vector<MassNeed> wells;
  for (int i = 0; i < 100; ++i) wells.push_back({0.08, {.centre = Vector3(0.05 * i, 0, 0), .radius = 0.02}});
  for (const double together : needed_together(wells)) EXPECT_EQ(mass_share(0.1, 0.08, together), 0.1);
  EXPECT_EQ(mass_share(0.1, 0.0, 5.0), 0.1) << "who needs nothing is not asked to give way";
}

struct Together {
  const char* name;
  std::vector<PlacedEffect> effects;
  bool wall = false;  // the tip is pressed on a box
};

std::vector<PlacedEffect> several(int count, const std::string& text) {
  return std::vector<PlacedEffect>(std::size_t(count), PlacedEffect{.text = text});
}

std::vector<Together> strong_together() {
  const std::string spring = "point:0,0,0.05,8000", syrup = "viscous:50", heavy = "inertia:0.3";
  std::vector<PlacedEffect> all = several(3, spring);
  for (const PlacedEffect& more : several(3, syrup)) all.push_back(more);
  for (const PlacedEffect& more : several(3, heavy)) all.push_back(more);
  for (const PlacedEffect& more : several(3, "well:0,0,0.051,0.01,20")) all.push_back(more);
  for (const PlacedEffect& more : several(3, "friction:0.5,0.4,5000")) all.push_back(more);
  std::vector<PlacedEffect> masses = several(8, heavy);
  masses.push_back(
      {.text = syrup});  // undamped, so heavy a mass goes to and fro for long on the hand's own spring
  return {{"eight springs", several(8, spring)},
          {"eight dampers", several(8, syrup)},
          {"masses in syrup", masses},
          {"dampers on a wall", several(8, syrup), true},
          {"springs on a wall", several(8, "plane:0,0,0.045,0,0,1,8000"), true},
          {"all on a wall", all, true}};
}

/// The fastest (m/s) that a tip goes which a hand has let settle for a second and a half.
double rattle(const Together& together, const devices::DeviceInfo& device, double rate) {
  devices::SimulatedSettings hand;
  hand.info = device;
  hand.info.max_force = hand.info.continuous_force = 1e4;  // saturated, nothing is a spring
  hand.rate = rate;
  hand.start = Vector3(0, 0, 0.052);
  hand.trajectory = [](double t) { return Vector3(0, 0, t < 0.3 ? 0.052 : 0.048); };
  hand.hand.mass = hand.hand.damping = 0.0;  // nothing but the effects takes energy out
  devices::SimulatedDevice simulated(hand);
  ServoSettings settings;
  settings.rate_hz = rate;
  settings.limiter.ramp_seconds = 0.0;
  settings.limiter.max_rate = 1e9;
  Servo servo(simulated, settings);
  if (together.wall) servo.publish(box_scene());
  servo.publish_effects(together.effects);
  double fastest = 0.0;
  for (int tick = 0; tick < int(2.0 * rate); ++tick) {
    servo.tick(1.0 / rate);
    if (tick > int(1.5 * rate)) fastest = std::max(fastest, simulated.true_velocity().norm());
  }
  return fastest;
}

TEST(MassShares, StrongEffectsTogetherDoNotRattle) {
  for (const Together& together : strong_together()) {
    for (const double rate : {500.0, 1000.0, 4000.0}) {
      for (const char* const name : {"Touch", "omega.x", "PHANToM Premium 3.0"}) {  // 45, 100 and 150 g
        if (kSanitizerShare > 1 && rate > 500.0 && name != std::string("Touch")) continue;
        const devices::DeviceInfo device = devices::find_device_profile(name).value();
        EXPECT_LT(rattle(together, device, rate), 5e-3)
            << together.name << " on " << name << " at " << rate << " Hz";
      }
    }
  }
}

}  // namespace
}  // namespace icome::haptics
