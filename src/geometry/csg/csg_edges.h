#pragma once
#include <optional>
#include <vector>

#include "geometry/csg/csg_faces.h"
#include "geometry/csg/curve_arc.h"

namespace icome::geometry {

/// The edges of a CSG solid, where two of its faces meet at an angle, and the apexes of its cones, as arcs in
/// the tree's frame. Straight edges are exact. Curved ones are found by dividing space until the two surfaces
/// are nearly flat, solved by Newton's method and kept as polynomials, true to 1e-13 of the solid's size; the
/// ends, where a third surface cuts an edge, to 1e-9 of it. Within 1e-5 of the size of a place where the two
/// surfaces touch without an angle, an edge may be missing. Concave edges are among them.
/// Nothing where that takes too much work (surfaces that nearly touch over a wide part).
/// Precondition: the faces are those of a point tip, their atoms have offsets, and the solid is bounded.
std::optional<std::vector<CurveArc>> csg_edges(const CsgFaces& faces);

}  // namespace icome::geometry
