#pragma once
#include <memory>
#include <optional>
#include <string>

#include "devices/driver/driver.h"
#include "devices/driver/warnings.h"
#include "devices/openhaptics/hd_exchange.h"
#include "devices/openhaptics/hd_session.h"
#include "devices/openhaptics/open_haptics.h"

namespace icome::devices {

/// Talks to one PHANToM or Touch by OpenHaptics. Where a call of the library hangs while its scheduler
/// drives, run() returns within 2 s all the same; where a thread of ours makes frames, it cannot.
class OpenHapticsDriver final : public Driver {
 public:
  OpenHapticsDriver(std::string name, const OpenHapticsSettings& settings);
  ~OpenHapticsDriver() override;

  base::Result<DeviceInfo> open() override;
  std::string run(DriverLink& link, const std::atomic<bool>& stop) override;
  void close() override;
  std::string identity() const override { return device_ ? device_->identity() : ""; }

 private:
  std::string be_driven(DriverLink& link, const std::atomic<bool>& stop);
  std::string follow(DriverLink& link, const std::atomic<bool>& stop);
  void watch(HdExchange& exchange, DriverLink& link);
  std::string sentence_of(unsigned failure) const;

  std::string name_;
  OpenHapticsSettings settings_;
  HdLibrary hd_;
  std::optional<HdDevice> device_;      // while it is open
  std::shared_ptr<Warnings> warnings_;  // a callback that hangs may outlive the driver
  std::int64_t next_check_ = 0;         // ns, of the calibration
};

}  // namespace icome::devices
