#pragma once
#include <array>
#include <atomic>
#include <mutex>
#include <string>

#include "devices/fakes/fake_unit.h"

namespace icome::devices::fakes {

/// The part of the fake of Force Dimension's library that a test sees and sets; the library exports
/// `FakeDhd* fake_dhd()`. A program that loads it steers it by the environment: FAKE_DHD_DEVICES (1),
/// FAKE_DHD_MODEL (omega.7), and the variables of FakeEnvironment.
struct FakeDhd {
  static constexpr int kMost = 4;

  struct Device {
    FakeUnit unit;
    std::atomic<bool> is_open = false;
    std::atomic<bool> has_force = false;     // dhdEnableForce
    std::atomic<bool> has_gravity = false;   // dhdSetGravityCompensation
    std::atomic<int> stops = 0;              // calls of dhdStop
    std::atomic<double> other_motors = 0.0;  // the strongest torque or gripper force, N m or N
  };
  std::array<Device, kMost> devices;
  std::atomic<int> misuses = 0;  // calls with an id that is not open

  /// Plugs in so many devices of that model, without faults; no misuse so far.
  void set_up(int count, const std::string& model, const UnitSettings& settings = {}) {
    for (Device& device : devices) {
      device.unit.set_up(settings);
      device.unit.plug(&device < devices.data() + count);
      device.is_open = device.has_force = device.has_gravity = false;
      device.stops = 0;
      device.other_motors = 0.0;
    }
    misuses = 0;
    const std::lock_guard lock(guard_);
    name_ = model + " (fake)";
  }
  /// Lives until the next set_up().
  const char* name() const {
    const std::lock_guard lock(guard_);
    return name_.c_str();
  }

 private:
  mutable std::mutex guard_;
  std::string name_;
};

}  // namespace icome::devices::fakes
