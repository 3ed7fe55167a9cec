#pragma once
// Small meshes for the tests of topology and repair.
#include <cmath>
#include <utility>

#include "geometry/mesh/triangle_mesh.h"

namespace icome::geometry {

/// A box of 12 triangles, fronts outward.
inline TriangleMesh box_mesh(const Vector3& low, const Vector3& high) {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.emplace_back(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(),
                                i & 4 ? high.z() : low.z());
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline TriangleMesh unit_box() { return box_mesh({0, 0, 0}, {1, 1, 1}); }

/// The triangles turned inside-out.
inline TriangleMesh turned(TriangleMesh mesh) {
  for (TriangleMesh::Triangle& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  return mesh;
}

/// Both meshes in one, not connected.
inline TriangleMesh together(TriangleMesh a, const TriangleMesh& b) {
  const auto first = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const TriangleMesh::Triangle& t : b.triangles)
    a.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return a;
}

/// Every triangle with corners of its own, as STL files have it.
inline TriangleMesh soup(const TriangleMesh& mesh) {
  TriangleMesh result;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) result.positions.push_back(mesh.corner(t, i));
    result.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return result;
}

/// A strip of `quads` quads around a circle, given half a turn when `twisted`.
inline TriangleMesh ring(std::uint32_t quads, bool twisted) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < quads; ++i) {
    const double angle = 6.283185307179586 * i / quads;
    const double tilt = twisted ? angle / 2.0 : 0.7;
    for (const double side : {-0.2, 0.2}) {
      const double r = 1.0 + side * std::cos(tilt);
      mesh.positions.emplace_back(r * std::cos(angle), r * std::sin(angle), side * std::sin(tilt));
    }
  }
  for (std::uint32_t i = 0; i < quads; ++i) {
    const bool last = i + 1 == quads;
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    std::uint32_t c = last ? 0 : a + 2, d = last ? 1 : b + 2;
    if (last && twisted) std::swap(c, d);
    mesh.triangles.push_back({a, c, b});
    mesh.triangles.push_back({b, c, d});
  }
  return mesh;
}

}  // namespace icome::geometry
