#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/vector.h"

namespace icome::geometry {

using base::Bounds;
using base::Matrix3;
using base::Pose;
using base::Vector2;
using base::Vector3;

/// An indexed triangle mesh: owns its positions (metres, the mesh's own frame) and its triangles
/// (three indices each, counter-clockwise seen from the front).
struct TriangleMesh {
  using Triangle = std::array<std::uint32_t, 3>;

  std::vector<Vector3> positions;
  std::vector<Triangle> triangles;

  const Vector3& corner(std::size_t triangle, int which) const {
    return positions[triangles[triangle][which]];
  }
};

/// The smallest axis-aligned box around the positions; empty for a mesh without any.
Bounds bounds(const TriangleMesh& mesh);

/// The volume that the triangles enclose, m^3: positive when a closed mesh's fronts face out, negative
/// when it is inside-out. For an open mesh the number depends on the frame and means nothing.
double signed_volume(const TriangleMesh& mesh);

/// The sum of the triangles' areas, m^2 (one side of each).
double surface_area(const TriangleMesh& mesh);

/// Unit normals at the vertices, each the average of its triangles' normals weighted by the angle
/// at the vertex (Thuermer and Wuethrich 1998). Zero where a vertex has no triangle.
std::vector<Vector3> vertex_normals(const TriangleMesh& mesh);

/// Adds the vertices and triangles of another mesh behind those that are there; nothing is welded.
void append(TriangleMesh& mesh, const TriangleMesh& other);

}  // namespace icome::geometry
