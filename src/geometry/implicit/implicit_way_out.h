#pragma once
#include <optional>

#include "geometry/implicit/implicit_pieces.h"
#include "geometry/primitive/primitive.h"

namespace icome::geometry {

/// A place of a piece.
struct ImplicitWayOut {
  SurfacePoint place;
  std::size_t piece;  // number in the pieces
};

/// A place of the surface within the box near `point`, which is inside: the nearest of those that rays in all
/// directions lead to, followed down to the nearest place of the piece that they meet. Nothing if no ray
/// leads to one. Real-time safe.
std::optional<ImplicitWayOut> implicit_way_out(const ImplicitPieces& pieces, const Bounds& box,
                                               const Vector3& point, double time);

}  // namespace icome::geometry
