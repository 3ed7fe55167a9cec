#include "devices/evdev/input_driver.h"

#include <gtest/gtest.h>
#include <linux/input-event-codes.h>

#include <functional>

#include "devices/driver_suite.h"
#include "devices/evdev/back_ends.h"
#include "devices/evdev/gamepad.h"
#include "devices/evdev/mouse.h"
#include "devices/evdev/tablet.h"
#include "devices/fakes/fake_evdev.h"

namespace icome::devices {
namespace {

using fakes::FakeInput;
using fakes::FakeInputs;
using suite::holds_soon;

constexpr DrivenSettings kImpatient = {.retry = 0.01};

template <typename Reader, typename Settings>
base::Result<std::unique_ptr<DrivenDevice>> driven_input(std::shared_ptr<FakeInputs> inputs, InputKind kind,
                                                         const std::string& address,
                                                         const Settings& settings) {
  auto reader = std::make_unique<Reader>(settings);
  return DrivenDevice::create(
      std::make_unique<InputDriver>(std::move(inputs), kind, address, std::move(reader)), kImpatient);
}

/// Reads until a condition holds of the newest state.
bool input_reads_soon(PointerDevice& device, const std::function<bool(const PointerState&)>& condition) {
  PointerState state;
  return holds_soon([&] { return device.read(state) == DeviceStatus::Ok && condition(state); });
}

bool input_lost_soon(PointerDevice& device) {
  PointerState state;
  return holds_soon([&] { return device.read(state) == DeviceStatus::Lost; });
}

void put_pen(FakeInput& tablet, int x, int y, int pressure) {
  tablet.key(BTN_TOOL_PEN, true);
  tablet.axis(ABS_X, x);
  tablet.axis(ABS_Y, y);
  tablet.axis(ABS_PRESSURE, pressure);
  tablet.key(BTN_TOUCH, pressure > 0);
  tablet.report();
}

TEST(InputDriver, PassesWhatAPenDoes) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& tablet = inputs->add(fakes::tablet_abilities());
  auto device = open_input_pointer(inputs, InputKind::Tablet, "", kImpatient);
  ASSERT_TRUE(device) << device.error().message;
  EXPECT_EQ((*device)->info().name, "Fake Pen");
  EXPECT_EQ((*device)->info().max_force, 0.0);
  EXPECT_TRUE(input_reads_soon(**device, [](const PointerState& state) { return state.parked; }));
  put_pen(tablet, 40000, 0, 1000);
  EXPECT_TRUE(input_reads_soon(**device, [](const PointerState& state) {
    return !state.parked && state.buttons == 1U && state.position.isApprox(Vector3(0.1, 0.05, -0.0025), 1e-9);
  }));
  EXPECT_TRUE((*device)->condition().empty());
}

TEST(InputDriver, AFrameIsPassedWholeOrNotAtAll) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& tablet = inputs->add(fakes::tablet_abilities());
  auto device = open_input_pointer(inputs, InputKind::Tablet, "", kImpatient);
  ASSERT_TRUE(device);
  put_pen(tablet, 20000, 10000, 1000);
  ASSERT_TRUE(input_reads_soon(**device, [](const PointerState& state) { return state.buttons == 1U; }));
  tablet.axis(ABS_X, 30000);
  for (int i = 0; i < 20; ++i)
    ASSERT_TRUE(
        input_reads_soon(**device, [](const PointerState& state) { return state.position.x() == 0.0; }));
  tablet.report();
  EXPECT_TRUE(
      input_reads_soon(**device, [](const PointerState& state) { return state.position.x() == 0.05; }));
}

TEST(InputDriver, DroppedEventsAreMadeUpFor) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& tablet = inputs->add(fakes::tablet_abilities());
  auto device = open_input_pointer(inputs, InputKind::Tablet, "", kImpatient);
  ASSERT_TRUE(device);
  put_pen(tablet, 20000, 10000, 1000);
  ASSERT_TRUE(input_reads_soon(**device, [](const PointerState& state) { return state.buttons == 1U; }));
  tablet.overflow();
  put_pen(tablet, 22000, 10000, 0);
  tablet.key(BTN_STYLUS, true);
  tablet.report();
  tablet.drained();
  bool jumped = false;
  EXPECT_TRUE(input_reads_soon(**device, [&](const PointerState& state) {
    jumped = jumped || state.jumped;
    return state.buttons == 0b10U && state.position.isApprox(Vector3(0.01, 0.0, 0.0), 1e-9);
  }));
  EXPECT_TRUE(jumped) << "nobody knows the way there";
}

