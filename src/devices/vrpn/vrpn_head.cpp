#include "devices/vrpn/vrpn_head.h"

#include <utility>

#include "devices/vrpn/vrpn_driver.h"

namespace icome::devices {

base::Result<std::unique_ptr<VrpnHead>> VrpnHead::create(std::string_view address,
                                                         const DrivenSettings& settings) {
  auto parsed = VrpnAddress::parse(address);
  if (!parsed) return tl::unexpected(parsed.error());
  parsed->forces = VrpnForces::Off;
  auto device = DrivenDevice::create(std::make_unique<VrpnDriver>(std::move(*parsed)), settings);
  if (!device) return tl::unexpected(device.error());
  return std::unique_ptr<VrpnHead>(new VrpnHead(std::move(*device)));
}

DeviceStatus VrpnHead::read(Pose& user_from_head) {
  const DeviceStatus status = device_->read(state_);
  if (status != DeviceStatus::Ok) return status;
  if (!std::exchange(ahead_known_, true)) ahead_ = state_;
  // Turns in the axes of the room, which are the user's: how the tracker is mounted drops out.
  user_from_head = Pose::Identity();
  user_from_head.linear() = (state_.orientation * ahead_.orientation.conjugate()).toRotationMatrix();
  user_from_head.translation() = state_.position - ahead_.position;
  return DeviceStatus::Ok;
}

}  // namespace icome::devices
