#pragma once
#include <cstdint>

#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// The velocity of a tip whose device tells only places, and those only when they change.
class SteppedVelocity {
 public:
  /// It begins at a place, at rest.
  void restart(const Vector3& place);
  /// It is at another place (m) since that time, ns.
  void step(const Vector3& place, std::int64_t time);
  /// m/s, smoothed over some 15 ms; none when no step came for 30 ms. `now`: ns, of the caller's clock, which
  /// may be another one than that of the steps.
  Vector3 at(std::int64_t now);

 private:
  Vector3 place_ = Vector3::Zero();
  Vector3 velocity_ = Vector3::Zero();
  std::int64_t time_ = 0;     // ns, of the last step
  std::int64_t stepped_ = 0;  // ns, when the caller first asked after it
  bool fresh_ = false;        // there was a step since the caller asked
};

}  // namespace icome::devices
