#pragma once
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Makes a manifold of a closed surface whose parts touch along edges or at vertices: of the triangles around
/// such an edge those become neighbours that have the same solid between them, and each sheet gets vertices
/// of its own. Every edge must have as many triangles in one direction as in the other, facing out of the
/// solid. Vertices without triangles are dropped.
TriangleMesh separate_sheets(const TriangleMesh& mesh);

}  // namespace icome::geometry
