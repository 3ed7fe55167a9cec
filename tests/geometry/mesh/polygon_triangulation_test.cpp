#include "geometry/mesh/polygon_triangulation.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace icome::geometry {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Polygon = std::vector<Vector3>;

/// Vector area by the shoelace rule: independent of any triangulation.
Vector3 polygon_area(const Polygon& polygon) {
  Vector3 area = Vector3::Zero();
  for (std::size_t i = 0; i < polygon.size(); ++i)
    area += polygon[i].cross(polygon[(i + 1) % polygon.size()]) / 2.0;
  return area;
}

/// Checks that the triangles wind like the polygon and cover its area, so that none lies outside.
void expect_exact_cover(const Polygon& polygon) {
  Triangles triangles;
  triangulate_polygon(polygon, triangles);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  const Vector3 whole = polygon_area(polygon);
  const Vector3 normal = whole.normalized();
  double absolute = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double area = (polygon[b] - polygon[a]).cross(polygon[c] - polygon[a]).dot(normal) / 2.0;
    EXPECT_GE(area, -1e-12);
    absolute += std::abs(area);
  }
  EXPECT_NEAR(absolute, whole.norm(), 1e-9 * whole.norm());
}

TEST(PolygonTriangulation, SquareInAnyPlane) {
  expect_exact_cover({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  expect_exact_cover({{0, 0, 0}, {0, 1, 0}, {1, 1, 0}, {1, 0, 0}});
  expect_exact_cover({{0, 0, 0}, {0, 1, 1}, {1, 1, 2}, {1, 0, 1}});
}

TEST(PolygonTriangulation, DartIsCutThroughItsReflexCorner) {
  Triangles triangles;
  triangulate_polygon(Polygon{{0, 0, 0}, {2, 1, 0}, {0, 2, 0}, {0.5, 1, 0}}, triangles);
  for (const auto& triangle : triangles)
    EXPECT_NE(std::find(triangle.begin(), triangle.end(), 3U), triangle.end());
}

TEST(PolygonTriangulation, CombOfManyTeeth) {
  Polygon comb{{40, -1, 0}};
  for (int i = 40; i >= 0; --i) comb.emplace_back(i, i % 2 == 0 ? 5.0 : 0.0, 0.0);
  comb.emplace_back(0, -1, 0);
  expect_exact_cover(comb);
}

TEST(PolygonTriangulation, HoleJoinedByABridge) {
  expect_exact_cover({{0, 0, 0},
                      {4, 0, 0},
                      {4, 4, 0},
                      {0, 4, 0},
                      {0, 0, 0},
                      {1, 1, 0},
                      {1, 3, 0},
                      {3, 3, 0},
                      {3, 1, 0},
                      {1, 1, 0}});
}

TEST(PolygonTriangulation, TwoHolesBridgedToOneCorner) {
  expect_exact_cover({{0, 0, 0},
                      {9, 0, 0},
                      {9, 9, 0},
                      {0, 9, 0},
                      {0, 0, 0},
                      {1, 4, 0},
                      {1, 5, 0},
                      {2, 5, 0},
                      {2, 4, 0},
                      {1, 4, 0},
                      {0, 0, 0},
                      {4, 1, 0},
                      {4, 2, 0},
                      {5, 2, 0},
                      {5, 1, 0},
                      {4, 1, 0}});
}

TEST(PolygonTriangulation, RandomStarsInTiltedPlanes) {
  base::Random random(11);
  for (int round = 0; round < 200; ++round) {
    const Vector3 u = random.direction();
    const Vector3 v = u.unitOrthogonal();
    Polygon star;
    const int corners = 4 + static_cast<int>(random.index(40));
    for (int i = 0; i < corners; ++i) {
      const double angle = 6.283185307179586 * i / corners;
      star.push_back(random.uniform(0.1, 1.0) * (std::cos(angle) * u + std::sin(angle) * v) +
                     Vector3(3, -2, 7));
    }
    expect_exact_cover(star);
  }
}

TEST(PolygonTriangulation, CornersOnALineAndCrossingsStillGiveEveryTriangle) {
  for (const Polygon& polygon :
       {Polygon{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
        Polygon{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}, Polygon(7, Vector3(1, 2, 3))}) {
    Triangles triangles;
    triangulate_polygon(polygon, triangles);
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
  }
}

}  // namespace
}  // namespace icome::geometry
