#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A point to be judged, and the part of the mesh that it belongs to.
struct EnclosureQuery {
  Vector3 point;
  std::uint32_t part;
};

/// For each query: do the other parts enclose its point an odd number of times? `part_of_triangle`
/// gives each triangle's part, kNoTriangle for triangles that enclose nothing; a part with holes is
/// misjudged where the ray leaves through one. Windings do not matter. Source: even-odd rule along a ray in
/// +z.
std::vector<bool> enclosed(const TriangleMesh& mesh, std::span<const std::uint32_t> part_of_triangle,
                           std::span<const EnclosureQuery> queries);

}  // namespace icome::geometry
