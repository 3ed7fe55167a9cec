#pragma once
#include "geometry/csg/csg_tree.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Where a thing with these bounds had better have its origin, m: about its middle along axes on which it
/// lies far off for its size, else where it is. To move it there rounds no coordinate that it has.
Vector3 near_origin(const Bounds& bounds);

/// Moves a mesh whose coordinates are far larger than it is, such as those of a map, about the origin, and
/// tells where that then lies in the old frame, m. Nothing is rounded: each new coordinate, and the way
/// between any two vertices, is what it was. Boxes in single precision and tolerances that follow coordinates
/// are then as fine as for a mesh that was made there. Axes along which it lies near are left as they are.
Vector3 bring_near(TriangleMesh& mesh);

/// The same for a solid, by its root's place.
Vector3 bring_near(CsgTree& tree);

}  // namespace icome::geometry
