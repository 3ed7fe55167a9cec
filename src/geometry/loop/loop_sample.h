#pragma once
#include "geometry/loop/loop_patches.h"

namespace icome::geometry {

/// Position, derivatives with respect to the piece's u and v, and the unit normal of a place. At an
/// extraordinary vertex the derivatives have the limit's directions and some length: the true one is 0 or
/// infinite. Real-time safe.
struct LoopPoint {
  Vector3 point, du, dv, normal;
};
LoopPoint loop_point(LoopCursor& cursor, const LoopPatches& patches, std::uint32_t piece, double u, double v);

/// A place of a control triangle on its pieces, and the derivatives of the piece's u and v there.
struct LoopPlace {
  std::uint32_t piece;
  double u, v;
  std::array<std::array<double, 2>, 2> change;  // d(piece u, piece v) / d(u, v) of the triangle
};
LoopPlace place_of(std::uint32_t slot, double u, double v);

}  // namespace icome::geometry
