#pragma once
#include <cstdint>
#include <string>

#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// One reading of a navigation device, in the device's frame (x right, y up, z to the user): its deflection
/// by pushing and turning, each axis from -1 to 1; a turn is an angle about its vector's direction. The
/// reader decides which speed a deflection means.
struct NavigationState {
  Vector3 push = Vector3::Zero();
  Vector3 turn = Vector3::Zero();
  std::uint32_t buttons = 0;  // bit i: button i is down
};

/// A device that moves the user through the world, such as a 3D mouse (thesis 5.6.3). Back-ends derive from
/// it; its creator owns the device, and one thread (main) calls read().
class NavigationDevice {
 public:
  virtual ~NavigationDevice() = default;
  virtual const std::string& name() const = 0;
  /// The newest state; `state` keeps its old value unless Ok is returned. Never waits.
  virtual DeviceStatus read(NavigationState& state) = 0;
};

}  // namespace icome::devices
