#include "geometry/mesh/mesh_topology.h"

#include <algorithm>
#include <cassert>
#include <numeric>
#include <span>

namespace icome::geometry {
namespace {

using Triangle = TriangleMesh::Triangle;

/// One triangle's use of an edge: the edge's higher vertex and 3 * triangle + corner.
struct EdgeUse {
  std::uint32_t high;
  std::uint32_t half_edge;
};

/// All uses, grouped by the edge's lower vertex: those of vertex v are uses[first[v]..first[v + 1]).
struct EdgeTable {
  std::vector<std::uint32_t> first;
  std::vector<EdgeUse> uses;
};

/// Visits the edges of one triangle; a triangle that names a vertex twice has none.
template <typename Visit>
void for_each_side(const Triangle& triangle, Visit visit) {
  if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[2] == triangle[0]) return;
  for (int corner = 0; corner < 3; ++corner) {
    const std::uint32_t from = triangle[corner];
    const std::uint32_t to = triangle[corner == 2 ? 0 : corner + 1];
    visit(corner, std::min(from, to), std::max(from, to));
  }
}

/// Sorts by higher vertex, then by half-edge, which is the order that the uses are already in where the
/// vertex is the same. Most vertices have three uses: an insertion sort beats std::sort twice over there.
void sort_uses(std::span<EdgeUse> uses) {
  constexpr std::size_t kFew = 16;
  const auto before = [](const EdgeUse& a, const EdgeUse& b) {
    return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
  };
  if (uses.size() > kFew) {
    std::ranges::sort(uses, before);
    return;
  }
  for (std::size_t i = 1; i < uses.size(); ++i) {
    const EdgeUse use = uses[i];
    std::size_t at = i;
    for (; at > 0 && before(use, uses[at - 1]); --at) uses[at] = uses[at - 1];
    uses[at] = use;
  }
}

/// A counting sort by lower vertex, then a comparison sort of the handful of uses at each vertex.
EdgeTable build_edge_table(const TriangleMesh& mesh) {
  assert(mesh.triangles.size() < kNoTriangle / 3);
  EdgeTable table;
  table.first.assign(mesh.positions.size() + 1, 0);
  for (const Triangle& triangle : mesh.triangles)
    for_each_side(triangle, [&](int, std::uint32_t low, std::uint32_t) { ++table.first[low + 1]; });
  std::partial_sum(table.first.begin(), table.first.end(), table.first.begin());
  table.uses.resize(table.first.back());
  std::vector<std::uint32_t> next(table.first.begin(), table.first.end() - 1);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for_each_side(mesh.triangles[t], [&](int corner, std::uint32_t low, std::uint32_t high) {
      table.uses[next[low]++] = {high, static_cast<std::uint32_t>(3 * t + corner)};
    });
  for (std::size_t v = 0; v + 1 < table.first.size(); ++v)
    sort_uses({table.uses.data() + table.first[v], table.uses.data() + table.first[v + 1]});
  return table;
}

/// Calls visit(uses of one edge) for every edge.
template <typename Visit>
void for_each_edge(const EdgeTable& table, Visit visit) {
  for (std::size_t v = 0; v + 1 < table.first.size(); ++v) {
    std::size_t begin = table.first[v];
    const std::size_t end = table.first[v + 1];
    while (begin < end) {
      std::size_t stop = begin + 1;
      while (stop < end && table.uses[stop].high == table.uses[begin].high) ++stop;
      visit(std::span<const EdgeUse>(table.uses.data() + begin, stop - begin));
      begin = stop;
    }
  }
}

std::uint32_t start_vertex(const TriangleMesh& mesh, std::uint32_t half_edge) {
  return mesh.triangles[half_edge / 3][half_edge % 3];
}

bool same_direction(const TriangleMesh& mesh, const EdgeUse& a, const EdgeUse& b) {
  return start_vertex(mesh, a.half_edge) == start_vertex(mesh, b.half_edge);
}

void link(EdgeNeighbours& neighbours, const EdgeUse& a, const EdgeUse& b) {
  neighbours[a.half_edge / 3][a.half_edge % 3] = b.half_edge / 3;
  neighbours[b.half_edge / 3][b.half_edge % 3] = a.half_edge / 3;
}

EdgeNeighbours link_neighbours(const TriangleMesh& mesh, const EdgeTable& table) {
  EdgeNeighbours neighbours(mesh.triangles.size(), {kNoTriangle, kNoTriangle, kNoTriangle});
  for_each_edge(table, [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 2) link(neighbours, uses[0], uses[1]);
  });
  return neighbours;
}

/// Sets of indices that are merged one pair at a time.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count), sets_(count) {
    std::iota(parent_.begin(), parent_.end(), 0U);
  }
  void merge(std::uint32_t a, std::uint32_t b) {
    a = root(a);
    b = root(b);
    if (a == b) return;
    parent_[std::max(a, b)] = std::min(a, b);
    --sets_;
  }
  std::size_t sets() const { return sets_; }

 private:
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  std::vector<std::uint32_t> parent_;
  std::size_t sets_;
};

