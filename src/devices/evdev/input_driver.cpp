#include "devices/evdev/input_driver.h"

#include <fmt/format.h>
#include <linux/input-event-codes.h>

#include <utility>

#include "base/clock.h"

namespace icome::devices {
namespace {

constexpr int kReadingPeriod = 1;       // ms
constexpr int kMostInputEvents = 4096;  // between two readings, so that a flood of events cannot hold them up

}  // namespace

InputDriver::InputDriver(std::shared_ptr<InputSystem> system, InputKind kind, std::string address,
                         std::unique_ptr<InputReader> reader)
    : system_(std::move(system)), kind_(kind), address_(std::move(address)), reader_(std::move(reader)) {}

base::Result<DeviceInfo> InputDriver::open() {
  auto found = find_input(*system_, kind_, address_, name_);
  if (!found) return tl::unexpected(found.error());
  input_ = std::move(*found);
  const InputAbilities& abilities = input_.node->abilities();
  name_ = shown_name(abilities);
  info_ = reader_->begin(abilities);
  info_.name = name_;
  rumbles_ = abilities.rumbles && info_.max_force > 0.0;
  if (!rumbles_) info_.max_force = info_.continuous_force = 0.0;
  pacer_ = {};
  return info_;
}

std::string InputDriver::run(DriverLink& link, const std::atomic<bool>& stop) {
  if (kind_ == InputKind::Gamepad && input_.node->abilities().rumble_refused)
    link.tell(fmt::format("{}: no rumble, as it may not be written to; {}", name_, permission_advice(kind_)));
  link.may_keep_still();
  bool there = true;
  while (there && !stop.load(std::memory_order_relaxed)) {
    there = take_in();
    const std::int64_t now = base::steady_nanoseconds();
    reader_->pass(link, now);
    rumble(link, now);
    if (there) input_.node->wait(kReadingPeriod);
  }
  if (rumbles_) static_cast<void>(input_.node->rumble(0.0, 0));
  return there ? std::string() : fmt::format("{}: unplugged or switched off; plug it in again", name_);
}

void InputDriver::close() { input_ = {}; }

/// Takes in the events there are; false when the device is gone.
bool InputDriver::take_in() {
  InputEvent event;
  for (int i = 0; i < kMostInputEvents; ++i) {
    switch (input_.node->next(event)) {
      case InputTold::Event:
        take(event);
        break;
      case InputTold::Nothing:
        return true;
      case InputTold::Missed:
        if (!take_in_missed()) return false;
        break;
      case InputTold::Gone:
        return false;
    }
  }
  return true;
}

/// Takes in the differences that dropped events have left. All of them, as other events stand behind: there
/// are no more than the device has keys and axes.
bool InputDriver::take_in_missed() {
  reader_->missed();
  InputEvent event;
  InputTold told = InputTold::Event;
  for (int i = 0; i < kMostInputEvents && told == InputTold::Event; ++i) {
    told = input_.node->next_missed(event);
    if (told == InputTold::Event) take(event);
  }
  return told != InputTold::Gone;
}

void InputDriver::take(const InputEvent& event) {
  if (event.type == EV_SYN && event.code == SYN_REPORT) return reader_->frame(event.time);
  if (event.type != EV_SYN) reader_->take(event);
}

/// Rumbles with the strength of the force, as a share of the strongest force.
void InputDriver::rumble(DriverLink& link, std::int64_t now) {
  if (!rumbles_) return;
  const auto strength = pacer_.next(link.force(now).norm() / info_.max_force, now);
  if (!strength) return;
  const std::error_code error = input_.node->rumble(*strength, RumblePacer::kLasts);
  if (!error || error == std::errc::no_such_device) return;
  rumbles_ = false;
  link.tell(fmt::format("{}: no rumble any more ({}); plug it in again", name_, error.message()));
}

}  // namespace icome::devices
