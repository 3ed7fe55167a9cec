// Effects of a design in the servo: felt in the next tick, where their objects are, and with what they know.
#include "haptics/servo/effect_feed.h"

#include <gtest/gtest.h>

#include <numbers>

#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"

namespace icome::haptics {
namespace {

Pose turned_at(const Vector3& place) {
  return Eigen::Translation3d(place) * Eigen::AngleAxisd(0.5 * std::numbers::pi, Vector3::UnitZ());
}

EffectInput tip_of_feed(const Vector3& position) {
  EffectInput input;
  input.position = input.scp = position;
  return input;
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
  const Vector3 force = feed.force(tip_of_feed({0.1, 0.2, 0.32}));
  EXPECT_NEAR((force - Vector3(0, 1.0, -2.0)).norm(), 0.0, 1e-12) << force.transpose();
}

TEST(EffectFeed, TheSameObjectKeepsWhatItsEffectKnows) {
  EffectFeed feed;
  const PlacedEffect rough{7, "friction:0.5,0.4"};
  feed.publish({rough});
  feed.force(tip_of_feed(Vector3::Zero()));  // drops its anchor
  feed.publish({{3, "viscous:1"}, rough});
  EXPECT_NEAR(feed.force(tip_of_feed({1e-4, 0, 0})).x(), -0.1, 1e-9) << "1000 N/m from the same anchor";
  feed.publish({{7, "friction:0.5,0.3"}});
  EXPECT_EQ(feed.force(tip_of_feed({2e-4, 0, 0})), Vector3::Zero()) << "another effect begins anew";
  feed.reset();
  EXPECT_EQ(feed.force(tip_of_feed({9e-4, 0, 0})), Vector3::Zero());
}

TEST(EffectFeed, TakesThousandsOfChangesWhileItIsFelt) {
  EffectFeed feed;
  for (int i = 0; i < 5000; ++i) {
    const double x = 0.001 * (i % 7);
    feed.publish({{1, "constant:0.1,0,0"}, {2, "point:0,0,0", Pose(Eigen::Translation3d(x, 0, 0))}});
    if (i % 3 == 0) {
      EXPECT_NEAR(feed.force(tip_of_feed(Vector3::Zero())).x(), 0.1 + 200.0 * x, 1e-9);
    }
  }
}

}  // namespace
}  // namespace icome::haptics
