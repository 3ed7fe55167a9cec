#include "geometry/mesh/weld.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

constexpr std::uint32_t kNoVertex = 0xffffffff;
constexpr double kCrackWidth = 0x1p-23;  // of the box's longest side

std::uint64_t position_hash(const Vector3& position) {
  std::uint64_t hash = 0;
  for (int axis = 0; axis < 3; ++axis) {
    // Adding +0 turns -0 into +0: they are equal and must hash alike.
    hash = (hash ^ std::bit_cast<std::uint64_t>(position[axis] + 0.0)) * 0x9e3779b97f4a7c15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

/// For each vertex the first one at exactly its position (itself when it is the first). An
/// open-addressing hash table: one probe a vertex on average. Empty when `lasts` returns false.
std::vector<std::uint32_t> first_at_position(const std::vector<Vector3>& positions,
                                             const std::function<bool()>& lasts) {
  constexpr std::uint32_t kVerticesForOneQuestion = 1U << 16U;
  std::vector<std::uint32_t> first(positions.size());
  const std::size_t mask = std::bit_ceil(2 * positions.size() + 1) - 1;
  std::vector<std::uint32_t> slots(mask + 1, kNoVertex);
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    if (v % kVerticesForOneQuestion == 0 && lasts && !lasts()) return {};
    first[v] = v;
    if (!positions[v].allFinite()) continue;
    std::size_t slot = position_hash(positions[v]) & mask;
    while (slots[slot] != kNoVertex && positions[slots[slot]] != positions[v]) slot = (slot + 1) & mask;
    if (slots[slot] == kNoVertex) slots[slot] = v;
    first[v] = slots[slot];
  }
  return first;
}

/// Makes the triangles use replacement[v] for v; returns the number of replaced vertices.
std::size_t replace_vertices(TriangleMesh& mesh, const std::vector<std::uint32_t>& replacement) {
  std::size_t replaced = 0;
  for (std::uint32_t v = 0; v < replacement.size(); ++v) replaced += replacement[v] != v;
  if (replaced == 0) return 0;
  for (TriangleMesh::Triangle& triangle : mesh.triangles)
    for (std::uint32_t& index : triangle) index = replacement[index];
  return replaced;
}

/// The vertices of boundary edges, in ascending order.
std::vector<std::uint32_t> boundary_vertices(const TriangleMesh& mesh) {
  const EdgeNeighbours neighbours = edge_neighbours(mesh);
  std::vector<bool> on_boundary(mesh.positions.size(), false);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int side = 0; side < 3; ++side)
      if (neighbours[t][side] == kNoTriangle)
        on_boundary[mesh.triangles[t][side]] = on_boundary[mesh.triangles[t][(side + 1) % 3]] = true;
  std::vector<std::uint32_t> vertices;
  for (std::uint32_t v = 0; v < on_boundary.size(); ++v)
    if (on_boundary[v]) vertices.push_back(v);
  return vertices;
}

/// Points kept in the cells of a sparse grid, none nearer to another than `reach`: a cell, four reaches
/// wide, holds few of them however many points are asked about.
class SparsePoints {
 public:
  SparsePoints(const std::vector<Vector3>& positions, const Bounds& box, double reach)
      : positions_(positions), origin_(box.min()), reach_(reach) {}

  /// A kept point within reach of vertex v; v itself, which is then kept, when there is none.
  std::uint32_t find_or_keep(std::uint32_t v) {
    const Vector3 margin = Vector3::Constant(reach_);
    const Cell low = cell(positions_[v] - margin);
    const Cell high = cell(positions_[v] + margin);
    for (std::uint64_t x = low[0]; x <= high[0]; ++x)
      for (std::uint64_t y = low[1]; y <= high[1]; ++y)
        for (std::uint64_t z = low[2]; z <= high[2]; ++z)
          if (const std::uint32_t near = find_in({x, y, z}, positions_[v]); near != kNoVertex) return near;
    cells_[key(cell(positions_[v]))].push_back(v);
    return v;
  }

 private:
  using Cell = std::array<std::uint64_t, 3>;

  /// With the reach at 2^-23 of the box, coordinates stay below 2^22.
  Cell cell(const Vector3& point) const {
    Cell result{};
    for (int axis = 0; axis < 3; ++axis)
      result[axis] = static_cast<std::uint64_t>(
          std::clamp((point[axis] - origin_[axis]) / (4.0 * reach_), 0.0, 0x1p21 - 1.0));
    return result;
  }

  static std::uint64_t key(const Cell& c) { return (c[0] << 42U) | (c[1] << 21U) | c[2]; }

  std::uint32_t find_in(const Cell& c, const Vector3& point) const {
    const auto found = cells_.find(key(c));
    if (found == cells_.end()) return kNoVertex;
    for (const std::uint32_t kept : found->second)
      if ((positions_[kept] - point).norm() <= reach_) return kept;
    return kNoVertex;
  }

  const std::vector<Vector3>& positions_;
  Vector3 origin_;
  double reach_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace

std::size_t weld_equal(TriangleMesh& mesh, const std::function<bool()>& lasts) {
  return replace_vertices(mesh, first_at_position(mesh.positions, lasts));
}

std::size_t weld_cracks(TriangleMesh& mesh) {
  const std::vector<std::uint32_t> vertices = boundary_vertices(mesh);
  Bounds box;
  for (const TriangleMesh::Triangle& triangle : mesh.triangles)
    for (const std::uint32_t v : triangle) box.extend(mesh.positions[v]);
  if (vertices.empty() || !(box.sizes().maxCoeff() > 0.0)) return 0;
  SparsePoints points(mesh.positions, box, kCrackWidth * box.sizes().maxCoeff());
  std::vector<std::uint32_t> replacement(mesh.positions.size());
  std::iota(replacement.begin(), replacement.end(), 0U);
  for (const std::uint32_t v : vertices) replacement[v] = points.find_or_keep(v);
  return replace_vertices(mesh, replacement);
}

}  // namespace icome::geometry
