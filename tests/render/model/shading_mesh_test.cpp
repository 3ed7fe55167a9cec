#include "render/model/shading_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace icome::render {
namespace {

using base::Vector3;
using geometry::TriangleMesh;

/// A cube of half side 1, outward.
TriangleMesh cube() {
  TriangleMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.emplace_back(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

TEST(MakeShadingMesh, SplitsACubesVerticesIntoOneForEachFace) {
  const ShadingMesh mesh = make_shading_mesh(cube(), 0.9);
  EXPECT_EQ(mesh.vertices.size(), 24U);
  EXPECT_EQ(mesh.indices.size(), 36U);
  // A face's normal has one component of size 1.
  for (const auto& vertex : mesh.vertices) EXPECT_NEAR(vertex.normal.cwiseAbs().maxCoeff(), 1.0F, 1e-6F);
}

TEST(MakeShadingMesh, SmoothsACubeTowardItsDiagonals) {
  const ShadingMesh mesh = make_shading_mesh(cube(), std::numbers::pi);
  ASSERT_EQ(mesh.vertices.size(), 8U);
  // Weighted by angle the three faces count alike, whatever their diagonals.
  for (const auto& vertex : mesh.vertices) {
    EXPECT_NEAR(vertex.normal.dot(vertex.position.normalized()), 1.0F, 1e-6F);
  }
}

TEST(MakeShadingMesh, GivesTheSameBuffersForTheSameShapeInAnyUnit) {
  const ShadingMesh one = make_shading_mesh(cube(), 0.9);
  TriangleMesh small = cube();
  for (Vector3& p : small.positions) p = 1e-150 * p;
  const ShadingMesh tiny = make_shading_mesh(small, 0.9);
  ASSERT_EQ(tiny.vertices.size(), one.vertices.size());
  for (std::size_t i = 0; i < one.vertices.size(); ++i) {
    EXPECT_TRUE(tiny.vertices[i].position.isApprox(one.vertices[i].position, 1e-5F));
    EXPECT_TRUE(tiny.vertices[i].normal.isApprox(one.vertices[i].normal, 1e-5F));
  }
}

TEST(MakeShadingMesh, LeavesOutWhatCannotBeDrawn) {
  TriangleMesh mesh = cube();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  mesh.positions.emplace_back(nan, 0.0, 0.0);
  mesh.triangles.push_back({0, 1, 8});   // not finite
  mesh.triangles.push_back({0, 1, 99});  // out of range
  mesh.triangles.push_back({0, 1, 1});   // without area
  const ShadingMesh drawn = make_shading_mesh(mesh, 0.9);
  EXPECT_EQ(drawn.indices.size(), 36U);
  for (const auto& vertex : drawn.vertices) {
    EXPECT_TRUE(vertex.position.allFinite());
    EXPECT_NEAR(vertex.normal.norm(), 1.0F, 1e-6F);
  }
}

TEST(MakeShadingMesh, IsEmptyForAnEmptyMesh) { EXPECT_TRUE(make_shading_mesh({}, 0.9).indices.empty()); }

/// A square of n x n cells in z = 0.
TriangleMesh grid(std::uint32_t n) {
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i) {
    for (std::uint32_t j = 0; j <= n; ++j) mesh.positions.emplace_back(i / double(n), j / double(n), 0.0);
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j;
      mesh.triangles.push_back({a, a + n + 1, a + 1});
      mesh.triangles.push_back({a + 1, a + n + 1, a + n + 2});
    }
  }
  return mesh;
}

TEST(Clustered, KeepsAFlatSheetFlatWithFarFewerTriangles) {
  const ShadingMesh fine = make_shading_mesh(grid(200), 0.9);
  const ShadingMesh coarse = clustered(fine, 1.0 / 16.0);
  EXPECT_LT(coarse.indices.size(), fine.indices.size() / 20);
  EXPECT_GT(coarse.indices.size(), 3U * 500U);
  double area = 0.0;
  for (std::size_t i = 0; i < coarse.indices.size(); i += 3) {
    const auto& a = coarse.vertices[coarse.indices[i]].position;
    const auto& b = coarse.vertices[coarse.indices[i + 1]].position;
    const auto& c = coarse.vertices[coarse.indices[i + 2]].position;
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  // The sheet has side sqrt(2) in the buffers' frame; it shrinks by half a cell all round.
  EXPECT_NEAR(area, 2.0, 0.25);
}

}  // namespace
}  // namespace icome::render
