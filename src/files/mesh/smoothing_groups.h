#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::files {

/// A polygon of an OBJ file that became triangles.
struct SmoothedFace {
  std::uint32_t triangles = 0;  // their number, one after the other
  std::uint32_t group = 0;      // of polygons that are smooth where they meet; 0: it is flat
};

/// The unit normals of all corners by smoothing groups: the mean of the group's polygons around the vertex,
/// weighted by their angles there. `faces` contain all triangles of the mesh.
std::vector<std::array<geometry::Vector3, 3>> smoothed_normals(const geometry::TriangleMesh& mesh,
                                                               std::span<const SmoothedFace> faces);

}  // namespace icome::files
