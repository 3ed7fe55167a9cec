#pragma once
#include <cstdint>
#include <string>

#include "base/vector.h"

namespace icome::devices {

using base::Pose;
using base::Quaternion;
using base::Vector3;

/// The abilities of a pointer device; from the vendor's data sheet or a profile (see device_profiles.h).
struct DeviceInfo {
  std::string name{};
  double workspace_radius = 0.1;      // m, sphere that the tip can reach
  double max_force = 3.3;             // N, peak; 0 for a device without force
  double continuous_force = 1.0;      // N, held for minutes
  double nominal_stiffness = 1000.0;  // N/m, the hardest wall it renders well
  double effective_mass = 0.1;        // kg, apparent at the tip
};

/// One reading of a pointer device, in the device's frame (metres, x right, y up, z to the user).
struct PointerState {
  Vector3 position = Vector3::Zero();               // m
  Vector3 velocity = Vector3::Zero();               // m/s
  Quaternion orientation = Quaternion::Identity();  // device_from_stylus
  std::uint32_t buttons = 0;                        // bit i: button i is down
  bool jumped = false;                              // moved without a path in between: contacts are left
  bool parked = false;                              // it lies aside, touching nothing
  double grip = 0.0;                                // 0 open to 1 closed; 0 without a gripper
};

/// The outcome of a read or write.
enum class DeviceStatus : std::uint8_t {
  Ok,       // fresh data
  Stalled,  // the device is there but gave nothing new
  Lost,     // unplugged or failed; forces go nowhere
};

/// A device that moves one pointer and may push back. Back-ends derive from it; its creator owns the
/// device, and one thread (the servo) calls read() and write().
class PointerDevice {
 public:
  virtual ~PointerDevice() = default;
  virtual const DeviceInfo& info() const = 0;
  /// The newest state; `state` keeps its old value unless Ok is returned. Real-time safe.
  virtual DeviceStatus read(PointerState& state) = 0;
  /// Sends a force (N, device frame) that is held until the next write. Real-time safe.
  virtual DeviceStatus write(const Vector3& force) = 0;
  /// Sentences about the device that people should know now, such as that its motors are hot or why it is
  /// lost; empty: nothing. Any thread but the servo's.
  virtual std::string condition() const { return {}; }
};

}  // namespace icome::devices
