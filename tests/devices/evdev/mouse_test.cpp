#include "devices/evdev/mouse.h"

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>

#include <cstdlib>
#include <limits>

#include "devices/fakes/fake_evdev.h"

namespace icome::devices {
namespace {

/// A mouse with one millimetre a count and a centimetre a notch, and its reader.
struct HandOnMouse {
  explicit HandOnMouse(const InputAbilities& abilities = fakes::mouse_abilities())
      : mouse({.metres_per_count = 0.001, .metres_per_notch = 0.01}), info(mouse.begin(abilities)) {}
  void say(int type, int code, std::int32_t value) {
    mouse.take({now, std::uint16_t(type), std::uint16_t(code), value});
  }
  Vector3 report() {
    mouse.frame(now += 8'000'000);
    return mouse.pointer().position;
  }
  Mouse mouse;
  DeviceInfo info;
  std::int64_t now = 1'000'000'000;  // ns
};

TEST(Mouse, MovesTheTip) {
  HandOnMouse hand;
  EXPECT_EQ(hand.info.max_force, 0.0);
  EXPECT_EQ(hand.info.workspace_radius, 0.1);
  hand.say(EV_REL, REL_X, 20);
  hand.say(EV_REL, REL_Y, -30);  // away from the user
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.02, 0.03, 0.0), 1e-12));
  hand.say(EV_REL, REL_X, -20);
  hand.say(EV_REL, REL_WHEEL, 2);  // turned away
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.0, 0.03, -0.02), 1e-12));
  hand.say(EV_REL, REL_HWHEEL, 2);
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.0, 0.03, -0.02), 1e-12));
}

TEST(Mouse, AFineWheelCountsOnce) {
  InputAbilities abilities = fakes::mouse_abilities();
  abilities.relative[REL_WHEEL_HI_RES] = true;
  HandOnMouse hand(abilities);
  hand.say(EV_REL, REL_WHEEL, 1);
  hand.say(EV_REL, REL_WHEEL_HI_RES, 120);
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.0, 0.0, -0.01), 1e-12));
  hand.say(EV_REL, REL_WHEEL_HI_RES, -30);
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.0, 0.0, -0.0075), 1e-12));
}

TEST(Mouse, StaysInItsSphereAndComesBackAtOnce) {
  HandOnMouse hand;
  hand.say(EV_REL, REL_X, std::numeric_limits<std::int32_t>::max());
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.1, 0.0, 0.0), 1e-12));
  hand.say(EV_REL, REL_X, -10);
  EXPECT_TRUE(hand.report().isApprox(Vector3(0.09, 0.0, 0.0), 1e-12));
  for (int i = 0; i < 100; ++i) hand.say(EV_REL, REL_Y, std::numeric_limits<std::int32_t>::min());
  EXPECT_NEAR(hand.report().norm(), 0.1, 1e-9);
}

TEST(Mouse, Buttons) {
  HandOnMouse hand;
  const std::array codes = {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, BTN_SIDE, BTN_EXTRA};
  for (std::size_t i = 0; i < codes.size(); ++i) {
    hand.say(EV_KEY, codes[i], 1);
    hand.report();
    EXPECT_EQ(hand.mouse.pointer().buttons, 1U << i);
    hand.say(EV_KEY, codes[i], 0);
  }
  hand.report();
  EXPECT_EQ(hand.mouse.pointer().buttons, 0U);
}

TEST(Mouse, SettingsOfTheEnvironment) {
  setenv("ICOME_MOUSE", "count=0.0000254 notch=0.001 radius=0.2", 1);
  const auto settings = mouse_settings_from_environment();
  unsetenv("ICOME_MOUSE");
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->metres_per_count, 0.0000254);
  EXPECT_EQ(settings->metres_per_notch, 0.001);
  EXPECT_EQ(settings->radius, 0.2);
}

}  // namespace
}  // namespace icome::devices
