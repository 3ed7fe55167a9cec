#include "geometry/contour/dual_contouring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "base/random.h"
#include "geometry/analytic_solids.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh/mesh_topology.h"
#include "repeats.h"

namespace icome::geometry {
namespace {

using base::Random;
using std::numbers::pi;

/// Around every vertex one fan: the triangles there are connected over edges at the vertex.
bool one_fan_each(const TriangleMesh& mesh) {
  std::vector<std::map<std::uint32_t, std::uint32_t>> next(mesh.positions.size());
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) next[triangle[i]][triangle[(i + 1) % 3]] = triangle[(i + 2) % 3];
  }
  return std::all_of(next.begin(), next.end(), [](const auto& fan) {
    if (fan.empty()) return false;
    std::size_t steps = 0;
    auto at = fan.begin();
    do {
      at = fan.find(at->second);
      ++steps;
    } while (at != fan.end() && at != fan.begin() && steps <= fan.size());
    return steps == fan.size();
  });
}

/// The least of the triangles' heights, each as a part of its longest edge.
double thinnest(const TriangleMesh& mesh) {
  double least = HUGE_VAL;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 a = mesh.corner(i, 1) - mesh.corner(i, 0), b = mesh.corner(i, 2) - mesh.corner(i, 0);
    const double longest = std::max({a.squaredNorm(), b.squaredNorm(), (a - b).squaredNorm()});
    least = std::min(least, a.cross(b).norm() / longest);
  }
  return least;
}

void expect_sound(const TriangleMesh& mesh) {
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.boundary_edges, 0u);
  EXPECT_EQ(report.non_manifold_edges, 0u);
  EXPECT_EQ(report.inconsistent_edges, 0u);
  EXPECT_TRUE(is_closed(mesh));
  EXPECT_TRUE(one_fan_each(mesh));
  EXPECT_GT(thinnest(mesh), 1e-7);
  EXPECT_GT(signed_volume(mesh), 0.0);
}

ContourMesh meshed(const SampledSolid& solid, double cell) {
  auto result = contour(solid, {.cell = cell});
  EXPECT_TRUE(result.has_value()) << (result ? "" : result.error().message);
  return result ? std::move(*result) : ContourMesh{};
}

ContourMesh meshed(const AnalyticSolid& solid, const Bounds& bounds, double cell) {
  ContourMesh made = meshed(solid.sampled(bounds), cell);
  expect_sound(made.mesh);
  return made;
}

double nearest_vertex(const TriangleMesh& mesh, const Vector3& point) {
  double nearest = HUGE_VAL;
  for (const Vector3& position : mesh.positions) nearest = std::min(nearest, (position - point).norm());
  return nearest;
}

TEST(DualContouring, SphereIsRoundAndItsErrorFallsWithTheSquareOfTheCell) {
  AnalyticSolid ball;
  ball.add(Sphere{1.0});
  double last = 0.0;
  for (const double cell : {0.2, 0.1, 0.05}) {
    const ContourMesh made = meshed(ball, cube_around_origin(1.0), cell);
    EXPECT_EQ(euler_characteristic(made.mesh), 2);
    // Of inscribed triangles with edges of up to sqrt(3) cells.
    EXPECT_LT(made.error, cell * cell / 2);
    EXPECT_GT(made.error, cell * cell / 20);
    EXPECT_NEAR(signed_volume(made.mesh) / (4 * pi / 3), 1.0, cell * cell);
    for (const Vector3& position : made.mesh.positions) EXPECT_NEAR(position.norm(), 1.0, 1e-9);
    if (last > 0) {
      EXPECT_LT(made.error, last / 2.5);
    }
    last = made.error;
  }
}

