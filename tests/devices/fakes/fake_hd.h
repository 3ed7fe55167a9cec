#pragma once
#include <array>
#include <atomic>
#include <mutex>
#include <string>

#include "devices/fakes/fake_unit.h"

namespace icome::devices::fakes {

/// The part of the fake of OpenHaptics that a test sees and sets; the library exports `FakeHd* fake_hd()`. A
/// program that loads it steers it by the environment: FAKE_HD_DEVICES (1; "Left" is the default and the
/// first, "Right" the second), FAKE_HD_MODEL (Touch), FAKE_HD_CALIBRATION (ok, update, inkwell), and the
/// variables of FakeEnvironment.
struct FakeHd {
  /// A call of a frame.
  enum class Call : std::uint8_t { None, BeginFrame, EndFrame };
  /// The answer to hdScheduleAsynchronous.
  enum class Scheduling : std::uint8_t {
    Fine,
    Refused,    // an error, and nothing is scheduled
    Complains,  // an error, although it is scheduled
  };

  static constexpr int kMost = 2;
  static constexpr std::array<const char*, kMost> kNames = {"Left", "Right"};

  struct Device {
    FakeUnit unit;
    std::atomic<bool> is_open = false;
    std::atomic<bool> has_force = false;
    std::atomic<bool> has_ramp = false;
    std::atomic<bool> has_clamp = false;
    std::atomic<bool> is_in_frame = false;
  };
  std::array<Device, kMost> devices;
  std::atomic<int> misuses = 0;  // calls in a wrong order or about a device that is not open
  std::atomic<bool> scheduler_runs = false;
  std::atomic<bool> scheduler_hangs = false;  // it calls nobody, as after a crash of the driver
  std::atomic<bool> scheduler_waits = true;   // false: as fast as it can
  std::atomic<int> callbacks = 0;             // that are scheduled
  std::atomic<Scheduling> scheduling = Scheduling::Fine;
  std::atomic<Call> hangs_in = Call::None;  // that call does not end as long as this is so
  /// One current device and one queue of errors for all threads, as the makers' description can be read, not
  /// for each. Then another thread's call is a misuse while a device is being opened.
  std::atomic<bool> is_per_process = false;
  std::atomic<double> opening_time = 0.0;      // s, that hdInitDevice takes
  std::atomic<bool> is_opening = false;        // hdInitDevice has not ended yet
  std::atomic<unsigned> calibration = 0x5000;  // ok
  std::atomic<double> max_force = 3.3;         // N, that the device says it has

  /// Plugs in so many devices of that model, without faults; no misuse so far.
  void set_up(int count, const std::string& model, const UnitSettings& settings = {}) {
    for (Device& device : devices) {
      device.unit.set_up(settings);
      device.unit.plug(&device < devices.data() + count);
      device.is_open = device.has_force = device.has_ramp = device.has_clamp = device.is_in_frame = false;
    }
    misuses = 0;
    scheduler_hangs = false;
    scheduler_waits = true;
    scheduling = Scheduling::Fine;
    hangs_in = Call::None;
    is_per_process = false;
    opening_time = 0.0;
    calibration = 0x5000;
    max_force = 3.3;
    const std::lock_guard lock(guard_);
    model_ = model + " (fake)";
  }
  /// Lives until the next set_up().
  const char* model() const {
    const std::lock_guard lock(guard_);
    return model_.c_str();
  }

 private:
  mutable std::mutex guard_;
  std::string model_;
};

}  // namespace icome::devices::fakes
