#pragma once
#include "geometry/tree/triangle_tree.h"

namespace icome::world {

/// How two triangles lie to each other, the stronger the later.
enum class TriangleMeeting : std::uint8_t {
  Apart,
  Touching,  // a corner or edge of one lies on the other, or both in one plane
  Flush,     // in one plane, areas overlap, and fronts look the same way: what is behind them overlaps
  Crossing,  // one goes through the other
};

/// Both in one frame, neither without area. Distances up to `rounding` (m) count as none: they touch.
TriangleMeeting meeting(const geometry::Corners& one, const geometry::Corners& other, double rounding);

}  // namespace icome::world
