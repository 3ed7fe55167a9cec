#include "devices/evdev/gamepad.h"

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/random.h"
#include "devices/fakes/fake_evdev.h"
#include "repeats.h"

namespace icome::devices {
namespace {

using base::Vector2;
using fakes::gamepad_abilities;

void say(Gamepad& pad, int type, int code, std::int32_t value) {
  pad.take({0, std::uint16_t(type), std::uint16_t(code), value});
}

Gamepad pad_with(const InputAbilities& abilities) {
  Gamepad pad(0.2);
  pad.begin(abilities);
  return pad;
}

TEST(Gamepad, SticksBeyondTheirDeadZone) {
  Gamepad pad = pad_with(gamepad_abilities());
  EXPECT_TRUE(pad.sticks().left.isZero(0.0));
  say(pad, EV_ABS, ABS_X, 200);
  EXPECT_TRUE(pad.sticks().left.isZero(0.0)) << "trembling is rest";
  say(pad, EV_ABS, ABS_X, 600);
  EXPECT_TRUE(pad.sticks().left.isApprox(Vector2(0.5, 0.0), 1e-12));
  say(pad, EV_ABS, ABS_X, 0);
  say(pad, EV_ABS, ABS_Y, -1000);
  EXPECT_TRUE(pad.sticks().left.isApprox(Vector2(0.0, 1.0), 1e-12)) << "up is up";
  say(pad, EV_ABS, ABS_X, 1000);
  EXPECT_NEAR(pad.sticks().left.norm(), 1.0, 1e-12) << "a corner is no faster";
  say(pad, EV_ABS, ABS_RX, -1000);
  EXPECT_TRUE(pad.sticks().right.isApprox(Vector2(-1.0, 0.0), 1e-12));
}

TEST(Gamepad, TriggersAndOtherLayouts) {
  Gamepad pad = pad_with(gamepad_abilities());
  EXPECT_EQ(pad.sticks().left_trigger, 0.0);
  say(pad, EV_ABS, ABS_Z, 255);
  say(pad, EV_ABS, ABS_RZ, 153);  // 0.6 of its way
  EXPECT_EQ(pad.sticks().left_trigger, 1.0);
  EXPECT_NEAR(pad.sticks().right_trigger, 0.5, 1e-12);

  // Without rx and ry the right stick is z and rz, and the triggers are pedals.
  InputAbilities other = gamepad_abilities();
  other.axes[ABS_RX].reset();
  other.axes[ABS_RY].reset();
  other.axes[ABS_Z] = other.axes[ABS_RZ] = InputAxis{0, 65535, 0, 0};
  other.axes[ABS_BRAKE] = other.axes[ABS_GAS] = InputAxis{0, 1023, 0, 0};
  other.state.axes[ABS_Z] = other.state.axes[ABS_RZ] = 32768;
  Gamepad bluetooth = pad_with(other);
  EXPECT_TRUE(bluetooth.sticks().right.isZero(0.0));
  say(bluetooth, EV_ABS, ABS_RZ, 0);
  say(bluetooth, EV_ABS, ABS_GAS, 1023);
  EXPECT_NEAR(bluetooth.sticks().right.y(), 1.0, 1e-4);
  EXPECT_EQ(bluetooth.sticks().right_trigger, 1.0);
  EXPECT_EQ(bluetooth.sticks().left_trigger, 0.0);
}

TEST(Gamepad, Buttons) {
  Gamepad pad = pad_with(gamepad_abilities());
  say(pad, EV_KEY, BTN_SOUTH, 1);
  say(pad, EV_KEY, BTN_WEST, 1);
  say(pad, EV_KEY, BTN_THUMBR, 1);
  EXPECT_EQ(pad.buttons(), 1U << 0 | 1U << 2 | 1U << 12);

  InputAbilities joystick;
  joystick.keys[BTN_TRIGGER] = true;
  Gamepad stick = pad_with(joystick);
  say(stick, EV_KEY, BTN_TRIGGER + 3, 1);
  EXPECT_EQ(stick.buttons(), 1U << 3);
}

TEST(Gamepad, HostileRangesAndValues) {
  base::Random random(3);
  constexpr std::array<std::int32_t, 6> kEdges = {INT32_MIN, INT32_MAX, -1, 0, 1, 1000};
  const auto edge = [&] { return kEdges[random.index(kEdges.size())]; };
  for (int device = 0; device < repeats(5000); ++device) {
    InputAbilities abilities = gamepad_abilities();
    for (auto& axis : abilities.axes) {
      if (axis) axis = InputAxis{edge(), edge(), edge(), 0};
    }
    Gamepad pad = pad_with(abilities);
    for (const int axis : {ABS_X, ABS_Y, ABS_Z, ABS_RX, ABS_RY, ABS_RZ}) say(pad, EV_ABS, axis, edge());
    const GamepadSticks sticks = pad.sticks();
    // A comparison with something that is not a number fails.
    ASSERT_LE(sticks.left.norm(), 1.0 + 1e-9);
    ASSERT_LE(sticks.right.norm(), 1.0 + 1e-9);
    ASSERT_TRUE(sticks.left_trigger >= 0.0 && sticks.left_trigger <= 1.0);
    ASSERT_TRUE(sticks.right_trigger >= 0.0 && sticks.right_trigger <= 1.0);
  }
}

/// A gamepad as a pointer, its link and a clock of milliseconds.
struct Thumbs {
  Thumbs() : info(pointer.begin(gamepad_abilities())), link(info) { link.connect(info); }
  void push(int axis, std::int32_t value) {
    pointer.take({0, EV_ABS, std::uint16_t(axis), value});
    pointer.frame(now);
  }
  PointerState after(int milliseconds) {
    PointerState state;
    for (int i = 0; i < milliseconds; ++i) {
      pointer.pass(link, now += 1'000'000);
      EXPECT_EQ(link.read(state), DeviceStatus::Ok);
    }
    return state;
  }
  GamepadPointer pointer{{.dead = 0.2, .speed = 0.05, .radius = 0.08, .full_force = 2.0}};
  DeviceInfo info;
  DriverLink link;
  std::int64_t now = 1'000'000'000;  // ns
};

TEST(GamepadPointer, SticksSetTheVelocity) {
  Thumbs thumbs;
  EXPECT_EQ(thumbs.info.max_force, 2.0);
  EXPECT_EQ(thumbs.info.workspace_radius, 0.08);
  EXPECT_TRUE(thumbs.after(10).position.isZero(0.0));
  thumbs.push(ABS_X, 1000);
  PointerState state = thumbs.after(200);
  EXPECT_TRUE(state.velocity.isApprox(Vector3(0.05, 0.0, 0.0), 1e-9));
  EXPECT_TRUE(state.position.isApprox(Vector3(0.01, 0.0, 0.0), 1e-9)) << state.position.transpose();
  thumbs.push(ABS_X, 0);
  thumbs.push(ABS_Y, -1000);
  thumbs.push(ABS_RY, -1000);  // away
  state = thumbs.after(200);
  EXPECT_TRUE(state.position.isApprox(Vector3(0.01, 0.01, -0.01), 1e-9)) << state.position.transpose();
}

TEST(GamepadPointer, StaysInItsSphere) {
  Thumbs thumbs;
  thumbs.push(ABS_X, 1000);
  const PointerState state = thumbs.after(3000);
  EXPECT_TRUE(state.position.isApprox(Vector3(0.08, 0.0, 0.0), 1e-9));
  EXPECT_LT(state.velocity.norm(), 1e-6) << "it stands";
}

TEST(GamepadPointer, AThreadThatStoodStillDoesNotMakeItLeap) {
  Thumbs thumbs;
  thumbs.push(ABS_X, 1000);
  thumbs.after(1);
  thumbs.now += 10'000'000'000;
  EXPECT_LE(thumbs.after(1).position.x(), 0.05 * 0.05 + 1e-9);
}

TEST(GamepadPointer, SettingsOfTheEnvironment) {
  setenv("ICOME_GAMEPAD", "dead=0.3 speed=0.2 force=5", 1);
  const auto settings = gamepad_settings_from_environment();
  unsetenv("ICOME_GAMEPAD");
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->dead, 0.3);
  EXPECT_EQ(settings->speed, 0.2);
  EXPECT_EQ(settings->full_force, 5.0);
}

}  // namespace
}  // namespace icome::devices
