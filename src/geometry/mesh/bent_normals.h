#pragma once
#include <array>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

using CornerNormals = std::vector<std::array<Vector3, 3>>;

/// The corner normals of a mesh whose vertices have moved from their places in `before` to `after` (m, as
/// many). Corners at one place that had one normal keep having one, and others stay apart: places that looked
/// smooth or sharp still do. Each normal turns as the surface does round its corner: with the average of the
/// group's triangles, weighted by their angles, and with an edge. So a rigid motion turns all normals alike,
/// those of facets stay those of the facets, and normals round which nothing has moved are the same to the
/// last bit. Where triangles have no area, before or after, normals stay as they are.
///
/// Precondition: indices in range, finite positions, and unit normals for each triangle.
CornerNormals bent_normals(const TriangleMesh& before, std::span<const Vector3> after,
                           const CornerNormals& normals);

}  // namespace icome::geometry
