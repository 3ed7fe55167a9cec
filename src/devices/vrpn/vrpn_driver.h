#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include "devices/driver/device_claim.h"
#include "devices/driver/driver.h"
#include "devices/vrpn/client_link.h"
#include "devices/vrpn/tracker_readings.h"
#include "devices/vrpn/vrpn_address.h"

namespace icome::devices {

/// Driver::identity() of the device of an address, wherever its server is by name. May take seconds.
std::string vrpn_identity(const VrpnAddress& address);

/// A device of a VRPN server: tracker, buttons, analog channel and force of one name.
///
/// Forces go as planes, unless the address says otherwise. The server's own loop renders a plane as a spring,
/// at its rate and without the delay of the net: so the plane through the tip's place, moved by force /
/// stiffness, gives the force that the servo wants where the tip is now, and lessens it at once as the tip
/// leaves. Of a contact of the stiffness K that the servo renders, a plane of the stiffness k leaves (K - k)
/// to the delayed way; with k >= K, here the nominal stiffness of the device, which the servo does not
/// exceed, that part acts against the motion instead of feeding it, whatever the delay. A force field is a
/// force that is held: its part in the delayed way is all of K, and it goes on pushing while nobody says
/// anything.
class VrpnDriver final : public Driver {
 public:
  explicit VrpnDriver(VrpnAddress address) : address_(std::move(address)) {}

  base::Result<DeviceInfo> open() override;
  std::string run(DriverLink& link, const std::atomic<bool>& stop) override;
  void close() override { link_.reset(); }
  std::string identity() const override { return vrpn_identity(address_); }

 private:
  std::string place() const;
  void send_force(const Vector3& force);
  vrpn::Payload plane(const Vector3& force) const;
  vrpn::Payload field(const Vector3& force) const;
  vrpn::Kind force_kind() const;
  vrpn::Payload force_payload(const Vector3& force) const;

  VrpnAddress address_;
  DeviceClaim claim_;  // of the device, where forces are given, from the first open() on
  std::unique_ptr<vrpn::ClientLink> link_;
  bool gives_force_ = false;
  // Since run():
  Vector3 tip_ = Vector3::Zero();         // m, of the last reading that the servo could have
  Vector3 said_force_ = Vector3::Zero();  // N, the force that the server has
  Vector3 said_tip_ = Vector3::Zero();    // m, the tip that it was said for
};

}  // namespace icome::devices
