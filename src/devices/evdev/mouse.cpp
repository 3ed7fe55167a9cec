#include "devices/evdev/mouse.h"

#include <linux/input-event-codes.h>

#include <array>
#include <cstddef>

#include "devices/evdev/named_numbers.h"
#include "devices/evdev/workspace_sphere.h"

namespace icome::devices {
namespace {

constexpr double kPartsOfNotch = 120.0;
constexpr std::array kMouseButtons = {BTN_LEFT, BTN_RIGHT, BTN_MIDDLE, BTN_SIDE, BTN_EXTRA};

}  // namespace

DeviceInfo Mouse::begin(const InputAbilities& abilities) {
  fine_wheel_ = abilities.relative[REL_WHEEL_HI_RES];
  state_ = abilities.state;
  counts_.setZero();
  pointer_ = {};
  velocity_.restart(pointer_.position);
  DeviceInfo info;
  info.workspace_radius = settings_.radius;
  info.max_force = info.continuous_force = 0.0;
  return info;
}

void Mouse::take(const InputEvent& event) {
  state_.take(event);
  if (event.type != EV_REL) return;
  if (event.code == REL_X) counts_.x() += event.value;
  if (event.code == REL_Y) counts_.y() -= event.value;
  if (event.code == REL_WHEEL && !fine_wheel_) counts_.z() += event.value;
  if (event.code == REL_WHEEL_HI_RES && fine_wheel_) counts_.z() += event.value / kPartsOfNotch;
}

void Mouse::frame(std::int64_t time) {
  pointer_.buttons = 0;
  for (std::size_t i = 0; i < kMouseButtons.size(); ++i) {
    if (state_.keys[std::size_t(kMouseButtons[i])]) pointer_.buttons |= 1U << i;
  }
  if (counts_.isZero(0.0)) return;
  const Vector3 moved(settings_.metres_per_count * counts_.x(), settings_.metres_per_count * counts_.y(),
                      -settings_.metres_per_notch * counts_.z());
  counts_.setZero();
  pointer_.position = within_sphere(pointer_.position + moved, settings_.radius);
  velocity_.step(pointer_.position, time);
}

void Mouse::pass(DriverLink& link, std::int64_t now) {
  pointer_.velocity = velocity_.at(now);
  link.pass(pointer_, now);
}

base::Result<MouseSettings> mouse_settings_from_environment() {
  MouseSettings settings;
  const std::array numbers = {
      NamedNumber{"count", &settings.metres_per_count, 1e-7, 0.01},
      NamedNumber{"notch", &settings.metres_per_notch, 0.0, 0.1},
      NamedNumber{"radius", &settings.radius, 0.01, 1.0},
  };
  const auto set = set_numbers_from_environment("ICOME_MOUSE", numbers);
  if (!set) return tl::unexpected(set.error());
  return settings;
}

}  // namespace icome::devices