MeshReport count_edges(const TriangleMesh& mesh, const EdgeTable& table) {
  MeshReport report;
  report.vertices = mesh.positions.size();
  report.triangles = mesh.triangles.size();
  report.closed = !table.uses.empty();
  for_each_edge(table, [&](std::span<const EdgeUse> uses) {
    if (uses.size() % 2 == 1) report.closed = false;
    if (uses.size() == 1) ++report.boundary_edges;
    if (uses.size() > 2) ++report.non_manifold_edges;
    if (uses.size() == 2 && same_direction(mesh, uses[0], uses[1])) ++report.inconsistent_edges;
  });
  return report;
}

/// Parts connected over edges of any kind: the patches, merged where they meet at non-manifold edges.
std::size_t count_components(const Patches& patches, const EdgeTable& table) {
  DisjointSets parts(patches.count());
  for_each_edge(table, [&](std::span<const EdgeUse> uses) {
    for (std::size_t i = 1; uses.size() > 2 && i < uses.size(); ++i)
      parts.merge(patches.patch_of_triangle[uses[0].half_edge / 3],
                  patches.patch_of_triangle[uses[i].half_edge / 3]);
  });
  return parts.sets();
}

/// Does `other` run along the edge from `from` to `to` in that same direction?
bool runs_along(const Triangle& other, std::uint32_t from, std::uint32_t to) {
  for (int corner = 0; corner < 3; ++corner)
    if (other[corner] == from && other[(corner + 1) % 3] == to) return true;
  return false;
}

/// Spreads over one patch from its first triangle, deciding for each triangle whether its winding is
/// to be turned to agree with that of the first.
class PatchFlood {
 public:
  PatchFlood(const TriangleMesh& mesh, const EdgeNeighbours& neighbours, Patches& patches)
      : mesh_(mesh), neighbours_(neighbours), patches_(patches) {}

  void run(std::uint32_t seed) {
    members_.clear();
    agrees_ = true;
    admit(seed, false);
    for (std::size_t i = 0; i < members_.size(); ++i) spread(members_[i]);
    settle();
  }

 private:
  void admit(std::uint32_t triangle, bool turned) {
    patches_.patch_of_triangle[triangle] = static_cast<std::uint32_t>(patches_.count());
    patches_.turn[triangle] = turned;
    members_.push_back(triangle);
  }

  void spread(std::uint32_t triangle) {
    const Triangle& corners = mesh_.triangles[triangle];
    for (int side = 0; side < 3; ++side) {
      const std::uint32_t other = neighbours_[triangle][side];
      if (other == kNoTriangle) continue;
      const bool differs = runs_along(mesh_.triangles[other], corners[side], corners[(side + 1) % 3]);
      const bool turned = patches_.turn[triangle] != differs;
      if (patches_.patch_of_triangle[other] == kNoTriangle)
        admit(other, turned);
      else if (patches_.turn[other] != turned)
        agrees_ = false;
    }
  }

  void settle() {
    std::size_t turned = 0;
    for (const std::uint32_t triangle : members_) turned += patches_.turn[triangle];
    const bool mostly_turned = 2 * turned > members_.size();
    for (const std::uint32_t triangle : members_)
      patches_.turn[triangle] = agrees_ && patches_.turn[triangle] != mostly_turned;
    patches_.orientable.push_back(agrees_);
  }

  const TriangleMesh& mesh_;
  const EdgeNeighbours& neighbours_;
  Patches& patches_;
  std::vector<std::uint32_t> members_;
  bool agrees_ = true;
};

}  // namespace

EdgeNeighbours edge_neighbours(const TriangleMesh& mesh) {
  return link_neighbours(mesh, build_edge_table(mesh));
}

Patches find_patches(const TriangleMesh& mesh, const EdgeNeighbours& neighbours) {
  assert(neighbours.size() == mesh.triangles.size());
  Patches patches;
  patches.patch_of_triangle.assign(mesh.triangles.size(), kNoTriangle);
  patches.turn.assign(mesh.triangles.size(), false);
  PatchFlood flood(mesh, neighbours, patches);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (patches.patch_of_triangle[t] == kNoTriangle) flood.run(t);
  return patches;
}

MeshTopology analyse_topology(const TriangleMesh& mesh) {
  const EdgeTable table = build_edge_table(mesh);
  MeshTopology topology{link_neighbours(mesh, table), count_edges(mesh, table)};
  const Patches patches = find_patches(mesh, topology.neighbours);
  topology.report.components = count_components(patches, table);
  topology.report.orientable = std::ranges::all_of(patches.orientable, [](bool yes) { return yes; });
  return topology;
}

}  // namespace icome::geometry
