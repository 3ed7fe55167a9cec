#include "geometry/loop/loop_control.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "geometry/loop/loop_refine.h"
#include "geometry/loop/loop_topology.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

/// The key of an edge: its lower vertex, then its higher one.
std::uint64_t key_of_edge(std::uint32_t a, std::uint32_t b) {
  return std::uint64_t(std::min(a, b)) << 32U | std::max(a, b);
}

/// The halves of the creases; `first_new` is the number of the vertex on edge 0.
std::vector<std::array<std::uint32_t, 2>> crease_halves(const LoopTopology& topology,
                                                        const LoopRefinement& refinement,
                                                        std::uint32_t first_new) {
  std::vector<std::array<std::uint32_t, 2>> result;
  if (topology.creases.empty()) return result;
  std::unordered_map<std::uint64_t, std::uint32_t> middle;
  for (const auto& [a, b] : topology.creases) middle[key_of_edge(a, b)] = 0;
  for (std::size_t t = 0; t < topology.mesh.triangles.size(); ++t) {
    const TriangleMesh::Triangle& triangle = topology.mesh.triangles[t];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto found = middle.find(key_of_edge(triangle[i], triangle[(i + 1) % 3]));
      if (found != middle.end()) found->second = first_new + refinement.edge_of_side[t][i];
    }
  }
  for (const auto& [a, b] : topology.creases) {
    const std::uint32_t there = middle[key_of_edge(a, b)];
    result.push_back({a, there});
    result.push_back({there, b});
  }
  return result;
}

base::Result<ControlMesh> refine_once(const ControlMesh& control) {
  const auto topology = loop_topology(control);
  if (!topology) return tl::unexpected(topology.error());
  const auto refinement = loop_refine(topology->mesh, topology->creases, topology->corners);
  if (!refinement) return tl::unexpected(refinement.error());
  ControlMesh finer;
  finer.mesh.positions = refinement->vertices;
  const auto first_new = std::uint32_t(finer.mesh.positions.size());
  finer.mesh.positions.insert(finer.mesh.positions.end(), refinement->edges.begin(), refinement->edges.end());
  finer.mesh.triangles.reserve(4 * topology->mesh.triangles.size());
  for (std::size_t t = 0; t < topology->mesh.triangles.size(); ++t) {
    const auto& [a, b, c] = topology->mesh.triangles[t];
    std::array<std::uint32_t, 3> on = refinement->edge_of_side[t];
    for (std::uint32_t& vertex : on) vertex += first_new;
    finer.mesh.triangles.insert(
        finer.mesh.triangles.end(),
        {{a, on[0], on[2]}, {on[0], b, on[1]}, {on[2], on[1], c}, {on[0], on[1], on[2]}});
  }
  finer.creases = crease_halves(*topology, *refinement, first_new);
  finer.corners = topology->corners;
  return finer;
}

}  // namespace

base::Result<ControlMesh> refine_control(const ControlMesh& control, int steps) {
  std::size_t triangles = control.mesh.triangles.size();
  for (int step = 0; step < steps; ++step) {
    if (triangles > kMostRefined / 4) {
      return base::fail(fmt::format("{} steps make more than {} triangles of {}: ask for fewer", steps,
                                    kMostRefined, control.mesh.triangles.size()));
    }
    triangles *= 4;
  }
  ControlMesh finer = control;
  for (int step = 0; step < steps; ++step) {
    auto next = refine_once(finer);
    if (!next) return tl::unexpected(next.error());
    finer = std::move(*next);
  }
  const auto finite = [](const Vector3& position) { return position.allFinite(); };
  if (!std::ranges::all_of(finer.mesh.positions, finite))
    return base::fail("the control mesh is too large for numbers: scale it down first");
  return finer;
}

std::vector<std::array<std::uint32_t, 2>> bent_edges(const TriangleMesh& mesh, double angle) {
  std::vector<std::array<std::uint32_t, 2>> result;
  const EdgeNeighbours neighbours = edge_neighbours(mesh);
  const auto normal = [&](std::size_t t) {
    const Vector3 across =
        (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    return Vector3(across.stableNormalized());
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t other = neighbours[t][i];
      if (other == kNoTriangle || other < t) continue;
      const Vector3 one = normal(t), two = normal(other);
      if (one.isZero(0.0) || two.isZero(0.0)) continue;
      if (std::atan2(one.cross(two).norm(), one.dot(two)) > angle)
        result.push_back({mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]});
    }
  }
  return result;
}

}  // namespace icome::geometry
