#pragma once
// Tests that the back-ends of makers' libraries share, beside those of driver_suite.h.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <thread>

#include "base/clock.h"
#include "devices/driver/driven_device.h"
#include "devices/driver_suite.h"
#include "devices/fakes/fake_unit.h"
#include "realtime/guard/guard.h"
#include "repeats.h"

namespace icome::devices::suite {

/// Opens the driver's device, which is looked for often when it is lost.
inline std::unique_ptr<DrivenDevice> driven(std::unique_ptr<Driver> driver) {
  auto device = DrivenDevice::create(std::move(driver), {.retry = 0.02});
  EXPECT_TRUE(device) << (device ? "" : device.error().message);
  return device ? std::move(*device) : nullptr;
}

/// A driver's device whose forces hold for a minute, so that a test does not depend on how often it comes to
/// write one. It is not looked for again when it is lost. Owns driver and thread.
class PatientDevice final : public PointerDevice {
 public:
  /// The driver's device is open.
  PatientDevice(std::unique_ptr<Driver> driver, const DeviceInfo& info)
      : driver_(std::move(driver)), info_(info), link_(info) {
    link_.connect(info_);
    thread_ = std::thread([this] { driver_->run(link_, stop_); });
  }
  ~PatientDevice() override {
    stop_ = true;
    thread_.join();
    driver_->close();
  }

  const DeviceInfo& info() const override { return info_; }
  DeviceStatus read(PointerState& state) override { return link_.read(state); }
  DeviceStatus write(const Vector3& force) override {
    constexpr std::int64_t kMinute = 60'000'000'000;  // ns
    return link_.write(force, base::steady_nanoseconds() + kMinute);
  }

 private:
  std::unique_ptr<Driver> driver_;
  DeviceInfo info_;
  DriverLink link_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

inline std::unique_ptr<PatientDevice> patient(std::unique_ptr<Driver> driver) {
  const auto info = driver->open();
  EXPECT_TRUE(info) << (info ? "" : info.error().message);
  return info ? std::make_unique<PatientDevice>(std::move(driver), *info) : nullptr;
}

/// Reads the device and holds a force, once a millisecond, until a condition on the newest reading holds;
/// false when it never does.
inline bool held_until(PointerDevice& device, const Vector3& force,
                       const std::function<bool(const PointerState&)>& condition) {
  PointerState state;
  bool has_read = false;
  return holds_soon([&] {
    has_read = device.read(state) == DeviceStatus::Ok || has_read;
    device.write(force);
    return has_read && condition(state);
  });
}

/// The number that a condition tells how often a warning was given; 0 without one.
inline int times_told(const std::string& condition) {
  const std::string_view words = "so far: ";
  const std::size_t at = condition.find(words);
  return at == std::string::npos ? 0 : std::atoi(condition.c_str() + at + words.size());
}

/// A rate at which no driver waits between its frames, Hz.
constexpr double kUnpaced = 1e9;

/// A servo that goes mad, and readings that are: none gives a force above the limits, nor one that is not a
/// number. The driver must not wait between its frames.
inline void stands_a_million_readings(PatientDevice& device, fakes::FakeUnit& unit) {
  const auto readings = static_cast<std::uint64_t>(repeats(1'000'000));
  unit.fail(fakes::UnitFault::Hostile);
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::array<Vector3, 4> mad = {Vector3(kNan, 1.0, 1.0), Vector3(1.0, kInfinity, 1.0),
                                      Vector3(1e300, -1e300, 1e300), Vector3(-50.0, 0.0, 3.0)};
  const Undelayed undelayed;
  PointerState state;
  double farthest = 0.0;
  const auto end = std::chrono::steady_clock::now() + 4 * kPatience;
  const auto is_enough = [&] {
    return unit.pushes() >= readings && unit.strongest() > 0.5 * device.info().max_force;
  };
  // The fake is asked now and then only, as it cannot go on meanwhile.
  for (std::size_t i = 0; i % 256 != 0 || !is_enough(); ++i) {
    ASSERT_LT(std::chrono::steady_clock::now(), end) << "after " << unit.pushes() << " readings";
    if (device.read(state) == DeviceStatus::Ok) {
      ASSERT_TRUE(state.position.allFinite() && state.velocity.allFinite() &&
                  state.orientation.coeffs().allFinite() && std::isfinite(state.grip));
      ASSERT_NEAR(state.orientation.norm(), 1.0, 1e-6);
      farthest = std::max(farthest, state.position.norm());
    }
    device.write(i % 16 < 4 ? mad[i % 4] : Vector3(-1e4 * state.position));
    realtime::sleep_until(base::steady_nanoseconds() + 20'000);
  }
  EXPECT_LE(unit.strongest(), device.info().max_force * (1.0 + 1e-9));
  EXPECT_LE(farthest, 10.0 * device.info().workspace_radius + 1.0);
  unit.fail(fakes::UnitFault::None);
  EXPECT_TRUE(held_until(device, Vector3::Zero(), [](const PointerState&) { return true; }));
}

/// The last force of a servo that stands still is taken away.
inline void takes_the_force_away(DrivenDevice& device, fakes::FakeUnit& unit) {
  ASSERT_TRUE(held_until(device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit.held().norm() > 0.01; }));
  ASSERT_TRUE(holds_soon([&] { return unit.held().norm() == 0.0; }));
  EXPECT_GE(device.counts().watchdog_stops, 1U);
}

/// The calls of the servo neither allocate nor lock.
inline void is_real_time_safe(PointerDevice& device) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  ASSERT_TRUE(held_until(device, {0.1, 0.0, 0.0}, [](const PointerState&) { return true; }));
  PointerState state;
  realtime::RealtimeGuard guard;
  for (int i = 0; i < 200; ++i) {
    device.read(state);
    device.write({0.1, 0.0, 0.0});
    realtime::sleep_until(base::steady_nanoseconds() + 100'000);
  }
  guard.stop();
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0U);
}

/// A driver that makes frames on the thread of its run() takes no memory for them. The fake is held at a
/// place, as its arm takes some.
inline void exchanges_without_memory(Driver& driver, fakes::FakeUnit& unit) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  unit.pose({});
  const auto info = driver.open();
  ASSERT_TRUE(info) << info.error().message;
  DriverLink link(*info);
  link.connect(*info);
  std::atomic<bool> stop = false;
  std::uint64_t taken = 1;
  std::string why;
  std::thread thread([&] {
    realtime::RealtimeGuard guard;
    why = driver.run(link, stop);
    guard.stop();
    taken = guard.allocations() + guard.frees();
  });
  EXPECT_TRUE(holds_soon([&] { return unit.pushes() > 1000; }));
  stop = true;
  thread.join();
  driver.close();
  EXPECT_EQ(why, "");
  EXPECT_EQ(taken, 0U);
}

}  // namespace icome::devices::suite