TEST(DualContouring, BoxIsReproduced) {
  const Vector3 half(0.5, 0.4, 0.3);
  AnalyticSolid box;
  box.add(Box{half});
  for (const double cell : {0.29, 0.1, 0.04}) {  // 0.1 divides every side
    const ContourMesh made = meshed(box, Bounds(-half, half), cell);
    EXPECT_LT(made.error, 1e-12);
    EXPECT_NEAR(signed_volume(made.mesh), 8 * half.prod(), 1e-9);
    EXPECT_NEAR(surface_area(made.mesh), 8 * (0.5 * 0.4 + 0.4 * 0.3 + 0.3 * 0.5), 1e-9);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      EXPECT_LT(nearest_vertex(made.mesh, half.cwiseProduct(sign)), 1e-9);
    }
  }
}

TEST(DualContouring, TurnedBoxKeepsItsEdges) {
  const Vector3 half(0.5, 0.4, 0.3);
  Random random(5);
  int exact = 0;
  for (int i = 0; i < repeats(20); ++i) {
    const Pose pose = pose_turned(random.uniform(0.1, 3), random.direction());
    AnalyticSolid box;
    box.add(Box{half}, pose);
    const double cell = 0.05;
    const ContourMesh made = meshed(box, cube_around_origin(0.75), cell);
    EXPECT_EQ(euler_characteristic(made.mesh), 2);
    // A chamfered edge would lose some 0.1 cell^2 along all 9.6 m of edges: 0.5 % of the volume.
    EXPECT_NEAR(signed_volume(made.mesh) / (8 * half.prod()), 1.0, 6e-4);
    EXPECT_LT(made.error, 0.5 * cell);
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      const double off = nearest_vertex(made.mesh, pose * half.cwiseProduct(sign));
      EXPECT_LT(off, cell);
      exact += off < 1e-9;
    }
  }
  EXPECT_GE(exact, kSanitizerShare > 1 ? 4 : 120);  // of 8 for each
}

TEST(DualContouring, CurvedEdgesAreMetExactly) {
  AnalyticSolid rod;
  rod.add(Cylinder{0.4, 0.8});
  const double cell = 0.1;
  const ContourMesh made = meshed(rod, Bounds(Vector3(-.4, -.4, -.4), Vector3(.4, .4, .4)), cell);
  int on_rim = 0;
  for (const Vector3& position : made.mesh.positions) {
    const double radial = std::hypot(position.x(), position.y()) - 0.4, axial = std::abs(position.z()) - 0.4;
    EXPECT_LT(std::max(radial, axial), 1e-4 * cell);
    on_rim += std::abs(radial) < 1e-4 * cell && std::abs(axial) < 1e-4 * cell;
  }
  EXPECT_GT(on_rim, 2 * 24);  // two rims of 25 cells' length each
  EXPECT_NEAR(signed_volume(made.mesh) / (pi * 0.16 * 0.8), 1.0, 0.02);
}

TEST(DualContouring, BoxWithoutBallHasTheRightVolume) {
  // A ball of radius r with its centre at the middle of a face: half of it is missing.
  AnalyticSolid solid;
  solid.add(Box{{0.5, 0.5, 0.5}}).cut(Sphere{0.3}, pose_at(0, 0, 0.5));
  const double volume = 1.0 - 2 * pi / 3 * 0.027;
  for (const double cell : {0.1, 0.05}) {
    const ContourMesh made = meshed(solid, cube_around_origin(0.5), cell);
    EXPECT_EQ(euler_characteristic(made.mesh), 2);
    EXPECT_NEAR(signed_volume(made.mesh) / volume, 1.0, cell * cell);
    for (const Vector3& position : made.mesh.positions)
      EXPECT_LT(solid.off_primitives(position), 1e-4 * cell);
  }
}

TEST(DualContouring, TorusHasItsHole) {
  AnalyticSolid ring;
  ring.add(Torus{1.0, 0.3});
  const ContourMesh made = meshed(ring, Bounds(Vector3(-1.3, -1.3, -0.3), Vector3(1.3, 1.3, 0.3)), 0.08);
  EXPECT_EQ(euler_characteristic(made.mesh), 0);
  EXPECT_NEAR(signed_volume(made.mesh) / (2 * pi * pi * 0.09), 1.0, 0.02);
}

