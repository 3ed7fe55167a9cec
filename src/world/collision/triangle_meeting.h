#pragma once
#include "geometry/tree/triangle_tree.h"

namespace icome::world {

/// Relation of two triangles in space, from the weakest to the strongest.
enum class TriangleMeeting : std::uint8_t {
  Apart,
  Touching,  // a corner or edge of one lies on the other, or both in one plane
  Flush,     // in one plane, areas overlap, and fronts look the same way: the insides behind them overlap
  Crossing,  // one goes through the other
};

/// Both in one frame, both with an area. Distances up to `rounding` (m) count as zero: they touch.
TriangleMeeting meeting(const geometry::Corners& one, const geometry::Corners& other, double rounding);

}  // namespace icome::world
