#include "geometry/mesh/geodesic_sphere.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/closed_mesh.h"

namespace icome::geometry {
namespace geodesic_sphere_test {
namespace {

TEST(GeodesicSphere, CountsFollowTheFrequency) {
  for (const int frequency : {1, 2, 3, 4, 17, 82}) {
    const TriangleMesh mesh = bumpy_geodesic_sphere(frequency, 0.05, 0.02, 9);
    EXPECT_EQ(mesh.triangles.size(), 20u * frequency * frequency);
    EXPECT_EQ(mesh.positions.size(), 10u * frequency * frequency + 2);
  }
}

TEST(GeodesicSphere, IsClosedAndHasTheTopologyOfASphere) {
  for (const int frequency : {1, 2, 3, 4, 17, 82}) {
    const TriangleMesh mesh = bumpy_geodesic_sphere(frequency, 0.05, 0.02, 9);
    EXPECT_TRUE(is_closed(mesh)) << frequency;
    EXPECT_EQ(euler_characteristic(mesh), 2) << frequency;
  }
}

// Every triangle spans a positive volume with the centre: it faces out, and none is folded over.
TEST(GeodesicSphere, TrianglesFaceOut) {
  for (const int frequency : {1, 2, 3, 17, 82}) {
    const TriangleMesh mesh = bumpy_geodesic_sphere(frequency, 0.05, 0.02, 9);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      ASSERT_GT(mesh.corner(t, 0).dot(mesh.corner(t, 1).cross(mesh.corner(t, 2))), 0.0)
          << frequency << ' ' << t;
    }
  }
}

TEST(GeodesicSphere, VerticesLieOnTheBumpyRadius) {
  const double radius = 0.05, height = 0.1;
  const int bumps = 5;
  double highest = 0.0;
  for (const Vector3& vertex : bumpy_geodesic_sphere(23, radius, height, bumps).positions) {
    const Vector3 unit = vertex.normalized();
    const double bump =
        height * std::sin(bumps * unit.x()) * std::sin(bumps * unit.y()) * std::sin(bumps * unit.z());
    EXPECT_NEAR(vertex.norm(), radius * (1 + bump), 1e-16);
    highest = std::max(highest, bump);
  }
  EXPECT_GT(highest, 0.03);  // there are bumps
}

// An icosahedron of circumradius 1 has edges of 1 / sin(72 degrees).
TEST(GeodesicSphere, FrequencyOneIsTheIcosahedron) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(1, 1.0, 0.0, 0);
  const double edge = 1.0 / std::sin(2 * std::numbers::pi / 5);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR((mesh.corner(t, i) - mesh.corner(t, (i + 1) % 3)).norm(), edge, 1e-15);
    }
  }
}

// Triangles of the flat icosahedron grow where it bulges most: the spread is known to stay small, so a
// vertex with another's number would show.
TEST(GeodesicSphere, EdgesAreOfLikeLength) {
  const TriangleMesh mesh = bumpy_geodesic_sphere(40, 1.0, 0.0, 0);
  double shortest = 1.0, longest = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const double length = (mesh.corner(t, i) - mesh.corner(t, (i + 1) % 3)).norm();
      shortest = std::min(shortest, length);
      longest = std::max(longest, length);
    }
  }
  EXPECT_LT(longest / shortest, 2.0);
  EXPECT_NEAR(volume(mesh), 4.0 / 3 * std::numbers::pi, 0.01);
}

}  // namespace
}  // namespace geodesic_sphere_test
}  // namespace icome::geometry
