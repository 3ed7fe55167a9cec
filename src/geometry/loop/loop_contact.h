#pragma once
#include <optional>

#include "geometry/loop/loop_sample.h"
#include "geometry/loop/loop_walk.h"
#include "geometry/smooth_surface.h"

namespace icome::geometry {

/// SmoothSurface's queries about single pieces; see there. Real-time safe.
SurfacePlace loop_place(LoopCursor& cursor, const LoopPatches& patches, const LoopSpot& spot);
std::optional<SurfaceHit> loop_hit(const LoopPatches& patches, std::uint32_t piece, const Vector3& start,
                                   const Vector3& step, bool from_behind, double slack);
bool loop_covers(const LoopPatches& patches, const SurfacePlace& place, const Vector3& above, double slack);

/// The box of a piece.
Bounds loop_box(const LoopPatches& patches, std::uint32_t piece);

/// SmoothSurface's queries about the whole surface; see there. Real-time safe.
bool loop_inside(const LoopPatches& patches, const Vector3& point);
SurfacePlace loop_nearest(const LoopPatches& patches, const Vector3& point);

base::Result<TriangleMesh> loop_tessellate(const LoopPatches& patches, int level);

}  // namespace icome::geometry
