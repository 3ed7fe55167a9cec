#pragma once
#include <optional>
#include <string>

#include "base/vector.h"
#include "devices/driver/driver.h"
#include "devices/driver/warnings.h"
#include "devices/forcedimension/dhd_session.h"
#include "devices/forcedimension/force_dimension.h"

namespace icome::devices {

/// Talks to one device by Force Dimension's library, at its own pace.
class ForceDimensionDriver final : public Driver {
 public:
  /// `index` of the device, or the first one that is not open yet.
  ForceDimensionDriver(std::optional<int> index, const base::Matrix3& rotation,
                       const ForceDimensionSettings& settings);
  ~ForceDimensionDriver() override;

  base::Result<DeviceInfo> open() override;
  std::string run(DriverLink& link, const std::atomic<bool>& stop) override;
  void close() override;
  std::string identity() const override { return device_ ? dhd_identity(device_->index) : ""; }

 private:
  static constexpr std::size_t kTimeGuards = 0;
  static constexpr std::size_t kSaturations = 1;

  bool prepare();
  bool exchange(DriverLink& link);
  bool read(PointerState& reading);
  bool send(const Vector3& force);
  bool take(int result);

  std::optional<int> index_;
  base::Matrix3 rotation_;  // ours_from_device
  ForceDimensionSettings settings_;
  DhdLibrary dhd_;
  std::optional<DhdDevice> device_;  // while it is open
  std::string model_;                // of the first one that was opened
  bool has_wrist_motors_ = false;
  bool has_gripper_ = false;
  std::string failure_;  // of the call that failed
  Warnings warnings_;
};

}  // namespace icome::devices
