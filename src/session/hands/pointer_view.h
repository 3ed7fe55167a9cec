#pragma once
#include <cstdint>

#include "base/object_id.h"
#include "base/vector.h"
#include "devices/pointer_device.h"
#include "world/id.h"

namespace icome::session {

/// The state of one pointer after a tick of the servo, for eyes and for interaction; stage frame.
struct PointerView {
  std::int64_t time = 0;  // ns, steady clock
  devices::DeviceStatus status = devices::DeviceStatus::Lost;
  base::Vector3 tip = base::Vector3::Zero();  // m, the device's own
  base::Vector3 scp = base::Vector3::Zero();  // m, the surface contact point; the tip when nothing is touched
  base::Vector3 force = base::Vector3::Zero();                  // N, on the hand
  base::Quaternion orientation = base::Quaternion::Identity();  // stage_from_stylus
  /// m, in the device's own frame, wherever its workspace is being carried to.
  base::Pose device_from_stylus = base::Pose::Identity();
  std::uint32_t buttons = 0;  // bit i: button i is down
  bool touching = false;
  base::ObjectId touched = {};   // in the haptic scene, when touching
  double asked_stiffness = 0.0;  // N/m, of the touched object as it was made, or the device's nominal one
  double stiffness = 0.0;        // N/m, that as it is felt: no more than is stable
  bool spared = false;           // less force than is felt there, as the motors would become too warm
  std::uint64_t losses = 0;      // how often the device was lost since the start
};

/// One sample of force over time, for a plot.
struct ForceSample {
  std::int64_t time = 0;  // ns, steady clock
  float force = 0.0F;     // N, magnitude; the largest since the sample before
  bool touching = false;
};

}  // namespace icome::session
