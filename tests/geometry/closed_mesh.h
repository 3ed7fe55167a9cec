#pragma once
// What the tests of generated meshes ask of them.
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// Does every edge belong to exactly two triangles that run along it in opposite directions, and is
/// every vertex used? Then the mesh is watertight and consistently oriented.
inline bool is_closed(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> forward, backward;
  std::vector<bool> used(mesh.positions.size(), false);
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      if (triangle[i] >= used.size()) return false;
      used[triangle[i]] = true;
      forward.emplace_back(triangle[i], triangle[(i + 1) % 3]);
      backward.emplace_back(triangle[(i + 1) % 3], triangle[i]);
    }
  }
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  const bool each_once = std::adjacent_find(forward.begin(), forward.end()) == forward.end();
  return each_once && forward == backward && std::find(used.begin(), used.end(), false) == used.end();
}

/// V - E + F of a closed mesh: 2 for a sphere, 0 for a torus.
inline std::int64_t euler_characteristic(const TriangleMesh& mesh) {
  const auto faces = static_cast<std::int64_t>(mesh.triangles.size());
  return static_cast<std::int64_t>(mesh.positions.size()) - faces * 3 / 2 + faces;
}

/// The enclosed volume, by the divergence theorem: positive if the triangles face out.
inline double volume(const TriangleMesh& mesh) {
  double six_volumes = 0.0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    six_volumes += mesh.corner(i, 0).dot(mesh.corner(i, 1).cross(mesh.corner(i, 2)));
  }
  return six_volumes / 6;
}

}  // namespace icome::geometry