TEST(InputDriver, UnpluggedAndPluggedInAgain) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& tablet = inputs->add(fakes::tablet_abilities());
  auto device = open_input_pointer(inputs, InputKind::Tablet, "Fake Pen", kImpatient);
  ASSERT_TRUE(device);
  put_pen(tablet, 20000, 10000, 1000);
  ASSERT_TRUE(input_reads_soon(**device, [](const PointerState& state) { return state.buttons == 1U; }));
  tablet.plug(false);
  ASSERT_TRUE(input_lost_soon(**device));
  EXPECT_TRUE(holds_soon([&] { return !(*device)->condition().empty(); }));
  EXPECT_EQ((*device)->condition(), "Fake Pen: unplugged or switched off; plug it in again");
  EXPECT_TRUE(holds_soon([&] { return tablet.open_count() == 0; }));
  tablet.plug(true);
  EXPECT_TRUE(input_reads_soon(**device, [](const PointerState& state) {
    return state.parked && state.buttons == 0U;
  })) << "nobody knows what it does now";
  put_pen(tablet, 40000, 10000, 1000);
  EXPECT_TRUE(
      input_reads_soon(**device, [](const PointerState& state) { return state.position.x() == 0.1; }));
}

TEST(InputDriver, AnotherNodeOfTheSameNameIsFoundAgain) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& other = inputs->add(fakes::mouse_abilities("Other"));
  FakeInput& before = inputs->add(fakes::mouse_abilities("Mine"));
  FakeInput& after = inputs->add(fakes::mouse_abilities("Mine"));
  other.plug(false);
  after.plug(false);
  auto device = open_input_pointer(inputs, InputKind::Mouse, "", kImpatient);
  ASSERT_TRUE(device);
  EXPECT_EQ((*device)->info().name, "Mine");
  before.plug(false);
  ASSERT_TRUE(input_lost_soon(**device));
  after.plug(true);
  other.plug(true);
  ASSERT_TRUE(holds_soon([&] { return after.open_count() + other.open_count() == 1; }));
  // Either node may have been seen first, but where both are there the one of its name is opened.
  if (other.open_count() == 1) {
    other.plug(false);
    ASSERT_TRUE(input_lost_soon(**device));
    EXPECT_TRUE(holds_soon([&] { return after.open_count() == 1; }));
  }
}

TEST(InputDriver, TwoOfOneKindAtOnce) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& left = inputs->add(fakes::mouse_abilities());
  FakeInput& right = inputs->add(fakes::mouse_abilities());
  auto one = open_input_pointer(inputs, InputKind::Mouse, "", kImpatient);
  auto two = open_input_pointer(inputs, InputKind::Mouse, "", kImpatient);
  ASSERT_TRUE(one && two);
  left.moved(REL_X, 100);
  left.report();
  right.moved(REL_Y, -200);
  right.key(BTN_LEFT, true);
  right.report();
  EXPECT_TRUE(input_reads_soon(**one, [](const PointerState& state) {
    return state.buttons == 0U && state.position.isApprox(Vector3(0.005, 0.0, 0.0), 1e-9);
  }));
  EXPECT_TRUE(input_reads_soon(**two, [](const PointerState& state) {
    return state.buttons == 1U && state.position.isApprox(Vector3(0.0, 0.01, 0.0), 1e-9);
  }));
  EXPECT_FALSE(open_input_pointer(inputs, InputKind::Mouse, "", kImpatient)) << "there is no third";
}

