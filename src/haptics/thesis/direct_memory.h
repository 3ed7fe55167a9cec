#pragma once
#include "geometry/primitive/primitive.h"

namespace icome::haptics {

using base::Vector3;

/// Memory of the thesis renderers from one tick to the next about one object, in the object's frame (m):
/// "PreviousSCP" and "PreviousPointer" of algorithms 5.1 to 5.4.
struct DirectMemory {
  geometry::SurfacePoint scp{Vector3::Zero(), Vector3::UnitZ()};  // the pointer itself while free
  Vector3 pointer = Vector3::Zero();
  bool touching = false;

  /// The memory of a pointer that was at `place` and free. Real-time safe.
  static DirectMemory free_at(const Vector3& place) { return {{place, Vector3::UnitZ()}, place, false}; }
};

}  // namespace icome::haptics
