#pragma once
#include "base/vector.h"
#include "devices/haply/haply_settings.h"
#include "devices/haply/wire/service_state.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// The turn and the shift between the service's axes and ours. Real-time safe.
class HaplyFrame {
 public:
  explicit HaplyFrame(const HaplySettings& settings)
      : device_from_service_(settings.axes.normalized().toRotationMatrix()), middle_(settings.middle) {}

  /// A reading in our frame, from an arm and the grip that belongs to it, which may be null. A grip that
  /// points along the service's y (away from the user) is a stylus that points along our -z, unturned.
  PointerState state_of(const ServiceArm& arm, const ServiceGrip* grip) const {
    PointerState state;
    state.position = device_from_service_ * (arm.position - middle_);
    state.velocity = device_from_service_ * arm.velocity;
    if (grip) {
      const Quaternion turn(device_from_service_);
      state.orientation = turn * grip->orientation * turn.conjugate();
      state.buttons = grip->buttons;
    }
    return state;
  }

  /// A force in the service's axes, N.
  Vector3 service_force(const Vector3& force) const { return device_from_service_.transpose() * force; }

 private:
  base::Matrix3 device_from_service_;
  Vector3 middle_;  // m, service's axes
};

}  // namespace icome::devices
