#pragma once
#include "geometry/loop/loop_walk.h"

namespace icome::geometry {

/// Slides from a place along the surface, downhill in the distance to `goal`, to a local minimum; at
/// boundaries and creases along them. Real-time safe.
LoopSpot loop_projection(const LoopPatches& patches, LoopCursor& cursor, const LoopSpot& from,
                         const Vector3& goal);

}  // namespace icome::geometry
