#include "devices/evdev/gamepad.h"

#include <linux/input-event-codes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "devices/evdev/named_numbers.h"
#include "devices/evdev/workspace_sphere.h"

namespace icome::devices {
namespace {

constexpr double kLargestDead = 0.5;   // share of a stick's way, whatever the device says
constexpr double kLongestPass = 0.05;  // s: a thread that stood still longer does not make the tip leap
constexpr std::array kPadButtons = {BTN_SOUTH, BTN_EAST,   BTN_WEST,  BTN_NORTH,  BTN_TL,
                                    BTN_TR,    BTN_TL2,    BTN_TR2,   BTN_SELECT, BTN_START,
                                    BTN_MODE,  BTN_THUMBL, BTN_THUMBR};
constexpr std::size_t kJoystickButtons = 16;  // from BTN_TRIGGER on

/// A deflection's part beyond the dead zone, 0 to 1.
double beyond_dead(double deflection, double dead) {
  return std::clamp((deflection - dead) / (1.0 - dead), 0.0, 1.0);
}

}  // namespace

void Gamepad::begin(const InputAbilities& abilities) {
  abilities_ = abilities;
  state_ = abilities.state;
}

GamepadSticks Gamepad::sticks() const {
  GamepadSticks result;
  result.left = stick(ABS_X, ABS_Y);
  result.right = right_stick_is_r() ? stick(ABS_RX, ABS_RY) : stick(ABS_Z, ABS_RZ);
  result.left_trigger = right_stick_is_r() ? trigger(ABS_Z) : trigger(ABS_BRAKE);
  result.right_trigger = right_stick_is_r() ? trigger(ABS_RZ) : trigger(ABS_GAS);
  return result;
}

/// Is the right stick rx and ry, by the kernel's rules? For others, and those by Bluetooth, it is z and rz.
bool Gamepad::right_stick_is_r() const {
  return abilities_.axes[ABS_RX].has_value() && abilities_.axes[ABS_RY].has_value();
}

base::Vector2 Gamepad::stick(std::size_t across, std::size_t down) const {
  const base::Vector2 way(deflection(across), -deflection(down));
  const double length = way.norm();
  const double beyond = beyond_dead(length, std::max(dead_of(across), dead_of(down)));
  return beyond > 0.0 ? base::Vector2(way * (beyond / length)) : base::Vector2::Zero();
}

/// Deflection of an axis, -1 to 1; 0 without the axis.
double Gamepad::deflection(std::size_t axis) const {
  const auto& range = abilities_.axes[axis];
  if (!range || range->most <= range->least) return 0.0;
  const double half = 0.5 * (double(range->most) - double(range->least));
  return std::clamp((state_.axes[axis] - double(range->least)) / half - 1.0, -1.0, 1.0);
}

double Gamepad::trigger(std::size_t axis) const {
  if (!abilities_.axes[axis]) return 0.0;
  return beyond_dead(0.5 + 0.5 * deflection(axis), dead_);
}

/// The dead zone of a stick's axis: the device's own where that is larger.
double Gamepad::dead_of(std::size_t axis) const {
  const auto& range = abilities_.axes[axis];
  if (!range || range->most <= range->least) return dead_;
  const double own = 2.0 * range->flat / (double(range->most) - double(range->least));
  return std::max(dead_, std::min(own, kLargestDead));
}

std::uint32_t Gamepad::buttons() const {
  std::uint32_t result = 0;
  if (abilities_.keys[BTN_GAMEPAD]) {
    for (std::size_t i = 0; i < kPadButtons.size(); ++i)
      result |= state_.keys[std::size_t(kPadButtons[i])] ? 1U << i : 0U;
    return result;
  }
  for (std::size_t i = 0; i < kJoystickButtons; ++i) result |= state_.keys[BTN_TRIGGER + i] ? 1U << i : 0U;
  return result;
}

DeviceInfo GamepadPointer::begin(const InputAbilities& abilities) {
  pad_.begin(abilities);
  sticks_ = pad_.sticks();
  pointer_ = {};
  time_ = 0;
  DeviceInfo info;
  info.workspace_radius = settings_.radius;
  info.max_force = info.continuous_force = settings_.full_force;
  return info;
}

void GamepadPointer::pass(DriverLink& link, std::int64_t now) {
  const double seconds = time_ == 0 ? 0.0 : std::clamp(1e-9 * double(now - time_), 0.0, kLongestPass);
  time_ = now;
  const Vector3 before = pointer_.position;
  const Vector3 wanted = settings_.speed * Vector3(sticks_.left.x(), sticks_.left.y(), -sticks_.right.y());
  pointer_.position = within_sphere(before + seconds * wanted, settings_.radius);
  pointer_.velocity = seconds > 0.0 ? Vector3((pointer_.position - before) / seconds) : wanted;
  pointer_.buttons = pad_.buttons();
  link.pass(pointer_, now);
}

base::Result<GamepadSettings> gamepad_settings_from_environment() {
  GamepadSettings settings;
  const std::array numbers = {
      NamedNumber{"dead", &settings.dead, 0.0, 0.9},
      NamedNumber{"speed", &settings.speed, 0.001, 2.0},
      NamedNumber{"radius", &settings.radius, 0.01, 1.0},
      NamedNumber{"force", &settings.full_force, 0.1, 50.0},
  };
  const auto set = set_numbers_from_environment("ICOME_GAMEPAD", numbers);
  if (!set) return tl::unexpected(set.error());
  return settings;
}

}  // namespace icome::devices
