#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "world/shape/mesh_geometry.h"
#include "world/shape/solid_geometry.h"

namespace icome::world {

/// The places in a picture of the corners of a primitive's triangles, as VRML 2.0 (6.6, 6.10, 6.11, 6.42)
/// wraps it round boxes, cones, cylinders and spheres; `mesh` is in the shape's frame. Empty for others.
std::vector<std::array<Vector2, 3>> picture_places(const PrimitiveGeometry& shape,
                                                   const geometry::TriangleMesh& mesh);

}  // namespace icome::world
