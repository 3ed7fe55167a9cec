#include "geometry/mesh/triangle_mesh.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/meshes.h"

namespace icome::geometry {
namespace {

TEST(TriangleMesh, BoundsEncloseEveryPositionAndAreEmptyWithoutAny) {
  const Bounds box = bounds(box_mesh({-1, 2, 3}, {4, 5, 6}));
  EXPECT_EQ(box.min(), Vector3(-1, 2, 3));
  EXPECT_EQ(box.max(), Vector3(4, 5, 6));
  EXPECT_TRUE(bounds(TriangleMesh{}).isEmpty());
}

TEST(TriangleMesh, VolumeIsSignedByTheSideThatFrontsFace) {
  EXPECT_DOUBLE_EQ(signed_volume(box_mesh({0, 0, 0}, {1, 2, 3})), 6.0);
  EXPECT_DOUBLE_EQ(signed_volume(turned(box_mesh({0, 0, 0}, {1, 2, 3}))), -6.0);
  EXPECT_EQ(signed_volume(TriangleMesh{}), 0.0);
}

TEST(TriangleMesh, VolumeOfASmallBoxFarAwayKeepsItsDigits) {
  const double far = 1e6;
  EXPECT_DOUBLE_EQ(signed_volume(box_mesh({far, far, far}, {far + 0.125, far + 0.125, far + 0.125})),
                   1.0 / 512.0);
}

TEST(TriangleMesh, AreaIsTheSumOfTheFaces) {
  EXPECT_DOUBLE_EQ(surface_area(box_mesh({0, 0, 0}, {1, 2, 3})), 2 * (2.0 + 3.0 + 6.0));
}

TEST(TriangleMesh, BoxCornersHaveDiagonalNormalsHoweverFacesAreCut) {
  // Each face gives a corner one right angle, in one triangle or two: weighting by angle sees the same.
  const TriangleMesh box = unit_box();
  const std::vector<Vector3> normals = vertex_normals(box);
  for (std::size_t v = 0; v < 8; ++v) {
    const Vector3 expected = (box.positions[v] - Vector3(0.5, 0.5, 0.5)).normalized();
    EXPECT_NEAR((normals[v] - expected).norm(), 0.0, 1e-15) << v;
  }
}

TEST(TriangleMesh, NormalsIgnoreFlatTrianglesAndAreZeroWithoutTriangles) {
  TriangleMesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}};
  const std::vector<Vector3> normals = vertex_normals(mesh);
  EXPECT_EQ(normals[0], Vector3(0, 0, 1));
  EXPECT_EQ(normals[3], Vector3(0, 0, 0));
  EXPECT_EQ(normals[4], Vector3(0, 0, 0));
}

}  // namespace
}  // namespace icome::geometry