TEST(DualContouring, BallsThatTouchOrNearlyTouchStayManifold) {
  for (const double gap : {-0.01, 0.0, 1e-9, 0.03}) {
    for (const double cell : {0.1, 0.06}) {
      const double x = 0.5 + gap / 2;
      AnalyticSolid pair;
      const Pose turn = pose_turned(0.7, {1, 2, 3});
      pair.add(Sphere{0.5}, turn * pose_at(-x, 0, 0)).add(Sphere{0.5}, turn * pose_at(x, 0, 0));
      const ContourMesh made = meshed(pair, cube_around_origin(1.1), cell);
      EXPECT_NEAR(signed_volume(made.mesh) / (pi / 3), 1.0, 3 * cell * cell + 0.01);
      EXPECT_LT(made.error, 0.5 * cell);
    }
  }
}

TEST(DualContouring, ThinPlateSurvives) {
  AnalyticSolid plate;
  plate.add(Box{{0.5, 0.5, 0.075}});
  const ContourMesh flat = meshed(plate, Bounds(Vector3(-.5, -.5, -.075), Vector3(.5, .5, .075)), 0.1);
  EXPECT_EQ(euler_characteristic(flat.mesh), 2);
  EXPECT_NEAR(signed_volume(flat.mesh), 0.15, 1e-9);

  Random random(11);
  for (int i = 0; i < 10; ++i) {
    AnalyticSolid tilted;
    tilted.add(Box{{0.5, 0.5, 0.075}}, pose_turned(random.uniform(0, 3), random.direction()));
    const ContourMesh made = meshed(tilted, cube_around_origin(0.75), 0.1);
    EXPECT_NEAR(signed_volume(made.mesh) / 0.15, 1.0, 0.03);
  }
}

/// Balls and boxes at random, some cut away, at a resolution too coarse for them.
AnalyticSolid blobs(Random& random) {
  AnalyticSolid solid;
  const auto parts = 2 + random.index(6);
  for (std::uint64_t i = 0; i < parts; ++i) {
    const Vector3 at = 0.7 * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const Pose pose = pose_at(at.x(), at.y(), at.z()) * pose_turned(random.uniform(0, 3), random.direction());
    const auto how = i > 0 && random.index(3) == 0 ? AnalyticSolid::Join::Cut : AnalyticSolid::Join::Add;
    if (random.index(2) == 0) {
      solid.join(how, Sphere{random.uniform(0.05, 0.5)}, pose);
    } else {
      solid.join(how, Box{{random.uniform(0.05, 0.3), random.uniform(0.05, 0.3), random.uniform(0.05, 0.3)}},
                 pose);
    }
  }
  return solid;
}

TEST(DualContouring, RandomBlobsAreClosedManifolds) {
  Random random(1);
  for (int i = 0; i < repeats(100); ++i) {
    SCOPED_TRACE(i);
    const AnalyticSolid solid = blobs(random);
    const ContourMesh made = meshed(solid.sampled(cube_around_origin(1.3)), random.uniform(0.2, 0.4));
    if (!made.mesh.triangles.empty()) expect_sound(made.mesh);
    if (HasFailure()) return;
  }
}

TEST(DualContouring, SpecksAroundOnePointFaceOut) {
  Random random(2);
  int specks = 0;
  for (int i = 0; i < 500; ++i) {
    // Thinner than a cell, so that most meshes enclose a single point of the grid, if any.
    const Vector3 half(random.uniform(0.05, 0.5), random.uniform(0.05, 0.5), random.uniform(0.01, 0.2));
    AnalyticSolid blade;
    blade.add(Box{half}, pose_turned(random.uniform(0, 3), random.direction()));
    const ContourMesh made = meshed(blade.sampled(cube_around_origin(0.8)), 0.6);
    if (made.mesh.triangles.size() != 12) continue;
    ++specks;
    expect_sound(made.mesh);
  }
  EXPECT_GT(specks, 50);
}

