#pragma once
#include "geometry/triangle_mesh.h"

namespace icome::geometry {

/// Moves a mesh whose coordinates are far larger than it is, such as those of a map, about the origin, and
/// tells where that then lies in the old frame, m. Nothing is rounded: each new coordinate, and the way
/// between any two vertices, is what it was. Boxes in single precision and tolerances that follow coordinates
/// are then as fine as for a mesh that was made there. Axes along which it lies near are left as they are.
Vector3 bring_near(TriangleMesh& mesh);

}  // namespace icome::geometry
