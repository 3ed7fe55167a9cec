#pragma once
#include <cmath>

#include "animation/project/project.h"

namespace icome::animation {

/// A vector of the stage (y down) turned counter-clockwise as seen by `angle`, rad.
inline Vector2 turned(const Vector2& vector, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * vector.x() + s * vector.y(), c * vector.y() - s * vector.x()};
}

/// The angle of a direction on the stage (y down): rad, counter-clockwise as seen, 0 to the right, in
/// (-pi, pi]; 0 of no direction.
inline double angle_of(const Vector2& direction) { return std::atan2(-direction.y(), direction.x()); }

/// `angle` and full turns, so that it lies within half a turn of `near`, rad.
inline double unwrapped(double angle, double near) { return near + std::remainder(angle - near, 2 * M_PI); }

}  // namespace icome::animation
