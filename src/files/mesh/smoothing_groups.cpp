#include "files/mesh/smoothing_groups.h"

#include <cmath>
#include <unordered_map>

namespace icome::files {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;

/// Normal of a triangle, as long as twice its area.
Vector3 area_vector(const TriangleMesh& mesh, std::size_t t) {
  const Vector3& a = mesh.corner(t, 0);
  return (mesh.corner(t, 1) - a).cross(mesh.corner(t, 2) - a);
}

/// Angle of the triangle at a corner, rad.
double corner_angle(const TriangleMesh& mesh, std::size_t t, int i) {
  const Vector3& here = mesh.corner(t, i);
  const Vector3 before = mesh.corner(t, (i + 2) % 3) - here, after = mesh.corner(t, (i + 1) % 3) - here;
  return std::atan2(before.cross(after).norm(), before.dot(after));
}

Vector3 unit_or(const Vector3& vector, const Vector3& otherwise) {
  const Vector3 unit = vector.stableNormalized();
  return unit.allFinite() && !unit.isZero(0.0) ? unit : otherwise;
}

/// Key of a vertex in a group.
std::uint64_t place_in_group(std::uint32_t vertex, std::uint32_t group) {
  return (std::uint64_t{group} << 32U) | vertex;
}

}  // namespace

std::vector<std::array<Vector3, 3>> smoothed_normals(const TriangleMesh& mesh,
                                                     std::span<const SmoothedFace> faces) {
  std::vector<std::array<Vector3, 3>> normals(mesh.triangles.size());
  std::unordered_map<std::uint64_t, Vector3> sums;
  const auto for_triangles = [&](const auto& visit) {
    std::size_t first = 0;
    for (const SmoothedFace& face : faces) {
      for (std::size_t t = first; t < first + face.triangles; ++t) visit(t, first, face);
      first += face.triangles;
    }
  };
  // All corners start with the normal of their polygon.
  for_triangles([&](std::size_t t, std::size_t first, const SmoothedFace& face) {
    if (t > first) {
      normals[t] = normals[first];
      return;
    }
    Vector3 area = Vector3::Zero();
    for (std::size_t of_face = first; of_face < first + face.triangles; ++of_face)
      area += area_vector(mesh, of_face);
    normals[t].fill(unit_or(area, Vector3::UnitZ()));
  });
  for_triangles([&](std::size_t t, std::size_t, const SmoothedFace& face) {
    for (int i = 0; face.group != 0 && i < 3; ++i) {
      const double angle = corner_angle(mesh, t, i);
      if (!std::isfinite(angle)) continue;
      Vector3& sum =
          sums.try_emplace(place_in_group(mesh.triangles[t][std::size_t(i)], face.group), Vector3::Zero())
              .first->second;
      sum += angle * normals[t][std::size_t(i)];
    }
  });
  for_triangles([&](std::size_t t, std::size_t, const SmoothedFace& face) {
    for (std::size_t i = 0; face.group != 0 && i < 3; ++i) {
      const auto found = sums.find(place_in_group(mesh.triangles[t][i], face.group));
      if (found != sums.end()) normals[t][i] = unit_or(found->second, normals[t][i]);
    }
  });
  return normals;
}

}  // namespace icome::files
