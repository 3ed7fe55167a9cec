#pragma once
#include <string>
#include <utility>

#include "devices/navigation_device.h"

namespace icome::devices {

/// A navigation device in software, for tests and for driving a session from a program: it keeps the state of
/// the last hold(). One thread uses it.
class SimulatedNavigation final : public NavigationDevice {
 public:
  explicit SimulatedNavigation(std::string name = "simulated 3D mouse") : name_(std::move(name)) {}

  const std::string& name() const override { return name_; }
  DeviceStatus read(NavigationState& state) override {
    if (status_ == DeviceStatus::Ok) state = state_;
    return status_;
  }

  void hold(const NavigationState& state) { state_ = state; }
  /// Lost: unplugged; Ok: plugged in again.
  void set_status(DeviceStatus status) { status_ = status; }

 private:
  std::string name_;
  NavigationState state_;
  DeviceStatus status_ = DeviceStatus::Ok;
};

}  // namespace icome::devices
