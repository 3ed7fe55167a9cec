#pragma once
#include <atomic>
#include <memory>
#include <string>

#include "devices/driver/driver.h"
#include "devices/evdev/input_finder.h"
#include "devices/evdev/input_reader.h"
#include "devices/evdev/rumble_pacer.h"

namespace icome::devices {

/// Talks to an input device of Linux: passes the state that a reader makes of its events 1000 times a second,
/// also while none come, and turns forces into rumble where the device has it.
class InputDriver final : public Driver {
 public:
  /// The device of an address (see find_input).
  InputDriver(std::shared_ptr<InputSystem> system, InputKind kind, std::string address,
              std::unique_ptr<InputReader> reader);

  base::Result<DeviceInfo> open() override;
  std::string run(DriverLink& link, const std::atomic<bool>& stop) override;
  void close() override;
  std::string identity() const override { return input_.node ? input_.node->abilities().path : ""; }

 private:
  bool take_in();
  bool take_in_missed();
  void take(const InputEvent& event);
  void rumble(DriverLink& link, std::int64_t now);

  std::shared_ptr<InputSystem> system_;
  InputKind kind_;
  std::string address_;
  std::unique_ptr<InputReader> reader_;
  std::string name_;  // of the device that was opened last
  FoundInput input_;  // its node is null while closed
  DeviceInfo info_;
  RumblePacer pacer_;
  bool rumbles_ = false;
};

}  // namespace icome::devices
