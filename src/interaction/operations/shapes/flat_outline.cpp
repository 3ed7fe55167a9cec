#include "interaction/operations/shapes/flat_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/decompositions.h"
#include "geometry/mesh/weld.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::fail;
using base::Result;
using base::Vector3;
using geometry::TriangleMesh;

/// The largest distance of a vertex from the plane, as a share of the mesh's extent.
constexpr double kFlatness = 1e-6;

using Rim = std::map<std::uint32_t, std::uint32_t>;  // from each vertex on it to the next

/// The edges of one triangle only; fails where they cannot be followed from vertex to vertex.
Result<Rim> rim_of(const TriangleMesh& mesh) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = triangle[i], to = triangle[(i + 1) % 3];
      if (from == to || edges.erase({to, from}) > 0) continue;
      if (!edges.emplace(from, to).second)
        return fail("its triangles do not face the same way, or lie on one another; repair it first");
    }
  }
  Rim rim;
  for (const auto& [from, to] : edges)
    if (!rim.emplace(from, to).second) return fail("its outline touches itself; draw it so that it does not");
  return rim;
}

/// The vertices of the rim, one after the other.
Result<std::vector<std::uint32_t>> loop_of(const Rim& rim) {
  if (rim.empty()) return fail("it is closed and has no outline; name something flat, such as a square");
  std::vector<std::uint32_t> loop;
  std::uint32_t vertex = rim.begin()->first;
  do {
    loop.push_back(vertex);
    const auto next = rim.find(vertex);
    if (next == rim.end()) return fail("its outline has an end; repair it first");
    vertex = next->second;
  } while (vertex != rim.begin()->first && loop.size() <= rim.size());
  if (loop.size() != rim.size()) return fail("its outline is not one loop; name a piece without holes");
  return loop;
}

/// Texture coordinates of the vertices on the rim, each in the triangle whose edge begins there.
std::map<std::uint32_t, base::Vector2> places_on(
    const Rim& rim, const TriangleMesh& mesh, const std::vector<std::array<base::Vector2, 3>>& coordinates) {
  std::map<std::uint32_t, base::Vector2> places;
  for (std::size_t t = 0; t < coordinates.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge = rim.find(mesh.triangles[t][i]);
      if (edge != rim.end() && edge->second == mesh.triangles[t][(i + 1) % 3])
        places[edge->first] = coordinates[t][i];
    }
  }
  return places;
}

/// Vector along the normal of the loop, as long as twice its area (Newell).
Vector3 doubled_area_of(const TriangleMesh& mesh, const std::vector<std::uint32_t>& loop) {
  const auto from_first = [&](std::size_t i) -> Vector3 {
    return mesh.positions[loop[i]] - mesh.positions[loop[0]];
  };
  Vector3 sum = Vector3::Zero();
  for (std::size_t i = 1; i + 1 < loop.size(); ++i) sum += from_first(i).cross(from_first(i + 1));
  return sum;
}

/// Turns z to the normal by the shortest way; about x where that is half a turn.
base::Matrix3 turn_to(const Vector3& normal) {
  constexpr double kSame = 1e-12;
  if ((normal - Vector3::UnitZ()).norm() < kSame) return base::Matrix3::Identity();
  if ((normal + Vector3::UnitZ()).norm() < kSame) return Vector3(1, -1, -1).asDiagonal();
  return base::rotation_between(Vector3::UnitZ(), normal).toRotationMatrix();
}

}  // namespace

Result<FlatOutline> flat_outline(const world::MeshGeometry& shape) {
  TriangleMesh welded = shape.mesh;
  geometry::weld_equal(welded);
  const auto rim = rim_of(welded);
  if (!rim) return tl::unexpected(rim.error());
  const auto loop = loop_of(*rim);
  if (!loop) return tl::unexpected(loop.error());
  const Vector3 area = doubled_area_of(welded, *loop);
  const double extent = geometry::bounds(shape.mesh).diagonal().norm();
  if (!(area.norm() > 0.0) || !std::isfinite(extent)) return fail("it has no area; name something flat");
  const Vector3 normal = area.normalized();
  const double height = normal.dot(welded.positions[loop->front()]);
  for (const auto& triangle : welded.triangles)
    for (const std::uint32_t corner : triangle)
      if (!(std::abs(normal.dot(welded.positions[corner]) - height) <= kFlatness * extent))
        return fail("it is not flat; name something flat, such as a square");

  FlatOutline outline;
  outline.mesh_from_profile = Affine3::Identity();
  outline.mesh_from_profile.linear() = turn_to(normal);
  outline.mesh_from_profile.translation() = height * normal;
  const base::Matrix3 profile_from_mesh = outline.mesh_from_profile.linear().transpose();
  const auto places = places_on(*rim, welded, shape.texture_coordinates);
  for (const std::uint32_t vertex : *loop) {
    outline.profile.points.emplace_back((profile_from_mesh * welded.positions[vertex]).head<2>());
    if (!places.empty()) outline.profile.places.push_back(places.at(vertex));
  }
  return outline;
}

}  // namespace icome::interaction
