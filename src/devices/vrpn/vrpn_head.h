#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/driver/driven_device.h"
#include "devices/head_device.h"

namespace icome::devices {

/// The head of a user who wears a tracker of a VRPN server. Its first pose is the look straight ahead, along
/// -z of the axes that the address says. However the tracker sits on the head, its turns are those of the
/// head; places are the tracker's own, so it had best sit between the eyes or above them.
class VrpnHead final : public HeadDevice {
 public:
  /// "NAME@HOST:PORT" and options, as VrpnAddress::parse takes them. May take seconds.
  static base::Result<std::unique_ptr<VrpnHead>> create(std::string_view address,
                                                        const DrivenSettings& settings = {});

  const std::string& name() const override { return device_->info().name; }
  DeviceStatus read(Pose& user_from_head) override;

 private:
  explicit VrpnHead(std::unique_ptr<DrivenDevice> device) : device_(std::move(device)) {}

  std::unique_ptr<DrivenDevice> device_;
  PointerState state_;
  PointerState ahead_;
  bool ahead_known_ = false;
};

}  // namespace icome::devices
