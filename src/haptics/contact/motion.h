#pragma once
#include "base/vector.h"

namespace icome::haptics {

using base::Pose;
using base::Vector3;

/// The even motion of a thing about the moment for which its pose was given, until it holds still: a
/// program that stops answering cannot drag a hand along.
struct Motion {
  static constexpr double kHorizon = 0.1;  // s, for which it goes on where nothing else is given

  Vector3 linear = Vector3::Zero();   // m/s, world frame, of the thing's origin
  Vector3 angular = Vector3::Zero();  // rad/s, world frame, about the thing's origin
  double arrives = 0.0;               // s after the moment, >= 0: then it is at the given pose
  double ends = kHorizon;             // s after the moment, >= `arrives`: from then on it holds still

  bool operator==(const Motion& other) const = default;
  bool still() const { return linear.isZero(0.0) && angular.isZero(0.0); }
  /// Does it move then, `elapsed` s after the moment? Real-time safe.
  bool moves(double elapsed) const { return elapsed < ends && !still(); }
};

/// The motion that brings a thing from one pose to another in `seconds` > 0, and ends there.
Motion motion_between(const Pose& from, const Pose& to, double seconds);

/// The pose of a thing `elapsed` s after the moment for which `said` is its pose. Real-time safe.
Pose moved(const Pose& said, const Motion& motion, double elapsed);

/// Velocity (m/s) at a place of the thing, which is at `pose` then, both in one frame with the world's
/// axes. Real-time safe.
Vector3 velocity_at(const Pose& pose, const Motion& motion, double elapsed, const Vector3& place);

/// A share (0 to 1) of the way from one pose to another. Real-time safe.
Pose between(const Pose& from, const Pose& to, double share);

}  // namespace icome::haptics
