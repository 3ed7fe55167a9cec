#pragma once
#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::devices {

/// The place itself, or the nearest one on a sphere about the origin where it is outside.
inline Vector3 within_sphere(const Vector3& place, double radius) {
  const double distance = place.norm();
  return distance > radius ? Vector3(place * (radius / distance)) : place;
}

}  // namespace icome::devices