TEST(InputDriver, RumblesAsStronglyAsItIsPushed) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& pad = inputs->add(fakes::gamepad_abilities());
  auto device =
      driven_input<GamepadPointer>(inputs, InputKind::Gamepad, "", GamepadSettings{.full_force = 2.0});
  ASSERT_TRUE(device);
  const std::int64_t start = base::steady_nanoseconds();
  EXPECT_EQ((*device)->info().max_force, 2.0);
  const auto pushed = [&](double force, double strength) {
    return holds_soon([&] {
      (*device)->write({0.0, force, 0.0});
      return std::abs(pad.rumbling() - strength) < 0.02;
    });
  };
  EXPECT_TRUE(pushed(1.0, 0.5));
  EXPECT_TRUE(pushed(-2.0, 1.0)) << "a rumble has no direction";
  EXPECT_TRUE(pushed(100.0, 1.0));
  // The rumble ends for a servo that pushes no more, also where its thread stands still.
  EXPECT_TRUE(holds_soon([&] { return pad.rumbling() == 0.0; }));
  EXPECT_TRUE(pushed(1.0, 0.5));
  device->reset();
  EXPECT_EQ(pad.rumbling(), 0.0) << "the device was let go";
  const auto commands = pad.commands();
  const double seconds = 1e-9 * double(base::steady_nanoseconds() - start);
  EXPECT_LE(double(commands.size()), 100.0 * seconds + 2.0)
      << "the first and the last beside those that are paced";
  for (const FakeInput::Command& command : commands) {
    EXPECT_LE(command.strength, 1.0);
    EXPECT_LE(command.milliseconds, 300) << "ends by itself";
  }
}

TEST(InputDriver, WithoutRumbleThereIsNoForce) {
  auto inputs = std::make_shared<FakeInputs>();
  InputAbilities abilities = fakes::gamepad_abilities();
  abilities.rumbles = false;
  abilities.rumble_refused = true;
  FakeInput& pad = inputs->add(abilities);
  auto device = open_input_pointer(inputs, InputKind::Gamepad, "", kImpatient);
  ASSERT_TRUE(device);
  EXPECT_EQ((*device)->info().max_force, 0.0);
  EXPECT_TRUE(holds_soon([&] {
    return (*device)->condition().starts_with(
        "Fake Pad: no rumble, as it may not be written to; add yourself");
  })) << (*device)->condition();
  (*device)->write({1.0, 0.0, 0.0});
  EXPECT_TRUE(input_reads_soon(**device, [](const PointerState&) { return true; }));
  EXPECT_TRUE(pad.commands().empty());
}

TEST(InputDriver, ARumbleThatFailsIsToldAndTheRestGoesOn) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& pad = inputs->add(fakes::gamepad_abilities());
  pad.fail_to_rumble(true);
  auto device = open_input_pointer(inputs, InputKind::Gamepad, "", kImpatient);
  ASSERT_TRUE(device);
  EXPECT_TRUE(holds_soon([&] {
    (*device)->write({3.0, 0.0, 0.0});
    return (*device)->condition().starts_with("Fake Pad: no rumble any more");
  })) << (*device)->condition();
  EXPECT_TRUE(input_reads_soon(**device, [](const PointerState&) { return true; }));
}

TEST(InputDriver, AFloodOfEventsDoesNotHoldItUp) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& mouse = inputs->add(fakes::mouse_abilities());
  auto device = open_input_pointer(inputs, InputKind::Mouse, "", kImpatient);
  ASSERT_TRUE(device);
  for (int i = 0; i < 20'000; ++i) {
    mouse.moved(REL_X, i % 2 == 0 ? 1 : -1);
    mouse.report();
  }
  mouse.moved(REL_X, 100);
  mouse.report();
  EXPECT_TRUE(input_reads_soon(
      **device, [](const PointerState& state) { return std::abs(state.position.x() - 0.005) < 1e-9; }));
}

TEST(InputDriver, APenWithoutForceTouchesInAServo) {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& tablet = inputs->add(fakes::tablet_abilities());
  const TabletSettings settings{.depth = 0.02, .lies_as_on_desk = true};
  auto device = driven_input<Tablet>(inputs, InputKind::Tablet, "", settings);
  ASSERT_TRUE(device);
  suite::Rig rig;
  rig.device = std::move(*device);
  suite::Touching touching(rig);
  put_pen(tablet, 20000, 10000, 500);  // 5 mm down
  ASSERT_TRUE(touching.until([](const auto& report) { return report.tip.y() < -0.004; }));
  EXPECT_FALSE(touching.tick().contact.touching);
  put_pen(tablet, 20000, 10000, 1500);  // 15 mm: 5 mm below the floor
  ASSERT_TRUE(touching.until([](const auto& report) { return report.contact.touching; }));
  const haptics::TickReport& report = touching.tick();
  EXPECT_NEAR(report.contact.scp.y(), suite::Touching::kFloor, 1e-6);
  EXPECT_NEAR(report.tip.y(), -0.015, 1e-9);
  EXPECT_TRUE(report.force.isZero(0.0)) << report.force.transpose();
  EXPECT_EQ(touching.fastest(), 0.0);
  tablet.key(BTN_TOOL_PEN, false);
  tablet.report();
  EXPECT_TRUE(touching.until([](const auto& now) { return !now.contact.touching; })) << "laid aside";
}

