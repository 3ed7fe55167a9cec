#include "devices/evdev/tablet.h"

#include <linux/input-event-codes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/decompositions.h"
#include "devices/evdev/named_numbers.h"

namespace icome::devices {
namespace {

constexpr double kSmallestTablet = 0.01;  // m, workspace radius of one that tells nonsense
constexpr double kLargestTablet = 1.0;    // m
constexpr double kSteepestTilt = 1.4;     // rad
// Pens, and tools that are used like pens; fingers, lenses and mice on a tablet are none.
constexpr std::array kPenTools = {BTN_TOOL_PEN, BTN_TOOL_RUBBER, BTN_TOOL_BRUSH, BTN_TOOL_PENCIL,
                                  BTN_TOOL_AIRBRUSH};

double span_of(const InputAxis& axis) { return double(axis.most) - double(axis.least); }
double middle_of(const InputAxis& axis) { return 0.5 * (double(axis.least) + double(axis.most)); }

/// Metres a count, of an axis of lengths.
double metres_per_count(const InputAxis& axis, double instead) {
  return axis.resolution > 0 ? 1e-3 / axis.resolution : instead;
}

/// A tilt in radians; `end`: at the end of the range of an axis that does not tell its unit.
double tilt_of(const std::optional<InputAxis>& axis, std::int32_t value, double end) {
  if (!axis || span_of(*axis) <= 0.0) return 0.0;
  const bool about_zero = axis->least < 0 && axis->most > 0;
  const bool has_unit = axis->resolution > 0;
  const double from_upright = value - (has_unit && about_zero ? 0.0 : middle_of(*axis));
  const double tilt =
      has_unit ? from_upright / axis->resolution : end * from_upright / (0.5 * span_of(*axis));
  return std::clamp(tilt, -kSteepestTilt, kSteepestTilt);
}

}  // namespace

DeviceInfo Tablet::begin(const InputAbilities& abilities) {
  abilities_ = abilities;
  state_ = abilities.state;
  pointer_ = {};
  touch_distance_ = 0.0;
  const InputAxis x = abilities.axes[ABS_X].value_or(InputAxis{});
  const InputAxis y = abilities.axes[ABS_Y].value_or(InputAxis{});
  // A tablet that tells the resolution of one axis has the same on the other.
  const double along_x = metres_per_count(x, metres_per_count(y, 1.0 / settings_.resolution));
  metres_per_count_ = {along_x, metres_per_count(y, along_x), 0.0};
  if (const auto& distance = abilities.axes[ABS_DISTANCE])
    metres_per_count_.z() = metres_per_count(*distance, settings_.hover / std::max(1.0, span_of(*distance)));
  const double radius =
      0.5 * std::hypot(span_of(x) * metres_per_count_.x(), span_of(y) * metres_per_count_.y());
  pointer_.parked = true;
  frame(0);
  DeviceInfo info;
  info.workspace_radius = std::clamp(radius, kSmallestTablet, kLargestTablet);
  info.max_force = info.continuous_force = 0.0;
  return info;
}

void Tablet::frame(std::int64_t time) {
  const bool was_parked = pointer_.parked;
  pointer_.parked = !pen_is_near();
  pointer_.buttons = buttons();
  if (pointer_.parked) return;
  pointer_.position = place();
  pointer_.orientation = orientation();
  if (was_parked || jumped_) {
    jumped_ = true;
    velocity_.restart(pointer_.position);
  }
  velocity_.step(pointer_.position, time);
}

void Tablet::pass(DriverLink& link, std::int64_t now) {
  pointer_.velocity = pointer_.parked ? Vector3::Zero() : velocity_.at(now);
  pointer_.jumped = jumped_;
  jumped_ = false;
  link.pass(pointer_, now);
}

bool Tablet::pen_is_near() const {
  const auto is_in = [](const auto& keys) {
    return std::ranges::any_of(kPenTools, [&](int tool) { return keys[std::size_t(tool)]; });
  };
  return !is_in(abilities_.keys) || is_in(state_.keys);
}

bool Tablet::touches() const {
  return abilities_.keys[BTN_TOUCH] ? state_.keys[BTN_TOUCH] : share(ABS_PRESSURE) > 0.0;
}

/// The place of an axis in its range, 0 to 1; 0 without one.
double Tablet::share(std::size_t axis) const {
  const auto& range = abilities_.axes[axis];
  if (!range || span_of(*range) <= 0.0) return 0.0;
  return std::clamp((double(state_.axes[axis]) - range->least) / span_of(*range), 0.0, 1.0);
}

/// Height of the tip above the tablet, m. Pens are some way off by their tablet's distance when they touch:
/// there the height begins.
double Tablet::height() {
  const bool tells_distance = abilities_.axes[ABS_DISTANCE].has_value();
  if (touches()) {
    touch_distance_ = state_.axes[ABS_DISTANCE];
    return -settings_.depth * (abilities_.axes[ABS_PRESSURE] ? share(ABS_PRESSURE) : 1.0);
  }
  if (!tells_distance) return settings_.lift;
  return std::max(0.0, metres_per_count_.z() * (state_.axes[ABS_DISTANCE] - touch_distance_));
}

/// Place of the tip, m, device frame.
Vector3 Tablet::place() {
  const auto from_middle = [this](std::size_t axis) {
    return state_.axes[axis] - middle_of(abilities_.axes[axis].value_or(InputAxis{}));
  };
  const double right = metres_per_count_.x() * from_middle(ABS_X);
  const double far = -metres_per_count_.y() * from_middle(ABS_Y);
  const double up = height();
  return settings_.lies_as_on_desk ? Vector3(right, up, -far) : Vector3(right, far, up);
}

Quaternion Tablet::orientation() const {
  const double right = tilt_of(abilities_.axes[ABS_TILT_X], state_.axes[ABS_TILT_X], settings_.tilt);
  const double near = tilt_of(abilities_.axes[ABS_TILT_Y], state_.axes[ABS_TILT_Y], settings_.tilt);
  const Vector3 to_top(std::tan(right), -std::tan(near), 1.0);
  const Quaternion tilted = base::rotation_between(Vector3::UnitZ(), to_top);
  if (!settings_.lies_as_on_desk) return tilted;
  // A quarter turn about x lays the screen's plane down, top edge away.
  const double half = std::numbers::sqrt2 / 2.0;
  return Quaternion(half, -half, 0.0, 0.0) * tilted;
}

std::uint32_t Tablet::buttons() const {
  const auto bit = [](bool down, unsigned number) { return down ? 1U << number : 0U; };
  return bit(touches(), 0) | bit(state_.keys[BTN_STYLUS], 1) | bit(state_.keys[BTN_STYLUS2], 2) |
         bit(state_.keys[BTN_TOOL_RUBBER], 3);
}

base::Result<TabletSettings> tablet_settings_from_environment() {
  TabletSettings settings;
  double desk = 0.0;
  const std::array numbers = {
      NamedNumber{"depth", &settings.depth, 0.0, 0.1},
      NamedNumber{"resolution", &settings.resolution, 1e3, 1e7},
      NamedNumber{"hover", &settings.hover, 0.0, 0.1},
      NamedNumber{"lift", &settings.lift, 0.0, 0.1},
      NamedNumber{"tilt", &settings.tilt, 0.0, kSteepestTilt},
      NamedNumber{"desk", &desk, 0.0, 1.0},
  };
  const auto set = set_numbers_from_environment("ICOME_TABLET", numbers);
  if (!set) return tl::unexpected(set.error());
  settings.lies_as_on_desk = desk >= 0.5;
  return settings;
}

}  // namespace icome::devices
