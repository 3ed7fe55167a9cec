#pragma once
#include "geometry/csg/csg_tree.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// The preferable origin for an object with these bounds, m: near its middle along axes on which it lies far
/// off for its size, else the present origin. Moving the origin there rounds no coordinate of the object.
Vector3 near_origin(const Bounds& bounds);

/// Moves a mesh whose coordinates are far larger than it is, such as those of a map, near the origin, and
/// returns the place of the new origin in the old frame, m. Nothing is rounded: new coordinates are exact,
/// and so is the way between any two vertices. Boxes in single precision, and tolerances that follow the
/// coordinates, are then as fine as for a mesh made there. Axes along which it lies near are left alone.
Vector3 bring_near(TriangleMesh& mesh);

/// Moves a solid likewise, by its root's transform.
Vector3 bring_near(CsgTree& tree);

}  // namespace icome::geometry