/// A person at a gamepad, who sees the tip and pushes the sticks towards where it is to go.
class SteeredPad final : public PointerDevice {
 public:
  SteeredPad(std::shared_ptr<FakeInputs> inputs, FakeInput& pad, std::unique_ptr<DrivenDevice> device)
      : inputs_(std::move(inputs)), pad_(pad), device_(std::move(device)) {}

  const DeviceInfo& info() const override { return device_->info(); }
  DeviceStatus read(PointerState& state) override {
    const DeviceStatus status = device_->read(state);
    if (status == DeviceStatus::Ok && steers) steer(state.position);
    return status;
  }
  DeviceStatus write(const Vector3& force) override { return device_->write(force); }
  std::string condition() const override { return device_->condition(); }

  void go_mad() {
    steers = false;
    for (const int axis : {ABS_X, ABS_Y, ABS_RX, ABS_RY, ABS_Z})
      pad_.axis(axis, pad_.commands().size() % 2 == 0 ? INT32_MIN : INT32_MAX);
    pad_.report();
  }

  Vector3 target = Vector3::Zero();
  bool steers = true;

 private:
  void steer(const Vector3& tip) {
    const auto pushed = [](double way) { return std::int32_t(std::clamp(way * 400'000.0, -1000.0, 1000.0)); };
    const Vector3 way = target - tip;
    pad_.axis(ABS_X, pushed(way.x()));
    pad_.axis(ABS_Y, pushed(-way.y()));
    pad_.axis(ABS_RY, pushed(way.z()));
    pad_.report();
  }

  std::shared_ptr<FakeInputs> inputs_;
  FakeInput& pad_;
  std::unique_ptr<DrivenDevice> device_;
};

suite::Rig steered_pad() {
  auto inputs = std::make_shared<FakeInputs>();
  FakeInput& pad = inputs->add(fakes::gamepad_abilities());
  auto device = driven_input<GamepadPointer>(inputs, InputKind::Gamepad, "", GamepadSettings{});
  EXPECT_TRUE(device);
  const double full = (*device)->info().max_force;
  auto steered = std::make_unique<SteeredPad>(inputs, pad, std::move(*device));
  SteeredPad& player = *steered;
  suite::Rig rig;
  rig.device = std::move(steered);
  rig.aim = [&player](const Vector3& target) { player.target = target; };
  rig.strongest = [&pad, full] {
    double strongest = 0.0;
    for (const auto& command : pad.commands()) strongest = std::max(strongest, full * command.strength);
    return strongest;
  };
  rig.held = [&pad, full] { return full * pad.rumbling(); };
  rig.given = [] { return 0.0; };  // a rumble moves nothing
  rig.plug = [&pad](bool in) { pad.plug(in); };
  rig.fail = [&player](fakes::ArmFault fault) {
    player.steers = fault == fakes::ArmFault::None;
    if (fault == fakes::ArmFault::Jump || fault == fakes::ArmFault::Infinite) player.go_mad();
  };
  return rig;
}

TEST(GamepadInAServo, FeelsTheFloor) {
  suite::Rig rig = steered_pad();
  suite::feels_the_floor(rig);
}

TEST(GamepadInAServo, ComesBack) {
  suite::Rig rig = steered_pad();
  suite::comes_back(rig);
}

TEST(GamepadInAServo, IsWatched) {
  suite::Rig rig = steered_pad();
  suite::is_watched(rig);
}

TEST(GamepadInAServo, StandsFaults) {
  suite::Rig rig = steered_pad();
  suite::stands_faults(rig);
}

}  // namespace
}  // namespace icome::devices
