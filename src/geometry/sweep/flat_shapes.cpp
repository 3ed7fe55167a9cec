#include "geometry/sweep/flat_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "geometry/mesh/polygon_triangulation.h"

namespace icome::geometry {
namespace {

base::Result<void> check_length(const char* name, double length) {
  if (length >= kSmallestProfile && length <= kLargestProfile) return {};
  return base::fail(
      fmt::format("{} is {:g} m; give {:g} to {:g} m", name, length, kSmallestProfile, kLargestProfile));
}

/// Twice the area of a triangle whose sides a >= b >= c are known to the last digit; 0 where they do not meet
/// (Kahan, Miscalculating Area and Angles of a Needle-like Triangle, 2014: the brackets matter).
double doubled_area_of(double a, double b, double c) {
  const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  return product > 0.0 ? 0.5 * std::sqrt(product) : 0.0;
}

std::vector<Vector3> corners_of(const Profile& polygon, double z) {
  std::vector<Vector3> corners;
  corners.reserve(polygon.points.size() + 1);
  for (const Vector2& point : polygon.points) corners.emplace_back(point.x(), point.y(), z);
  return corners;
}

/// Triangles from each edge of a polygon to one vertex.
void add_fan(std::uint32_t edges, std::uint32_t tip, std::vector<TriangleMesh::Triangle>& triangles) {
  for (std::uint32_t i = 0; i < edges; ++i) triangles.push_back({i, (i + 1) % edges, tip});
}

}  // namespace

base::Result<TriangleMesh> triangle_sheet(const std::array<double, 3>& sides) {
  for (const double side : sides) {
    if (const auto good = check_length("a side of the triangle", side); !good)
      return tl::unexpected(good.error());
  }
  std::array<double, 3> by_length = sides;
  std::sort(by_length.rbegin(), by_length.rend());
  const double doubled_area = doubled_area_of(by_length[0], by_length[1], by_length[2]);
  if (!(doubled_area > kSweepTolerance * by_length[0] * by_length[0]))
    return base::fail(
        fmt::format("sides of {:g}, {:g} and {:g} m meet in no triangle; each must be shorter than the other "
                    "two together",
                    sides[0], sides[1], sides[2]));
  const auto [a, b, c] = sides;
  // (a^2 + c^2 - b^2) / (2 a), without squares that cancel out.
  const double x = 0.5 * (a + (c - b) * ((c + b) / a));
  TriangleMesh sheet{{{0, 0, 0}, {a, 0, 0}, {x, doubled_area / a, 0}}, {{0, 1, 2}}};
  const Vector3 centroid = (sheet.positions[0] + sheet.positions[1] + sheet.positions[2]) / 3.0;
  for (Vector3& position : sheet.positions) position -= centroid;
  return sheet;
}

base::Result<TriangleMesh> rectangle_sheet(double along_x, double along_y) {
  for (const double side : {along_x, along_y}) {
    if (const auto good = check_length("a side of the rectangle", side); !good)
      return tl::unexpected(good.error());
  }
  const double x = 0.5 * along_x, y = 0.5 * along_y;
  return TriangleMesh{{{-x, -y, 0}, {x, -y, 0}, {x, y, 0}, {-x, y, 0}}, {{0, 1, 2}, {0, 2, 3}}};
}

base::Result<TriangleMesh> polygon_sheet(int sides, double radius) {
  const auto polygon = regular_polygon(sides, radius);
  if (!polygon) return tl::unexpected(polygon.error());
  TriangleMesh sheet{corners_of(*polygon, 0.0), {}};
  triangulate_polygon(sheet.positions, sheet.triangles);
  return sheet;
}

base::Result<TriangleMesh> circle_sheet(double radius, int segments) {
  const auto polygon = regular_polygon(segments, radius);
  if (!polygon) return tl::unexpected(polygon.error());
  TriangleMesh sheet{corners_of(*polygon, 0.0), {}};
  sheet.positions.emplace_back(Vector3::Zero());
  add_fan(std::uint32_t(segments), std::uint32_t(segments), sheet.triangles);
  return sheet;
}

base::Result<TriangleMesh> pyramid(int sides, double base_radius, double height) {
  if (const auto good = check_length("the height of the pyramid", height); !good)
    return tl::unexpected(good.error());
  const auto polygon = regular_polygon(sides, base_radius);
  if (!polygon) return tl::unexpected(polygon.error());
  TriangleMesh solid{corners_of(*polygon, -0.5 * height), {}};
  triangulate_polygon(solid.positions, solid.triangles);
  for (auto& [a, b, c] : solid.triangles) std::swap(b, c);  // the base is seen from below
  solid.positions.emplace_back(0.0, 0.0, 0.5 * height);
  add_fan(std::uint32_t(sides), std::uint32_t(sides), solid.triangles);
  return solid;
}

double radius_of_polygon(int sides, double side) { return 0.5 * side / std::sin(std::numbers::pi / sides); }

}  // namespace icome::geometry
