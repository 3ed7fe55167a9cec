#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "base/result.h"
#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// One step of Loop's subdivision: the vertices' new places and the new points on the edges. Computed by
/// OpenSubdiv, whose weights are exact for this (its limit patches are not).
struct LoopRefinement {
  std::vector<Vector3> vertices;
  std::vector<Vector3> edges;
  std::vector<std::array<std::uint32_t, 3>> edge_of_side;  // for each triangle, side i from corner i to i + 1
};

/// The mesh must be a manifold, with or without boundary, of consistent orientation, each vertex in one fan
/// of triangles. `creases` are edges that stay sharp, `corners` vertices that stay in place.
base::Result<LoopRefinement> loop_refine(const TriangleMesh& mesh,
                                         const std::vector<std::array<std::uint32_t, 2>>& creases,
                                         const std::vector<std::uint32_t>& corners);

}  // namespace icome::geometry
