#include "render/model/shading_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace icome::render {
namespace {

using base::Bounds;
using base::Vector3;
using geometry::TriangleMesh;

/// Round a vertex with more triangles than this (the tip of a fine cone) each keeps its own normal:
/// comparing all pairs would take too long.
constexpr std::size_t kMostCornersCompared = 128;

/// One triangle's share in the normal of one of its vertices.
struct Corner {
  std::uint32_t slot;  ///< 3 * triangle + which
  Vector3 normal;      ///< the triangle's unit normal
  double angle;        ///< rad
};

/// The corners of a mesh grouped by vertex: those of vertex v are first[v] ... first[v + 1].
struct CornersByVertex {
  std::vector<std::uint32_t> first;
  std::vector<Corner> corners;
};

bool usable(const TriangleMesh& mesh, std::size_t triangle) {
  for (const std::uint32_t index : mesh.triangles[triangle]) {
    if (index >= mesh.positions.size() || !mesh.positions[index].allFinite()) return false;
  }
  return true;
}

/// The triangle's unit normal, zero when it has none. The sides are brought to size 1 first, so that the
/// smallest and the largest models neither vanish nor overflow.
Vector3 unit_normal(const TriangleMesh& mesh, std::size_t triangle) {
  if (!usable(mesh, triangle)) return Vector3::Zero();
  const Vector3 u = mesh.corner(triangle, 1) - mesh.corner(triangle, 0);
  const Vector3 v = mesh.corner(triangle, 2) - mesh.corner(triangle, 0);
  return u.stableNormalized().cross(v.stableNormalized()).stableNormalized();
}

double corner_angle(const TriangleMesh& mesh, std::size_t triangle, int which) {
  const Vector3& here = mesh.corner(triangle, which);
  const Vector3 u = (mesh.corner(triangle, (which + 1) % 3) - here).stableNormalized();
  const Vector3 v = (mesh.corner(triangle, (which + 2) % 3) - here).stableNormalized();
  return std::acos(std::clamp(u.dot(v), -1.0, 1.0));
}

std::vector<Vector3> triangle_normals(const TriangleMesh& mesh) {
  std::vector<Vector3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t) normals[t] = unit_normal(mesh, t);
  return normals;
}

CornersByVertex group_corners(const TriangleMesh& mesh) {
  const std::vector<Vector3> normals = triangle_normals(mesh);
  CornersByVertex grouped;
  grouped.first.assign(mesh.positions.size() + 1, 0);
  for (std::size_t t = 0; t < normals.size(); ++t) {
    if (normals[t].isZero()) continue;
    for (const std::uint32_t v : mesh.triangles[t]) ++grouped.first[v + 1];
  }
  std::partial_sum(grouped.first.begin(), grouped.first.end(), grouped.first.begin());
  grouped.corners.resize(grouped.first.back());
  std::vector<std::uint32_t> next(grouped.first.begin(), grouped.first.end() - 1);
  for (std::size_t t = 0; t < normals.size(); ++t) {
    if (normals[t].isZero()) continue;
    for (int k = 0; k < 3; ++k) {
      grouped.corners[next[mesh.triangles[t][static_cast<std::size_t>(k)]]++] = {
          static_cast<std::uint32_t>(3 * t + static_cast<std::size_t>(k)), normals[t],
          corner_angle(mesh, t, k)};
    }
  }
  return grouped;
}

/// The normal of `corners[which]` among its neighbours round the vertex.
Vector3 smoothed(const Corner* corners, std::size_t count, std::size_t which, double crease_cosine) {
  const Vector3& own = corners[which].normal;
  if (count > kMostCornersCompared) return own;
  Vector3 sum = Vector3::Zero();
  for (std::size_t k = 0; k < count; ++k) {
    if (k == which || own.dot(corners[k].normal) > crease_cosine) sum += corners[k].angle * corners[k].normal;
  }
  return sum.squaredNorm() > 1e-12 ? Vector3(sum.normalized()) : own;
}

void set_frame(ShadingMesh& out, const TriangleMesh& mesh) {
  Bounds box;
  for (const Vector3& p : mesh.positions) {
    if (p.allFinite()) box.extend(p);
  }
  if (box.isEmpty()) return;
  out.centre = 0.5 * box.min() + 0.5 * box.max();
  const double half = 0.5 * box.sizes().stableNorm();
  if (half > 0.0 && std::isfinite(half)) out.radius = half;
}