TEST(DualContouring, RandomSignsAreClosedManifolds) {
  // No geometry at all: every grid point is inside or outside by a throw of dice, so that every kind of cell
  // occurs beside every other.
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    const auto inside = [seed](const Vector3& point) {
      const Vector3 tile = (point.array() * 1.0).floor();
      const auto mixed = static_cast<std::uint64_t>(static_cast<std::int64_t>(tile.x() * 73856093) ^
                                                    static_cast<std::int64_t>(tile.y() * 19349663) ^
                                                    static_cast<std::int64_t>(tile.z() * 83492791));
      return Random(mixed * 31 + seed).index(100) < 35 + seed;
    };
    const auto crossing = [&](const Vector3& a, const Vector3& b) {
      return SurfacePoint{(a + b) / 2, (b - a).normalized()};
    };
    const ContourMesh made = meshed({cube_around_origin(4), inside, crossing}, 1.0);
    ASSERT_GT(made.mesh.triangles.size(), 500u);
    expect_sound(made.mesh);
    if (HasFailure()) return;
  }
}

TEST(DualContouring, SolidsThatReachTheirBoundsOrBeyondAreClosed) {
  AnalyticSolid ball;
  ball.add(Sphere{1.0});
  const ContourMesh cut_off = meshed(ball, cube_around_origin(0.6), 0.1);
  EXPECT_EQ(euler_characteristic(cut_off.mesh), 2);
  const SampledSolid everything{cube_around_origin(1), [](const Vector3&) { return true; },
                                [](const Vector3& a, const Vector3& b) {
                                  return SurfacePoint{(a + b) / 2, Vector3::Zero()};
                                }};
  expect_sound(meshed(everything, 0.7).mesh);
}

TEST(DualContouring, AnswersThatAreNoNumbersLeaveASoundMesh) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {nan, HUGE_VAL, 1e300}) {
    const SampledSolid solid{cube_around_origin(1), [](const Vector3& point) { return point.norm() <= 1.0; },
                             [bad](const Vector3&, const Vector3&) {
                               return SurfacePoint{Vector3::Constant(bad), Vector3::Constant(bad)};
                             }};
    const ContourMesh made = meshed(solid, 0.2);
    expect_sound(made.mesh);
    EXPECT_NEAR(signed_volume(made.mesh) / (4 * pi / 3), 1.0, 0.1);
  }
}

TEST(DualContouring, SameSolidInAnotherUnitGivesTheSameMesh) {
  AnalyticSolid one, other;
  const double scale = 1024.0;  // a power of two, so that even the rounding is the same
  const Pose turn = pose_turned(0.4, {1, 1, 2});
  one.add(Box{{0.5, 0.4, 0.3}}, turn).cut(Sphere{0.35}, pose_at(0.3, 0.1, 0));
  other.add(Box{{0.5 * scale, 0.4 * scale, 0.3 * scale}}, turn)
      .cut(Sphere{0.35 * scale}, pose_at(0.3 * scale, 0.1 * scale, 0));
  const ContourMesh small = meshed(one, cube_around_origin(0.75), 0.06);
  const ContourMesh large = meshed(other, cube_around_origin(0.75 * scale), 0.06 * scale);
  ASSERT_EQ(small.mesh.triangles, large.mesh.triangles);
  EXPECT_NEAR(large.error, small.error * scale, 1e-9 * large.error);
  for (std::size_t i = 0; i < small.mesh.positions.size(); ++i) {
    EXPECT_LT((small.mesh.positions[i] * scale - large.mesh.positions[i]).norm(), 1e-9 * scale);
  }
}

