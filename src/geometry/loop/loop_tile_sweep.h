#pragma once
#include <optional>

#include "geometry/loop/loop_tiles.h"
#include "geometry/loop/loop_walk.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

/// A ball and the tolerance of its contacts.
struct LoopBall {
  double radius;  // m
  double slack;   // m, as in SmoothSurface
};

/// The place of a tile that is nearest to a point.
struct TileProjection {
  LoopSpot spot;
  Vector3 place;    // m
  Vector3 away;     // m, from the place to the point
  double distance;  // m
};

/// Newton's method on the squared distance, kept within the tile. Exact on tame tiles for points no farther
/// away than the ball's radius; on others it may be a local minimum. Real-time safe.
TileProjection projection_on_tile(LoopCursor& cursor, const LoopPatches& patches, const LoopTile& tile,
                                  const Vector3& point);

/// The part [first, last] of the way start + t * step, t in [0, 1], of a ball's centre on which the ball may
/// touch the tile from that side, or come within `reach` (m) of doing so. Real-time safe.
std::optional<std::array<double, 2>> way_near_tile(const LoopTile& tile, LoopSide side, double radius,
                                                   const Vector3& start, const Vector3& step, double reach);

/// Bounds of all places of the centre of a ball that touches the tile from that side.
Bounds centres_on_tile(const LoopTile& tile, LoopSide side, double radius);

/// The first place at which the centre of a ball is as near to the tile as its radius, from that side.
struct TileTouch {
  double t;  // along the step, in [0, 1]
  TileProjection foot;
};

/// By conservative advancement: the fastest fall of the distance follows from its slope and from the tile's
/// curvature, so that no touch is missed however grazing. A ball that begins nearer than the radius has no
/// touch until it has been farther off. Real-time safe.
std::optional<TileTouch> first_touch(const LoopPatches& patches, const LoopTile& tile, LoopSide side,
                                     const LoopBall& ball, const Vector3& start, const Vector3& step);

}  // namespace icome::geometry
