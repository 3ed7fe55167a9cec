#pragma once
#include <cstdint>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::haptics {

/// The edges and corners of a triangle that a sphere tip needs beside the faces. An edge or a corner is the
/// nearest place of the surface to some position only where the surface is convex, as on a scan at half of
/// the edges and few of the corners; a feature that several triangles share is handed out by one of them. Bit
/// i: edge i, from corner i to the next; bit 3 + i: corner i.
struct MeshFeatures {
  std::uint8_t front;  // of a closed mesh that is touched from outside
  std::uint8_t both;   // touched from both sides
};

/// The features of every triangle, in the mesh's order. Where triangles are too slender to tell, or more than
/// two meet in an edge, all are kept. O(triangles) for meshes without extremely crowded vertices.
std::vector<MeshFeatures> mesh_features(const geometry::TriangleMesh& mesh);

}  // namespace icome::haptics
