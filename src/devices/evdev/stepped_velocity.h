#pragma once
#include <cstdint>

#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// The velocity of a tip whose device tells only places, and those only when they change.
class SteppedVelocity {
 public:
  /// Begins at a place (m), at rest.
  void restart(const Vector3& place);
  /// Takes a new place (m), reached at that time, ns.
  void step(const Vector3& place, std::int64_t time);
  /// The velocity, m/s, smoothed over some 15 ms; none when no step came for 30 ms. `now`: ns, of the
  /// caller's clock, which may be another one than that of the steps.
  Vector3 at(std::int64_t now);

 private:
  Vector3 place_ = Vector3::Zero();
  Vector3 velocity_ = Vector3::Zero();
  std::int64_t time_ = 0;     // ns, of the last step
  std::int64_t stepped_ = 0;  // ns, of the caller's first call after that step
  bool fresh_ = false;        // a step has come since the caller's last call
};

}  // namespace icome::devices
