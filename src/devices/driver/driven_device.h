#pragma once
#include <atomic>
#include <memory>
#include <string>
#include <thread>

#include "base/result.h"
#include "devices/driver/driver.h"

namespace icome::devices {

struct DrivenSettings {
  double retry = 1.0;  // s between two attempts to find a lost device again, 0.01 to 60
  int priority = 82;   // SCHED_FIFO, above the servo's: the thread works little, and its delay is the hand's
};

/// A pointer device that a driver talks to on a thread of its own. While it is lost (unplugged, failed, its
/// service ended) its forces are none; it is looked for, and comes back by itself with a ramp. Owns driver
/// and thread.
class DrivenDevice final : public PointerDevice {
 public:
  /// Opens the device, which may take seconds, and starts the thread. Fails where the driver cannot open it.
  static base::Result<std::unique_ptr<DrivenDevice>> create(std::unique_ptr<Driver> driver,
                                                            const DrivenSettings& settings = {});
  /// Ends the thread; the device gives no force any more.
  ~DrivenDevice() override;

  const DeviceInfo& info() const override { return info_; }
  DeviceStatus read(PointerState& state) override { return link_.read(state); }
  DeviceStatus write(const Vector3& force) override;
  std::string condition() const override { return link_.condition(); }

  /// Driver::identity() of the device, which it keeps while it is lost.
  const std::string& identity() const { return identity_; }
  /// Any thread.
  LinkCounts counts() const { return link_.counts(); }

 private:
  DrivenDevice(std::unique_ptr<Driver> driver, DeviceInfo info, const DrivenSettings& settings);
  void run();
  void pause() const;

  std::unique_ptr<Driver> driver_;
  DeviceInfo info_;
  std::string identity_;
  DrivenSettings settings_;
  DriverLink link_;
  std::atomic<bool> stop_ = false;
  std::thread thread_;
};

}  // namespace icome::devices