/// Adds the vertices that one mesh vertex falls into, and points its corners' indices at them.
void split_vertex(ShadingMesh& out, std::vector<std::uint32_t>& index_of_slot, const Vector3& position,
                  const Corner* corners, std::size_t count, double crease_cosine) {
  const Eigen::Vector3f at = ((position - out.centre) / out.radius).cast<float>();
  const std::size_t first = out.vertices.size();
  for (std::size_t c = 0; c < count; ++c) {
    const Eigen::Vector3f normal = smoothed(corners, count, c, crease_cosine).cast<float>();
    const std::size_t searched = std::min(out.vertices.size(), first + kMostCornersCompared);
    std::size_t same = first;
    while (same < searched && out.vertices[same].normal != normal) ++same;
    if (same == searched) {
      same = out.vertices.size();
      out.vertices.push_back({at, normal});
    }
    index_of_slot[corners[c].slot] = static_cast<std::uint32_t>(same);
  }
}

}  // namespace

void change_frame(ShadingMesh& mesh, const base::Vector3& centre, double radius) {
  for (ShadingMesh::Vertex& vertex : mesh.vertices) {
    const base::Vector3 at = mesh.centre + mesh.radius * vertex.position.cast<double>();
    vertex.position = ((at - centre) / radius).cast<float>();  // rounded to single precision last
  }
  mesh.centre = centre;
  mesh.radius = radius;
}

ShadingMesh make_shading_mesh(const TriangleMesh& mesh, double crease_angle) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  ShadingMesh out;
  set_frame(out, mesh);
  const CornersByVertex grouped = group_corners(mesh);
  std::vector<std::uint32_t> index_of_slot(3 * mesh.triangles.size(), kUnused);
  out.vertices.reserve(mesh.positions.size());
  const double crease_cosine = std::cos(crease_angle);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const std::size_t first = grouped.first[v];
    split_vertex(out, index_of_slot, mesh.positions[v], grouped.corners.data() + first,
                 grouped.first[v + 1] - first, crease_cosine);
  }
  std::erase(index_of_slot, kUnused);
  out.indices = std::move(index_of_slot);
  return out;
}

std::vector<std::array<Eigen::Vector3f, 3>> crease_normals(const TriangleMesh& mesh, double crease_angle) {
  std::vector<std::array<Eigen::Vector3f, 3>> normals(mesh.triangles.size());
  for (auto& corners : normals) corners.fill(Eigen::Vector3f::Zero());
  const CornersByVertex grouped = group_corners(mesh);
  const double crease_cosine = std::cos(crease_angle);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Corner* corners = grouped.corners.data() + grouped.first[v];
    const std::size_t count = grouped.first[v + 1] - grouped.first[v];
    for (std::size_t c = 0; c < count; ++c) {
      const std::uint32_t slot = corners[c].slot;
      normals[slot / 3][slot % 3] = smoothed(corners, count, c, crease_cosine).cast<float>();
    }
  }
  return normals;
}

ShadingMesh clustered(const ShadingMesh& mesh, double cell) {
  const auto key = [&](const Eigen::Vector3f& p) {
    const Eigen::Vector3i at = ((p.cast<double>().array() + 1.0) / cell).floor().cast<int>();
    return (static_cast<std::uint64_t>(at.x() + 1) * 2048 + static_cast<std::uint64_t>(at.y() + 1)) * 2048 +
           static_cast<std::uint64_t>(at.z() + 1);
  };
  ShadingMesh out;
  out.centre = mesh.centre;
  out.radius = mesh.radius;
  std::unordered_map<std::uint64_t, std::uint32_t> cluster_of_cell;
  std::vector<std::uint32_t> cluster(mesh.vertices.size());
  std::vector<float> members;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto [found, fresh] = cluster_of_cell.try_emplace(key(mesh.vertices[v].position),
                                                            static_cast<std::uint32_t>(out.vertices.size()));
    if (fresh) {
      out.vertices.push_back({Eigen::Vector3f::Zero(), mesh.vertices[v].normal});
      members.push_back(0.0F);
    }
    cluster[v] = found->second;
    out.vertices[found->second].position += mesh.vertices[v].position;
    members[found->second] += 1.0F;
  }
  for (std::size_t c = 0; c < members.size(); ++c) out.vertices[c].position /= members[c];
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const std::uint32_t a = cluster[mesh.indices[i]];
    const std::uint32_t b = cluster[mesh.indices[i + 1]];
    const std::uint32_t c = cluster[mesh.indices[i + 2]];
    if (a != b && b != c && c != a) out.indices.insert(out.indices.end(), {a, b, c});
  }
  return out;
}

}  // namespace icome::render
