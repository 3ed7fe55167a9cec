#include "devices/evdev/gamepad_navigation.h"

#include <utility>

#include "devices/evdev/input_driver.h"
#include "realtime/latest_value.h"

namespace icome::devices {

/// The newest state, from the thread that reads the gamepad to the one that asks.
struct GamepadNavigation::Box {
  realtime::LatestValue<NavigationState> states;
};

namespace {

using NavigationStates = realtime::LatestValue<NavigationState>;

/// Fills a box, at each frame and at the beginning.
class NavigationReader final : public InputReader {
 public:
  NavigationReader(std::shared_ptr<NavigationStates> states, double dead)
      : states_(std::move(states)), pad_(dead) {}

  DeviceInfo begin(const InputAbilities& abilities) override {
    pad_.begin(abilities);
    publish();
    DeviceInfo info;
    info.max_force = info.continuous_force = 0.0;
    return info;
  }
  void take(const InputEvent& event) override { pad_.take(event); }
  void frame(std::int64_t /*time*/) override { publish(); }
  void pass(DriverLink& /*link*/, std::int64_t /*now*/) override {}

 private:
  void publish() {
    const GamepadSticks sticks = pad_.sticks();
    NavigationState& state = states_->write_slot();
    state.push = {sticks.left.x(), sticks.right_trigger - sticks.left_trigger, -sticks.left.y()};
    state.turn = {-sticks.right.y(), -sticks.right.x(), 0.0};
    state.buttons = pad_.buttons();
    states_->publish();
  }

  std::shared_ptr<NavigationStates> states_;
  Gamepad pad_;
};

}  // namespace

base::Result<std::unique_ptr<GamepadNavigation>> GamepadNavigation::create(
    std::shared_ptr<InputSystem> system, const std::string& address, const GamepadSettings& settings,
    const DrivenSettings& driven) {
  auto box = std::make_shared<Box>();
  std::shared_ptr<NavigationStates> states(box, &box->states);
  auto reader = std::make_unique<NavigationReader>(std::move(states), settings.dead);
  auto device = DrivenDevice::create(
      std::make_unique<InputDriver>(std::move(system), InputKind::Gamepad, address, std::move(reader)),
      driven);
  if (!device) return tl::unexpected(device.error());
  return std::unique_ptr<GamepadNavigation>(new GamepadNavigation(std::move(box), std::move(*device)));
}

GamepadNavigation::GamepadNavigation(std::shared_ptr<Box> box, std::unique_ptr<DrivenDevice> device)
    : box_(std::move(box)), device_(std::move(device)) {}

GamepadNavigation::~GamepadNavigation() = default;

DeviceStatus GamepadNavigation::read(NavigationState& state) {
  PointerState unused;
  if (device_->read(unused) == DeviceStatus::Lost) return DeviceStatus::Lost;
  box_->states.update();
  state = box_->states.read();
  return DeviceStatus::Ok;
}

}  // namespace icome::devices
