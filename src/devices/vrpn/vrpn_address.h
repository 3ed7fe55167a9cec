#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// The axes of a tracker in ours (x right, y up, z to the user), and its unit of length.
struct VrpnFrame {
  base::Matrix3 ours_from_theirs = base::Matrix3::Identity();  // a rotation
  double scale = 1.0;                                          // m for one of their units, > 0

  /// Our x, y and z in theirs, such as "x,z,-y" for a tracker whose z points up and y away from the user.
  /// Fails unless this is right-handed, as axes of VRPN are.
  static base::Result<VrpnFrame> parse(std::string_view axes, double scale);

  Vector3 position(const Vector3& theirs) const { return scale * (ours_from_theirs * theirs); }
  Quaternion orientation(const Quaternion& theirs) const;
};

/// The way in which a VRPN client has the server give forces.
enum class VrpnForces : std::uint8_t {
  Planes,  // a plane that the server's own loop renders as a spring
  Fields,  // a constant force around the tip
  Off,
};

/// A device of a VRPN server, with the facts about it that VRPN does not tell.
struct VrpnAddress {
  std::string name = "Tracker0";
  std::string host = "localhost";
  int port = 3883;
  VrpnFrame frame{};
  int sensor = 0;  // of the tracker
  int grip = -1;   // analog channel of PointerState::grip, from 0 open to 1 closed; -1: none
  VrpnForces forces = VrpnForces::Planes;
  double spring_unit = 1000.0;  // N/m for a spring constant of 1: programs send 0 to 1 and mean N/mm
  DeviceInfo info{};            // limits

  /// "NAME@HOST:PORT", "NAME@HOST" or "NAME", and after a question mark, with & between them:
  /// axes=x,z,-y  scale=0.001 (m)  sensor=1  grip=0  forces=planes, fields or none  unit=1000 (N/m)
  /// profile=touch (limits of a device profile)  radius=0.1 (m, workspace)
  static base::Result<VrpnAddress> parse(std::string_view text);
};

}  // namespace icome::devices
