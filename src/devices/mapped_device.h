#pragma once
#include <memory>
#include <optional>
#include <string>

#include "devices/pointer_device.h"
#include "realtime/latest_value.h"

namespace icome::devices {

/// The place of a device's workspace in ours, and the limits of its use: `icome devices calibrate` finds them
/// out, and a person may edit them.
struct DeviceMapping {
  Vector3 centre = Vector3::Zero();  // m, in the device's frame: the middle of our workspace
  Quaternion ours_from_device = Quaternion::Identity();  // turns the device's axes into ours
  std::optional<double> scale{};    // m that the tip moves for each m of the hand, 0.01 to 100; none: 1
  double workspace_radius = 0.0;    // m, before the scale; 0: the device's own
  double max_force = 0.0;           // N, if lower than the device's own; 0: that
  int clutch_button = -1;           // while it is down the tip stays; -1: none
  bool scale_follows_view = false;  // in a window: the workspace spans what is seen, at any scale
};

/// The clutch of a device: what it has done to the workspace.
struct ClutchState {
  bool held = false;
  Vector3 shift = Vector3::Zero();  // m, ours: where the middle of the workspace is now
};

/// A device as it is felt through a mapping: its tip moves `scale` times as far as the hand, and its forces
/// are the device's own, and never above the mapping's. The wall that the hand feels is then `scale` times as
/// stiff as the wall is, so its abilities count for the tip: a mass 1/scale times and a stiffness 1/scale
/// times the device's. While the clutch is held the tip is laid aside and the hand is free; let go of, the
/// tip goes on from where it was. Owns the device; the threads are those of PointerDevice.
class MappedDevice final : public PointerDevice {
 public:
  MappedDevice(std::unique_ptr<PointerDevice> device, const DeviceMapping& mapping);

  const DeviceInfo& info() const override { return info_; }
  DeviceStatus read(PointerState& state) override;
  DeviceStatus write(const Vector3& force) override;
  std::string condition() const override { return device_->condition(); }

  const PointerDevice& own() const { return *device_; }
  const DeviceMapping& mapping() const { return mapping_; }
  /// Goes over to another mapping, with the clutch where it begins. While nobody reads or writes.
  void set_mapping(const DeviceMapping& mapping);
  /// The clutch at the last reading. One other thread.
  const ClutchState& clutch() {
    clutch_.update();
    return clutch_.read();
  }

 private:
  std::unique_ptr<PointerDevice> device_;
  DeviceMapping mapping_;
  double scale_;
  DeviceInfo info_;
  ClutchState now_ = {};
  Vector3 tip_ = Vector3::Zero();  // m, ours, as it was read last
  realtime::LatestValue<ClutchState> clutch_;
};

}  // namespace icome::devices