TEST(DualContouring, BlocksWithoutSurfaceMakeNoDifference) {
  AnalyticSolid ball;
  ball.add(Sphere{1.0}, pose_at(0.1, 0.2, 0.3));
  const Bounds bounds(Vector3(-0.9, -0.8, -0.7), Vector3(4.1, 4.2, 4.3));
  std::atomic<int> asked = 0;
  SampledSolid solid = ball.sampled(bounds);
  solid.inside = [&](const Vector3& point) {
    ++asked;
    return ball.inside(point);
  };
  const ContourMesh all = meshed(solid, 0.05);
  const int without = asked.exchange(0);
  solid.may_cross = [](const Bounds& box) {
    const Vector3 centre(0.1, 0.2, 0.3);
    const double far = (box.center() - centre).cwiseAbs().cwiseMax(0).norm() + box.diagonal().norm() / 2;
    return box.squaredExteriorDistance(centre) <= 1.0 && far >= 1.0;
  };
  const ContourMesh some = meshed(solid, 0.05);
  EXPECT_EQ(all.mesh.triangles, some.mesh.triangles);
  EXPECT_EQ(all.mesh.positions, some.mesh.positions);
  EXPECT_LT(asked, without / 2);
}

TEST(DualContouring, EmptySolidsGiveEmptyMeshes) {
  const auto nothing = [](const Vector3&) { return false; };
  const auto crossing = [](const Vector3& a, const Vector3&) { return SurfacePoint{a, Vector3::UnitX()}; };
  for (const Bounds& bounds : {Bounds(), cube_around_origin(1), cube_around_origin(0)}) {
    const auto made = contour({bounds, nothing, crossing}, {.cell = 0.1});
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_TRUE(made->mesh.triangles.empty());
    EXPECT_TRUE(made->mesh.positions.empty());
    EXPECT_EQ(made->error, 0.0);
  }
}

TEST(DualContouring, WhatCannotBeMeshedIsRefused) {
  AnalyticSolid ball;
  ball.add(Sphere{1.0});
  const auto message = [&](const Bounds& bounds, const ContourOptions& options) {
    const auto made = contour(ball.sampled(bounds), options);
    return made ? std::string("no error") : made.error().message;
  };
  const Bounds bounds = cube_around_origin(1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double cell : {0.0, -1.0, nan, HUGE_VAL}) {
    EXPECT_NE(message(bounds, {.cell = cell}).find("cell"), std::string::npos);
    EXPECT_NE(message(Bounds(), {.cell = cell}).find("cell"), std::string::npos);
  }
  for (const double cell : {1e-5, 1e-13, 1e-300}) {
    EXPECT_NE(message(bounds, {.cell = cell}).find("larger"), std::string::npos);
  }
  EXPECT_NE(message(bounds, {.cell = 0.05, .max_triangles = 5000}).find("more than 5000"), std::string::npos);
  EXPECT_EQ(message(bounds, {.cell = 0.2, .max_triangles = 5000}), "no error");
  for (const double bad : {HUGE_VAL, nan}) {
    const Bounds open(Vector3(-1, -1, -1), Vector3(1, bad, 1));
    EXPECT_NE(message(open, {.cell = 0.1}).find("infinite"), std::string::npos);
  }
}

TEST(DualContouring, ProgressRisesAndStops) {
  AnalyticSolid box;  // with edges to refine
  box.add(Box{{0.5, 0.4, 0.3}}, pose_turned(0.7, {1, 2, 3}));
  const SampledSolid solid = box.sampled(cube_around_origin(0.75));
  std::vector<double> parts;
  ContourOptions options{.cell = 0.1};
  options.progress = [&](double part) {
    parts.push_back(part);
    return true;
  };
  ASSERT_TRUE(contour(solid, options).has_value());
  ASSERT_GT(parts.size(), 5u);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_GE(parts.front(), 0.0);
  EXPECT_LE(parts.back(), 1.0);
  for (std::size_t stop = 0; stop < parts.size(); ++stop) {
    std::size_t calls = 0;
    options.progress = [&](double) { return calls++ < stop; };
    const auto made = contour(solid, options);
    ASSERT_FALSE(made.has_value()) << "stopped at call " << stop;
    EXPECT_NE(made.error().message.find("interrupted"), std::string::npos);
    EXPECT_EQ(calls, stop + 1);
  }
}

}  // namespace
}  // namespace icome::geometry
