#pragma once
#include <array>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"
#include "world/shape/solid_geometry.h"

namespace icome::world {

/// The unit normals of a primitive's surface at the corners of its triangles, which are in the shape's
/// frame: on rims those of the side that the triangle belongs to, at the tip of a cone that of its middle.
std::vector<std::array<Vector3, 3>> primitive_normals(const PrimitiveGeometry& shape,
                                                      const geometry::TriangleMesh& mesh);

}  // namespace icome::world
