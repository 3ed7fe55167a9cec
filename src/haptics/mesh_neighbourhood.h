#pragma once
#include <cstdint>
#include <vector>

#include "geometry/triangle_mesh.h"

namespace icome::haptics {

/// What a triangle's surroundings say about how a sphere tip rests on its edges and corners.
struct Neighbourhood {
  /// Largest distance between its unit normal and those of the triangles around its corners, in
  /// steps of 1/kSpreadSteps, rounded up; kWide when large or when a corner's triangles do not close.
  std::uint8_t spread;
  /// Bit i: edge i, bit 3 + i: corner i is this triangle's to hand out, so that each is handed out
  /// once. Only narrow triangles go by it.
  std::uint8_t owned;
};

constexpr double kSpreadSteps = 180.0;
constexpr std::uint8_t kWide = 180;

/// The neighbourhood of every triangle, in the mesh's order. O(triangles).
std::vector<Neighbourhood> neighbourhoods(const geometry::TriangleMesh& mesh);

}  // namespace icome::haptics
