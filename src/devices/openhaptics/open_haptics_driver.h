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

/// Talks to one PHANToM or Touch by OpenHaptics.
class OpenHapticsDriver final : public Driver {
 public:
  OpenHapticsDriver(std::string name, const OpenHapticsSettings& settings);
  ~OpenHapticsDriver() override;

  base::Result<DeviceInfo> open() override;
  std::string run(DriverLink& link, const std::atomic<bool>& stop) override;
  void close() override;

  /// Number of times that a warning was given. Any thread.
  std::uint64_t count(HdWarning warning) const { return warnings_.count(std::size_t(warning)); }

 private:
  std::string be_driven(HdExchange& exchange, DriverLink& link, const std::atomic<bool>& stop);
  std::string follow(HdExchange& exchange, DriverLink& link, const std::atomic<bool>& stop);
  void watch(HdExchange& exchange, DriverLink& link);
  std::string sentence_of(unsigned failure) const;

  std::string name_;
  OpenHapticsSettings settings_;
  HdLibrary hd_;
  std::optional<HdDevice> device_;  // while it is open
  Warnings warnings_;
  std::int64_t next_check_ = 0;  // ns, of the calibration
};

}  // namespace icome::devices
