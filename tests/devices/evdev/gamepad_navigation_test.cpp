#include "devices/evdev/gamepad_navigation.h"

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>

#include <functional>

#include "devices/driver_suite.h"
#include "devices/fakes/fake_evdev.h"

namespace icome::devices {
namespace {

using fakes::FakeInput;
using fakes::FakeInputs;
using suite::holds_soon;

/// A gamepad that moves a user.
struct Traveller {
  Traveller() : pad(inputs->add(fakes::gamepad_abilities())) {
    auto made = GamepadNavigation::create(inputs, "", {.dead = 0.2}, {.retry = 0.01});
    EXPECT_TRUE(made);
    device = std::move(*made);
  }
  bool reads_soon(const std::function<bool()>& condition) {
    return holds_soon([&] { return device->read(state) == DeviceStatus::Ok && condition(); });
  }
  std::shared_ptr<FakeInputs> inputs = std::make_shared<FakeInputs>();
  FakeInput& pad;
  std::unique_ptr<GamepadNavigation> device;
  NavigationState state;
};

TEST(GamepadNavigation, PushesAndTurnsInTheFrameOfDevices) {
  Traveller traveller;
  EXPECT_EQ(traveller.device->name(), "Fake Pad");
  EXPECT_EQ(traveller.device->read(traveller.state), DeviceStatus::Ok);
  EXPECT_TRUE(traveller.state.push.isZero(0.0) && traveller.state.turn.isZero(0.0));
  traveller.pad.axis(ABS_X, 1000);
  traveller.pad.report();
  EXPECT_TRUE(traveller.reads_soon([&] { return traveller.state.push.isApprox(Vector3(1, 0, 0), 1e-12); }));
  traveller.pad.axis(ABS_X, 0);
  traveller.pad.axis(ABS_Y, -600);  // forward, half
  traveller.pad.axis(ABS_RZ, 255);  // right trigger: up
  traveller.pad.report();
  EXPECT_TRUE(
      traveller.reads_soon([&] { return traveller.state.push.isApprox(Vector3(0, 1, -0.5), 1e-12); }));
  traveller.pad.axis(ABS_RX, 1000);  // to the right: clockwise from above
  traveller.pad.report();
  EXPECT_TRUE(traveller.reads_soon([&] { return traveller.state.turn.isApprox(Vector3(0, -1, 0), 1e-12); }));
  traveller.pad.axis(ABS_RX, 0);
  traveller.pad.axis(ABS_RY, -1000);  // forward: one bows
  traveller.pad.key(BTN_EAST, true);
  traveller.pad.report();
  EXPECT_TRUE(traveller.reads_soon([&] {
    return traveller.state.turn.isApprox(Vector3(-1, 0, 0), 1e-12) && traveller.state.buttons == 0b10U;
  }));
}

TEST(GamepadNavigation, IsLostWhileItIsUnplugged) {
  Traveller traveller;
  traveller.pad.axis(ABS_X, 1000);
  traveller.pad.report();
  ASSERT_TRUE(traveller.reads_soon([&] { return traveller.state.push.x() == 1.0; }));
  traveller.pad.plug(false);
  EXPECT_TRUE(holds_soon([&] { return traveller.device->read(traveller.state) == DeviceStatus::Lost; }));
  EXPECT_EQ(traveller.state.push.x(), 1.0) << "unchanged unless Ok";
  traveller.pad.plug(true);
  EXPECT_TRUE(traveller.reads_soon([&] { return traveller.state.push.isZero(0.0); }));
}

TEST(GamepadNavigation, IsNotAPointerAtTheSameTime) {
  Traveller traveller;
  const auto again = GamepadNavigation::create(traveller.inputs);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("in use by this program already"), std::string::npos);
}

}  // namespace
}  // namespace icome::devices
