#include "haptics/mesh_neighbourhood.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"
#include "base/random.h"

namespace icome::haptics {
namespace {

using base::Vector3;
using geometry::TriangleMesh;

constexpr std::size_t kNeighbourhoodGrain = 1 << 15;
constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

/// What meets at a vertex.
struct Fan {
  Vector3 mean = Vector3::Zero();  // of the normals, unit in the end
  double farthest = 0.0;           // largest distance of a normal from the mean
  std::uint64_t open = 0;          // 0 when each edge away from the vertex also leads back to it
  std::uint32_t owner = kNobody;   // triangle
};

Vector3 face_normal(const TriangleMesh& mesh, std::size_t triangle) {
  const Vector3& a = mesh.corner(triangle, 0);
  return (mesh.corner(triangle, 1) - a).cross(mesh.corner(triangle, 2) - a).normalized();
}

std::vector<Fan> fans(const TriangleMesh& mesh) {
  std::vector<Fan> result(mesh.positions.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 normal = face_normal(mesh, i);
    for (int which = 0; which < 3; ++which) {
      Fan& fan = result[mesh.triangles[i][which]];
      fan.mean += normal;
      fan.owner = std::min(fan.owner, i);
      // A sum of random numbers, one a neighbour, that cancels only if both directions occur equally.
      fan.open += base::Random(mesh.triangles[i][(which + 1) % 3]).bits() -
                  base::Random(mesh.triangles[i][(which + 2) % 3]).bits();
    }
  }
  for (Fan& fan : result) fan.mean.normalize();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 normal = face_normal(mesh, i);
    for (const std::uint32_t vertex : mesh.triangles[i]) {
      result[vertex].farthest = std::max(result[vertex].farthest, (result[vertex].mean - normal).norm());
    }
  }
  return result;
}

/// A chord of the unit sphere from the triangle's normal to the farthest around, by way of the mean
/// normal at the corner that they share.
std::uint8_t spread(const TriangleMesh& mesh, const std::vector<Fan>& fans, std::uint32_t triangle) {
  const Vector3 normal = face_normal(mesh, triangle);
  double chord = 0.0;
  for (const std::uint32_t vertex : mesh.triangles[triangle]) {
    if (fans[vertex].open != 0) return kWide;
    chord = std::max(chord, fans[vertex].farthest + (fans[vertex].mean - normal).norm());
  }
  return std::uint8_t(std::min(double(kWide), std::ceil(chord * kSpreadSteps) + 1.0));
}

/// Two triangles run along a shared edge in opposite directions: the one upwards owns it.
std::uint8_t owned(const TriangleMesh& mesh, const std::vector<Fan>& fans, std::uint32_t triangle) {
  unsigned bits = 0;
  const TriangleMesh::Triangle& corners = mesh.triangles[triangle];
  for (unsigned which = 0; which < 3; ++which) {
    if (corners[which] < corners[(which + 1) % 3]) bits |= 1u << which;
    if (fans[corners[which]].owner == triangle) bits |= 8u << which;
  }
  return std::uint8_t(bits);
}

}  // namespace

std::vector<Neighbourhood> neighbourhoods(const TriangleMesh& mesh) {
  const std::vector<Fan> around = fans(mesh);
  std::vector<Neighbourhood> result(mesh.triangles.size());
  base::parallel_for(result.size(), kNeighbourhoodGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto triangle = std::uint32_t(i);
      result[i] = {spread(mesh, around, triangle), owned(mesh, around, triangle)};
    }
  });
  return result;
}

}  // namespace icome::haptics
