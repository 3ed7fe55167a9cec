#include "geometry/sweep/self_crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"
#include "geometry/meshes.h"
#include "geometry/primitive/primitive.h"
#include "geometry/sweep/extrusion.h"

namespace icome::geometry {
namespace {

constexpr std::uint64_t kPlenty = 1'000'000;

std::optional<Vector3> crossing_of(const TriangleMesh& mesh) {
  const SelfCrossing crossing = find_self_crossing(mesh, kPlenty);
  EXPECT_TRUE(crossing.sought);
  return crossing.place;
}

TriangleMesh cube_at(const Vector3& middle, double half = 0.5) {
  TriangleMesh mesh = tessellate(Box{Vector3::Constant(half)}, 1e-3);
  for (Vector3& position : mesh.positions) position += middle;
  return mesh;
}

TEST(SelfCrossing, TellsTouchingFromGoingThroughByTheLastBit) {
  const double next = std::nextafter(1.0, 0.0);
  EXPECT_FALSE(crossing_of(cube_at({0, 0, 0})));
  EXPECT_FALSE(crossing_of(together(cube_at({0, 0, 0}), cube_at({1.0, 0.25, 0.125}))))
      << "flush, side by side";
  EXPECT_FALSE(crossing_of(together(cube_at({0, 0, 0}), cube_at({1.0, 1.0, 0.25})))) << "along an edge";
  EXPECT_FALSE(crossing_of(together(cube_at({0, 0, 0}), cube_at({1.0, 1.0, 1.0})))) << "in a corner";
  const auto place = crossing_of(together(cube_at({0, 0, 0}), cube_at({next, 0.25, 0.125})));
  ASSERT_TRUE(place);
  EXPECT_NEAR(place->x(), 0.5, 1e-9);
  EXPECT_TRUE(crossing_of(together(cube_at({0, 0, 0}), cube_at({next, next, next}))));
}

TEST(SelfCrossing, FindsWhatCrossesAllAlongSidesOfTriangles) {
  // All faces of one lie in planes of the other or run into its faces along an edge.
  EXPECT_TRUE(crossing_of(together(cube_at({0, 0, 0}), cube_at({0.5, 0.5, 0.0}))));
  EXPECT_TRUE(crossing_of(together(cube_at({0, 0, 0}), cube_at({0.5, 0.0, 0.0}))));
  // A roof whose ridge lies in the sheet that it goes through, of which no triangle is on both sides.
  TriangleMesh roof;
  roof.positions = {{-0.5, 0, 0}, {0.5, 0, 0}, {0, 0.5, 0.5}, {0, -0.5, -0.5},
                    {-2, -2, 0},  {2, -2, 0},  {0, 3, 0}};
  roof.triangles = {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}};
  EXPECT_TRUE(crossing_of(roof));
  roof.positions[3].z() = 0.5;  // both sides of it stand on the sheet
  EXPECT_FALSE(crossing_of(roof));
}

TEST(SelfCrossing, AgreesWithSamplesOfTwoTriangles) {
  base::Random random(7);
  int crossings = 0, apart = 0;
  for (int i = 0; i < 3000; ++i) {
    TriangleMesh mesh;
    for (int v = 0; v < 6; ++v) {
      Vector3 corner;
      for (double& coordinate : corner) coordinate = std::round(random.uniform(-3.4, 3.4));
      mesh.positions.push_back(corner);
    }
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    // Another algorithm: an edge of one goes through the middle of the other, by solving for where.
    const auto pierces = [&](int edge, int triangle, double margin) {
      const Vector3 &a = mesh.corner(std::size_t(triangle), 0), &b = mesh.corner(std::size_t(triangle), 1),
                    &c = mesh.corner(std::size_t(triangle), 2);
      const Vector3& from = mesh.corner(std::size_t(1 - triangle), edge);
      const Vector3 way = mesh.corner(std::size_t(1 - triangle), (edge + 1) % 3) - from;
      const Vector3 normal = (b - a).cross(c - a);
      const double climb = normal.dot(way);
      if (climb == 0.0) return false;
      const double share = normal.dot(a - from) / climb;
      const Vector3 at = from + share * way;
      const double area = normal.squaredNorm();
      const double u = (b - at).cross(c - at).dot(normal) / area,
                   v = (c - at).cross(a - at).dot(normal) / area;
      return std::min({share, 1.0 - share, u, v, 1.0 - u - v}) > margin;
    };
    const auto normal_of = [&](std::size_t t) -> Vector3 {
      return (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    };
    const auto area = [&](std::size_t t) { return normal_of(t).norm(); };
    const auto parallel = [&] { return normal_of(0).cross(normal_of(1)).isZero(0.0); };
    if (area(0) == 0.0 || area(1) == 0.0) continue;
    const auto any_pierces = [&](double margin) {
      bool any = false;
      for (int edge = 0; edge < 3; ++edge) any = any || pierces(edge, 0, margin) || pierces(edge, 1, margin);
      return any;
    };
    if (!any_pierces(-1e-9) && !parallel()) {
      ++apart;
      EXPECT_FALSE(crossing_of(mesh)) << i;
    }
    if (!any_pierces(1e-9)) continue;
    ++crossings;
    ASSERT_TRUE(crossing_of(mesh)) << i;
  }
  EXPECT_GT(crossings, 300);
  EXPECT_GT(apart, 300);
}

TEST(SelfCrossing, SpiralsGoThroughThemselvesWhereTheyClimbLessThanTheyAreThick) {
  const auto spiral = [](double climb) {
    const Profile profile{{{0.2, -0.05}, {0.3, -0.05}, {0.3, 0.05}, {0.2, 0.05}}};
    const SweepStep step{.angle = 0.1745329251994329577,
                         .axis = Vector3::UnitY(),
                         .translation = {0.0, climb / 36, 0.0},
                         .repeat = 60};
    const auto made = extrude(profile, std::vector{step});
    if (!made) throw std::runtime_error(made.error().message);
    return *made;
  };
  EXPECT_FALSE(crossing_of(spiral(0.12)));
  EXPECT_TRUE(crossing_of(spiral(0.08)));
}

TEST(SelfCrossing, SaysWhereItHasNotBeenSoughtToTheEnd) {
  const TriangleMesh both = together(cube_at({0, 0, 0}), cube_at({0.5, 0.3, 0.2}));
  EXPECT_FALSE(find_self_crossing(both, 3).sought);
  EXPECT_TRUE(find_self_crossing({}, 0).sought);
}

}  // namespace
}  // namespace icome::geometry
