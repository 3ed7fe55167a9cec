#pragma once
#include <cstddef>
#include <cstdint>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

enum class TriangleCrossing {
  None,
  Found,
  NotSought,  ///< the tests were used up before
};

/// Does an edge of the mesh's triangles from number `first` on go through another of them? Triangles that
/// share a vertex with the edge are left out; an edge that goes through by less than `tolerance` (m) only
/// touches. `closed` tells that edges of only one triangle lie where nothing goes through, so that each edge
/// need be tested only once. O(n log n) for n triangles that lie in some order along a surface; O(n^2) where
/// they are long and lie side by side, aslant, which `tests_left` bounds: it is counted down by one for each
/// edge near a triangle.
TriangleCrossing find_crossing(const TriangleMesh& mesh, std::size_t first, double tolerance, bool closed,
                               std::uint64_t& tests_left);

}  // namespace icome::geometry
