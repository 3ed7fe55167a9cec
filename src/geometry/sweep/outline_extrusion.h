#pragma once
#include <span>

#include "geometry/sweep/extrusion.h"
#include "geometry/sweep/outline.h"

namespace icome::geometry {

/// As extrude(), of a piece of the plane with holes, whose walls are swept as those of its rim. Also fails
/// where a hole is not within the rim or beside the others, and where the last section is scaled to a point
/// or a line.
base::Result<TriangleMesh> extrude_outline(const Outline& outline, std::span<const SweepStep> steps,
                                           ExtrusionEnds ends = ExtrusionEnds::Capped);

}  // namespace icome::geometry
