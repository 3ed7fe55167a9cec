#include "geometry/mesh/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/random.h"
#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

TEST(MeshTopology, BoxIsClosedAndOrientable) {
  const MeshReport report = analyse_topology(unit_box()).report;
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.orientable);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0U);
}

TEST(MeshTopology, MissingTriangleOpensThreeEdges) {
  TriangleMesh mesh = unit_box();
  mesh.triangles.pop_back();
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.boundary_edges, 3U);
}

TEST(MeshTopology, TurnedTriangleDisagreesOverThreeEdges) {
  TriangleMesh mesh = unit_box();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_EQ(report.inconsistent_edges, 3U);
  EXPECT_TRUE(report.orientable);
}

TEST(MeshTopology, ThreeTrianglesOnOneEdgeAreNotManifold) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_EQ(topology.report.non_manifold_edges, 1U);
  EXPECT_EQ(topology.report.boundary_edges, 6U);
  EXPECT_EQ(topology.report.components, 1U);
  EXPECT_EQ(topology.neighbours[0][0], kNoTriangle);
}

TEST(MeshTopology, BoxesThatShareAnEdgeStayClosed) {
  TriangleMesh mesh = together(unit_box(), box_mesh({1, 1, 0}, {2, 2, 1}));
  // Vertices 3 and 7 of the first box stand where 8 + 0 and 8 + 4 of the second do.
  for (TriangleMesh::Triangle& t : mesh.triangles)
    for (std::uint32_t& v : t) v = v == 8 ? 3 : v == 12 ? 7 : v;
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_EQ(report.non_manifold_edges, 1U);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.components, 1U);
}

TEST(MeshTopology, MoebiusStripIsNotOrientableButARingIs) {
  EXPECT_FALSE(analyse_topology(ring(12, true)).report.orientable);
  EXPECT_TRUE(analyse_topology(ring(12, false)).report.orientable);
  EXPECT_EQ(analyse_topology(ring(12, true)).report.boundary_edges, 24U);
}

TEST(MeshTopology, EmptyMeshIsNotClosed) {
  const MeshReport report = analyse_topology(TriangleMesh{}).report;
  EXPECT_FALSE(report.closed);
  EXPECT_EQ(report.components, 0U);
}

TEST(MeshTopology, TriangleThatRepeatsAVertexHasNoEdges) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}};
  mesh.triangles = {{0, 0, 1}};
  const MeshTopology topology = analyse_topology(mesh);
  EXPECT_EQ(topology.report.boundary_edges, 0U);
  EXPECT_EQ(topology.neighbours[0][1], kNoTriangle);
}

/// The textbook way, with a map from vertex pairs to triangles.
std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges_by_map(
    const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      edges[{std::min(a, b), std::max(a, b)}].push_back(t);
    }
  return edges;
}

TEST(MeshTopology, RandomSoupAgreesWithAMapOfEdges) {
  base::Random random(7);
  TriangleMesh mesh;
  mesh.positions.assign(40, Vector3::Zero());
  while (mesh.triangles.size() < 200) {
    TriangleMesh::Triangle t;
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(random.index(40));
    if (std::set<std::uint32_t>(t.begin(), t.end()).size() == 3) mesh.triangles.push_back(t);
  }
  const auto edges = edges_by_map(mesh);
  const MeshTopology topology = analyse_topology(mesh);
  const auto edges_of = [&](auto wanted) {
    return static_cast<std::size_t>(
        std::ranges::count_if(edges, [&](const auto& edge) { return wanted(edge.second.size()); }));
  };
  EXPECT_EQ(topology.report.boundary_edges, edges_of([](std::size_t n) { return n == 1; }));
  EXPECT_EQ(topology.report.non_manifold_edges, edges_of([](std::size_t n) { return n > 2; }));
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = mesh.triangles[t][i], b = mesh.triangles[t][(i + 1) % 3];
      const std::vector<std::uint32_t>& users = edges.at({std::min(a, b), std::max(a, b)});
      const std::uint32_t expected = users.size() != 2 ? kNoTriangle : users[0] == t ? users[1] : users[0];
      EXPECT_EQ(topology.neighbours[t][i], expected);
    }
}

TEST(MeshTopology, PatchesEndAtNonManifoldEdges) {
  TriangleMesh mesh = together(unit_box(), box_mesh({5, 5, 5}, {6, 6, 6}));
  const Patches patches = find_patches(mesh, edge_neighbours(mesh));
  EXPECT_EQ(patches.count(), 2U);
  EXPECT_EQ(patches.patch_of_triangle[0], patches.patch_of_triangle[11]);
  EXPECT_NE(patches.patch_of_triangle[0], patches.patch_of_triangle[12]);
}

TEST(MeshTopology, MajorityKeepsItsWinding) {
  TriangleMesh mesh = unit_box();
  std::swap(mesh.triangles[0][0], mesh.triangles[0][1]);
  const Patches patches = find_patches(mesh, edge_neighbours(mesh));
  EXPECT_TRUE(patches.turn[0]);
  EXPECT_EQ(std::ranges::count(patches.turn, true), 1);
}

}  // namespace
}  // namespace icome::geometry
