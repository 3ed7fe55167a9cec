#include "geometry/mesh/triangle_mesh.h"

#include <cmath>

namespace icome::geometry {

Bounds bounds(const TriangleMesh& mesh) {
  Bounds box;
  for (const Vector3& position : mesh.positions) box.extend(position);
  return box;
}

double signed_volume(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return 0.0;
  // Measured from a vertex, not from the frame's origin: a small mesh far away keeps its digits.
  const Vector3 origin = mesh.positions.front();
  double six_volumes = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 a = mesh.corner(t, 0) - origin;
    const Vector3 b = mesh.corner(t, 1) - origin;
    const Vector3 c = mesh.corner(t, 2) - origin;
    six_volumes += a.dot(b.cross(c));
  }
  return six_volumes / 6.0;
}

double surface_area(const TriangleMesh& mesh) {
  double twice_area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 a = mesh.corner(t, 0);
    twice_area += (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a).norm();
  }
  return twice_area / 2.0;
}

std::vector<Vector3> vertex_normals(const TriangleMesh& mesh) {
  std::vector<Vector3> normals(mesh.positions.size(), Vector3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 edges[3] = {mesh.corner(t, 1) - mesh.corner(t, 0), mesh.corner(t, 2) - mesh.corner(t, 1),
                              mesh.corner(t, 0) - mesh.corner(t, 2)};
    const Vector3 scaled_normal = edges[0].cross(-edges[2]);
    const double twice_area = scaled_normal.norm();
    if (!(twice_area > 0.0)) continue;
    for (int corner = 0; corner < 3; ++corner) {
      // |leaving x arriving| is twice the area at every corner, so one atan2 gives a sharp angle.
      const double angle = std::atan2(twice_area, -edges[corner].dot(edges[(corner + 2) % 3]));
      normals[mesh.triangles[t][corner]] += scaled_normal * (angle / twice_area);
    }
  }
  for (Vector3& normal : normals) {
    const double length = normal.norm();
    if (length > 0.0) normal /= length;
  }
  return normals;
}

void append(TriangleMesh& mesh, const TriangleMesh& other) {
  const auto first = std::uint32_t(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), other.positions.begin(), other.positions.end());
  mesh.triangles.reserve(mesh.triangles.size() + other.triangles.size());
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({first + a, first + b, first + c});
}

}  // namespace icome::geometry
