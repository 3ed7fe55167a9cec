#pragma once
#include "devices/pointer_device.h"
#include "haptics/contact_world.h"

namespace icome::haptics {

using base::Vector3;
using devices::DeviceStatus;

/// A device that reads what the test says.
class ScriptedDevice final : public devices::PointerDevice {
 public:
  const devices::DeviceInfo& info() const override { return info_; }
  DeviceStatus read(devices::PointerState& state) override {
    if (status != DeviceStatus::Ok) return status;
    state.position = position;
    state.velocity = velocity;
    state.orientation = orientation;
    state.buttons = buttons;
    state.jumped = jumped;
    state.parked = parked;
    return status;
  }
  DeviceStatus write(const Vector3& written) override {
    force = written;
    return status == DeviceStatus::Lost ? DeviceStatus::Lost : DeviceStatus::Ok;
  }

  Vector3 position = Vector3::Zero();
  Vector3 velocity = Vector3::Zero();
  Vector3 force = Vector3::Zero();
  devices::Quaternion orientation = devices::Quaternion::Identity();
  std::uint32_t buttons = 0;
  bool jumped = false;
  bool parked = false;
  DeviceStatus status = DeviceStatus::Ok;

 private:
  devices::DeviceInfo info_;
};

inline ScenePointer box_scene(double x = 0.0) {
  return HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")), translation(x, 0, 0))});
}

}  // namespace icome::haptics
