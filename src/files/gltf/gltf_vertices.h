#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "world/shape/mesh_geometry.h"

namespace icome::files {

/// A mesh in the form of glTF: all data of corners belong to vertices.
struct GltfVertices {
  std::vector<std::array<float, 3>> positions;
  std::vector<std::array<float, 3>> normals;      // of every vertex or none: every triangle is flat
  std::vector<std::array<float, 2>> coordinates;  // of every vertex or none
  std::vector<std::array<float, 3>> colours;      // of every vertex or none; linear
  std::vector<std::uint32_t> corners;             // three of each triangle
  bool smooth = false;                            // the normals are those of a mesh without any
};

/// Splits as few vertices as possible. A mesh without normals, which is smooth, gets normals that make
/// other programs show it so.
GltfVertices gltf_vertices(const world::MeshGeometry& shape);

}  // namespace icome::files
