#pragma once
#include "geometry/loop/loop_patches.h"

namespace icome::geometry {

/// A place on a piece: u, v >= 0, u + v <= 1, exactly 0 (and 1) on the edges.
struct LoopSpot {
  std::uint32_t piece = 0;
  double u = 0.0, v = 0.0;
};

/// The place brought into the piece; its middle where it is not finite. Real-time safe.
LoopSpot clamped(const LoopSpot& spot);

/// Goes straight on by (du, dv), measured in the piece's parameters, over the edges of pieces as if all lay
/// in one plane, to the end or to a place where the surface ends or bends sharply. Real-time safe.
LoopSpot walk(const LoopPatches& patches, LoopSpot from, double du, double dv);

/// Goes along a boundary (or crease), on which edge 0 or 2 of the piece lies, by `distance` along the edge's
/// direction in edges' lengths; stops at corners and at the ends of creases. Real-time safe.
LoopSpot walk_along(const LoopPatches& patches, LoopSpot from, int edge, double distance);

/// Does the surface end or bend sharply at this edge? Real-time safe.
inline bool ends_at(const LoopPatches& patches, std::uint32_t piece, int edge) {
  return piece % 4 != 3 && edge != 1 && patches.across(piece, edge) == LoopPatches::kNone;
}

/// The next piece counter-clockwise (or clockwise) at corner 0 of a piece that is not a middle, which there
/// is corner 0, too; kNone at the last one of an open fan. Real-time safe.
std::uint32_t next_at_vertex(const LoopPatches& patches, std::uint32_t piece, bool counter_clockwise);

}  // namespace icome::geometry
