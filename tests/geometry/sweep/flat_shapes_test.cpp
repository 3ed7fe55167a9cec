#include "geometry/sweep/flat_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh/mesh_topology.h"
#include "geometry/mesh/polygon_triangulation.h"

namespace icome::geometry {
namespace {

using std::numbers::pi;
const std::array<double, 6> kNoLengths{
    0.0, -1.0, 1e-10, 1e7, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()};

/// One layer in z = 0 that faces +z, all of whose vertices are used.
void expect_sheet(const TriangleMesh& sheet, double area, std::size_t rim) {
  EXPECT_NEAR(surface_area(sheet), area, 1e-13 * area);
  double seen = 0.0;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const Vector3 across =
        (sheet.corner(t, 1) - sheet.corner(t, 0)).cross(sheet.corner(t, 2) - sheet.corner(t, 0));
    EXPECT_GT(across.z(), 0.0);
    seen += 0.5 * across.z();
  }
  EXPECT_NEAR(seen, area, 1e-13 * area);
  for (const Vector3& position : sheet.positions) EXPECT_EQ(position.z(), 0.0);
  const MeshReport report = analyse_topology(sheet).report;
  EXPECT_EQ(report.boundary_edges, rim);
  EXPECT_EQ(report.inconsistent_edges, 0U);
}

template <typename Made>
void expect_refused(const Made& made, const std::string& why) {
  ASSERT_FALSE(made) << why;
  EXPECT_NE(made.error().message.find(why), std::string::npos) << made.error().message;
}

TEST(FlatShapes, TrianglesHaveTheirSides) {
  const auto right = triangle_sheet({4.0, 5.0, 3.0});
  ASSERT_TRUE(right) << right.error().message;
  expect_sheet(*right, 6.0, 3);
  EXPECT_TRUE(right->positions[0].isApprox(Vector3(-4.0 / 3.0, -1.0, 0.0), 1e-15));
  const auto equilateral = triangle_sheet({0.1, 0.1, 0.1});
  ASSERT_TRUE(equilateral);
  expect_sheet(*equilateral, 0.01 * std::sqrt(3.0) / 4.0, 3);
  for (const Vector3& corner : equilateral->positions)
    EXPECT_NEAR(corner.norm(), radius_of_polygon(3, 0.1), 1e-16);
  base::Random random(8);
  for (int round = 0; round < 200; ++round) {
    const double a = random.uniform(0.1, 2.0), b = random.uniform(0.1, 2.0);
    const double c = random.uniform(std::abs(a - b) * 1.001 + 1e-6, (a + b) * 0.999);
    const auto sheet = triangle_sheet({a, b, c});
    ASSERT_TRUE(sheet) << sheet.error().message;
    EXPECT_NEAR((sheet->corner(0, 1) - sheet->corner(0, 0)).norm(), a, 1e-12);
    EXPECT_NEAR((sheet->corner(0, 2) - sheet->corner(0, 1)).norm(), b, 1e-12);
    EXPECT_NEAR((sheet->corner(0, 0) - sheet->corner(0, 2)).norm(), c, 1e-12);
    EXPECT_LT((sheet->corner(0, 0) + sheet->corner(0, 1) + sheet->corner(0, 2)).norm(), 1e-14);
  }
}

TEST(FlatShapes, TrianglesWhoseSidesDoNotMeetAreRefused) {
  for (const auto& sides : {std::array{1.0, 1.0, 2.0}, std::array{1.0, 3.0, 1.0}, std::array{9.0, 1.0, 1.0},
                            std::array{1e6, 1e-9, 1e-9}})
    expect_refused(triangle_sheet(sides), "meet in no triangle");
  const auto needle = triangle_sheet({1.0, 1.0, 1e-9});
  ASSERT_TRUE(needle);
  expect_sheet(*needle, 0.5e-9, 3);
  for (const double length : kNoLengths) {
    expect_refused(triangle_sheet({1.0, length, 1.0}), "a side of the triangle");
    expect_refused(triangle_sheet({1.0, 1.0, length}), "a side of the triangle");
  }
}

TEST(FlatShapes, RectanglesAreCentred) {
  const auto sheet = rectangle_sheet(0.3, 0.2);
  ASSERT_TRUE(sheet);
  expect_sheet(*sheet, 0.06, 4);
  EXPECT_EQ(bounds(*sheet).min(), Vector3(-0.15, -0.1, 0.0));
  EXPECT_EQ(bounds(*sheet).max(), Vector3(0.15, 0.1, 0.0));
  for (const double length : kNoLengths) {
    expect_refused(rectangle_sheet(length, 1.0), "a side of the rectangle");
    expect_refused(rectangle_sheet(1.0, length), "a side of the rectangle");
  }
}

TEST(FlatShapes, PolygonsAndCirclesHaveTheAreaOfTheirTriangles) {
  for (const int sides : {3, 4, 5, 8, 17, 360}) {
    const double area = sides * 0.5 * 4.0 * std::sin(2.0 * pi / sides);
    const auto polygon = polygon_sheet(sides, 2.0);
    const auto circle = circle_sheet(2.0, sides);
    ASSERT_TRUE(polygon && circle);
    expect_sheet(*polygon, area, std::size_t(sides));
    expect_sheet(*circle, area, std::size_t(sides));
    EXPECT_EQ(polygon->triangles.size(), std::size_t(sides - 2));
    EXPECT_EQ(circle->triangles.size(), std::size_t(sides));
    EXPECT_NEAR((polygon->positions[0] - polygon->positions[1]).norm(), 4.0 * std::sin(pi / sides), 1e-14);
    EXPECT_NEAR(radius_of_polygon(sides, (polygon->positions[0] - polygon->positions[1]).norm()), 2.0, 1e-11);
  }
  EXPECT_NEAR(surface_area(*circle_sheet(1.0, 20'000)), pi, 1e-7);
}

TEST(FlatShapes, PyramidsAreClosedAndFaceOut) {
  for (const int sides : {3, 4, 6, 33}) {
    const double radius = 0.4, height = 0.7;
    const auto solid = pyramid(sides, radius, height);
    ASSERT_TRUE(solid);
    EXPECT_TRUE(is_closed(*solid));
    EXPECT_EQ(euler_characteristic(*solid), 2);
    EXPECT_EQ(solid->positions.size(), std::size_t(sides + 1));
    const double base = sides * 0.5 * radius * radius * std::sin(2.0 * pi / sides);
    EXPECT_NEAR(volume(*solid), base * height / 3.0, 1e-15);
    const double edge = 2.0 * radius * std::sin(pi / sides);
    const double slant = std::hypot(height, radius * std::cos(pi / sides));
    EXPECT_NEAR(surface_area(*solid), base + sides * 0.5 * edge * slant, 1e-14);
    EXPECT_EQ(bounds(*solid).min().z(), -0.35);
    EXPECT_EQ(bounds(*solid).max().z(), 0.35);
  }
  // The tetrahedron of equal edges.
  const auto solid = pyramid(3, radius_of_polygon(3, 1.0), std::sqrt(2.0 / 3.0));
  ASSERT_TRUE(solid);
  EXPECT_NEAR(volume(*solid), 1.0 / (6.0 * std::sqrt(2.0)), 1e-15);
  EXPECT_NEAR(surface_area(*solid), std::sqrt(3.0), 1e-15);
}

TEST(FlatShapes, RefuseCornersAndLengthsThatAreNone) {
  for (const int sides : {-1, 0, 2, std::numeric_limits<int>::min(), std::numeric_limits<int>::max(),
                          int(kMaximumPolygonCorners) + 1}) {
    expect_refused(polygon_sheet(sides, 1.0), "corners");
    expect_refused(circle_sheet(1.0, sides), "corners");
    expect_refused(pyramid(sides, 1.0, 1.0), "corners");
  }
  for (const double length : kNoLengths) {
    expect_refused(polygon_sheet(5, length), "radius");
    expect_refused(circle_sheet(length, 5), "radius");
    expect_refused(pyramid(5, length, 1.0), "radius");
    expect_refused(pyramid(5, 1.0, length), "the height of the pyramid");
  }
}

}  // namespace
}  // namespace icome::geometry
