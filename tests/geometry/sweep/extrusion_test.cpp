#include "geometry/sweep/extrusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "base/random.h"
#include "geometry/closed_mesh.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

constexpr double kHalfTurn = 3.141592653589793;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

SweepStep moved(const Vector3& translation, int repeat = 1) {
  SweepStep step;
  step.translation = translation;
  step.repeat = repeat;
  return step;
}

SweepStep scaled(const Vector3& scaling, const Vector3& translation = Vector3::Zero()) {
  SweepStep step;
  step.scaling = scaling;
  step.translation = translation;
  return step;
}

SweepStep turned_about(const Vector3& axis, double angle, int repeat,
                       const Vector3& centre = Vector3::Zero()) {
  SweepStep step;
  step.axis = axis;
  step.angle = angle;
  step.centre = centre;
  step.repeat = repeat;
  return step;
}

Profile outline(std::vector<Vector2> points) { return {std::move(points), false}; }
Profile line(std::vector<Vector2> points) { return {std::move(points), true}; }
Profile rectangle(double width, double height) {
  return outline({{0, 0}, {width, 0}, {width, height}, {0, height}});
}

double area_of(const Profile& profile) {
  double twice = 0.0;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const Vector2& a = profile.points[i];
    const Vector2& b = profile.points[(i + 1) % profile.points.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return twice / 2.0;
}

/// The integral of x over the inside of a counter-clockwise outline.
double moment_of(const Profile& profile) {
  double six_times = 0.0;
  for (std::size_t i = 0; i < profile.points.size(); ++i) {
    const Vector2& a = profile.points[i];
    const Vector2& b = profile.points[(i + 1) % profile.points.size()];
    six_times += (a.x() + b.x()) * (a.x() * b.y() - a.y() * b.x());
  }
  return six_times / 6.0;
}

/// Pappus for an outline turned about the y axis in `steps` straight steps of `angle`: between two sections
/// lie triangles with sides x and x, so x^2 sin(angle) / 2 stands for x^2 angle / 2.
double turned_volume(const Profile& profile, double angle, int steps) {
  return moment_of(profile) * std::sin(angle) * steps;
}

/// The same for the area: each edge makes trapezoids.
double turned_area(const Profile& profile, double angle, int steps) {
  double area = 0.0;
  const std::size_t count = profile.points.size();
  for (std::size_t i = 0; i + (profile.open ? 1 : 0) < count; ++i) {
    const Vector2& a = profile.points[i];
    const Vector2& b = profile.points[(i + 1) % count];
    const double height = std::hypot((b.x() - a.x()) * std::cos(angle / 2), b.y() - a.y());
    area += (a.x() + b.x()) * std::sin(angle / 2) * height;
  }
  return area * steps;
}

/// The least height of a triangle as a share of its longest edge.
double least_height(const TriangleMesh& mesh) {
  double least = 1.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vector3 u = mesh.corner(t, 1) - mesh.corner(t, 0);
    const Vector3 v = mesh.corner(t, 2) - mesh.corner(t, 0);
    const double longest2 = std::max({u.squaredNorm(), v.squaredNorm(), (u - v).squaredNorm()});
    least = std::min(least, u.cross(v).norm() / longest2);
  }
  return least;
}

TriangleMesh made(const Profile& profile, const std::vector<SweepStep>& steps,
                  ExtrusionEnds ends = ExtrusionEnds::Capped) {
  auto mesh = extrude(profile, steps, ends);
  EXPECT_TRUE(mesh) << mesh.error().message;
  return mesh ? *mesh : TriangleMesh{};
}

std::string failure(const Profile& profile, const std::vector<SweepStep>& steps,
                    ExtrusionEnds ends = ExtrusionEnds::Capped) {
  const auto mesh = extrude(profile, steps, ends);
  return mesh ? "none" : mesh.error().message;
}

void expect_solid(const TriangleMesh& mesh, std::int64_t characteristic) {
  EXPECT_TRUE(is_closed(mesh));
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_TRUE(report.closed && report.orientable);
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0U);
  EXPECT_EQ(report.components, 1U);
  EXPECT_EQ(euler_characteristic(mesh), characteristic);
  EXPECT_GT(volume(mesh), 0.0);
  EXPECT_GT(least_height(mesh), 1e-9);
}

void expect_contains(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(Extrusion, PrismHasItsVolumeWhicheverWayItIsDrawnAndPushed) {
  for (const bool clockwise : {false, true}) {
    for (const double push : {3.0, -3.0}) {
      Profile profile = rectangle(1, 2);
      if (clockwise) std::reverse(profile.points.begin(), profile.points.end());
      const TriangleMesh mesh = made(profile, {moved({0, 0, push})});
      expect_solid(mesh, 2);
      EXPECT_NEAR(volume(mesh), 6.0, 1e-14);
      EXPECT_NEAR(surface_area(mesh), 2 * 2 + 6 * 3, 1e-14);
      EXPECT_EQ(mesh.positions.size(), 8U);
      EXPECT_EQ(mesh.triangles.size(), 12U);
    }
  }
}

TEST(Extrusion, ConcaveProfileMovedAslant) {
  const Profile arrow = outline({{0, 0}, {2, -1}, {1, 0}, {2, 1}});
  const TriangleMesh mesh = made(arrow, {moved({0.5, 0.25, 0.125}, 8)});
  expect_solid(mesh, 2);
  EXPECT_NEAR(volume(mesh), area_of(arrow), 1e-14);
}

TEST(Extrusion, CircleScaledToNothingIsACone) {
  const Profile circle = *regular_polygon(64, 0.5);
  const TriangleMesh mesh = made(circle, {scaled({0, 0, 1}, {0, 0, 2})});
  expect_solid(mesh, 2);
  EXPECT_NEAR(volume(mesh), area_of(circle) * 2 / 3, 1e-14);
  EXPECT_EQ(mesh.positions.size(), 65U);
  EXPECT_EQ(mesh.triangles.size(), 64U + 62U);
  // Done again, it has nothing left to move.
  EXPECT_EQ(made(circle, {scaled({0, 0, 1}, {0, 0, 2}), scaled({0, 0, 1})}).triangles, mesh.triangles);
}

TEST(Extrusion, FrustumFollowsTheFormula) {
  const Profile hexagon = *regular_polygon(6, 1.0);
  const TriangleMesh mesh = made(hexagon, {scaled({0.25, 0.25, 1}, {0, 0, 3})});
  expect_solid(mesh, 2);
  EXPECT_NEAR(volume(mesh), area_of(hexagon) * 3 / 3 * (1 + 0.0625 + 0.25), 1e-14);
}

TEST(Extrusion, TriangleTurnedAboutItsOwnSideIsACone) {
  const Profile triangle = outline({{0, 0}, {0.4, 0}, {0, 1}});
  constexpr int kSteps = 48;
  const double angle = 2 * kHalfTurn / kSteps;
  const TriangleMesh mesh = made(triangle, {turned_about({0, 1, 0}, angle, kSteps)}, ExtrusionEnds::Joined);
  expect_solid(mesh, 2);
  EXPECT_NEAR(volume(mesh), turned_volume(triangle, angle, kSteps), 1e-14);
  EXPECT_NEAR(surface_area(mesh), turned_area(triangle, angle, kSteps), 1e-14);
  EXPECT_EQ(mesh.positions.size(), kSteps + 2U);
  EXPECT_EQ(mesh.triangles.size(), 2U * kSteps);
}

TEST(Extrusion, PieceOfAConeHasCapsThatShareTheAxis) {
  const Profile triangle = outline({{0, 0}, {0.4, 0}, {0, 1}});
  const TriangleMesh mesh = made(triangle, {turned_about({0, -3, 0}, 0.1, 10)});
  expect_solid(mesh, 2);
  EXPECT_NEAR(volume(mesh), turned_volume(triangle, 0.1, 10), 1e-14);
  EXPECT_NEAR(surface_area(mesh), turned_area(triangle, 0.1, 10) + 2 * 0.2, 1e-14);
  EXPECT_EQ(mesh.positions.size(), 2U + 11U);
}

TEST(Extrusion, CornersWithinAnEdgeOnTheAxisAreLeftOut) {
  const Profile triangle = outline({{0, 0}, {1, 0}, {0, 1}, {0, 0.5}, {0, 0.2}});
  const TriangleMesh cone =
      made(triangle, {turned_about({0, 1, 0}, kHalfTurn / 8, 15)}, ExtrusionEnds::Joined);
  expect_solid(cone, 2);
  EXPECT_EQ(cone.positions.size(), 18U);
  const TriangleMesh piece = made(triangle, {turned_about({0, 1, 0}, kHalfTurn / 8, 4)});
  expect_solid(piece, 2);
  EXPECT_NEAR(volume(piece), turned_volume(triangle, kHalfTurn / 8, 4), 1e-14);
}

TEST(Extrusion, CircleTurnedIsATorus) {
  const Profile circle = *regular_polygon(24, 0.25, {1, 0});
  constexpr int kSteps = 40;
  const double angle = 2 * kHalfTurn / kSteps;
  for (const int repeat : {kSteps, kSteps - 1}) {
    const TriangleMesh mesh = made(circle, {turned_about({0, 1, 0}, angle, repeat)}, ExtrusionEnds::Joined);
    expect_solid(mesh, 0);
    EXPECT_NEAR(volume(mesh), turned_volume(circle, angle, kSteps), 1e-13);
    EXPECT_NEAR(surface_area(mesh), turned_area(circle, angle, kSteps), 1e-13);
    EXPECT_EQ(mesh.positions.size(), 24U * kSteps);
  }
  // Angles typed with few digits close the ring too.
  const TriangleMesh typed = made(circle, {turned_about({0, 1, 0}, 0.15708, kSteps)}, ExtrusionEnds::Joined);
  EXPECT_EQ(typed.positions.size(), 24U * kSteps);
}

TEST(Extrusion, TorusFarFromTheOriginAndAboutASlantedAxisOfItsPlane) {
  const Vector2 along = Vector2(3, 4) / 5;
  const Vector2 centre = {100, -50};
  const Profile circle = *regular_polygon(12, 0.2, centre + Vector2(-along.y(), along.x()));
  const TriangleMesh mesh =
      made(circle, {turned_about({3, 4, 0}, kHalfTurn / 8, 16, {centre.x(), centre.y(), 0})},
           ExtrusionEnds::Joined);
  expect_solid(mesh, 0);
  const double one_metre_away = area_of(*regular_polygon(12, 0.2));
  EXPECT_NEAR(signed_volume(mesh), one_metre_away * std::sin(kHalfTurn / 8) * 16, 1e-11);
}

TEST(Extrusion, TwistedRingMeetsItselfACornerFurther) {
  // A square that turns a quarter about its own middle on its way around.
  const Profile square = *regular_polygon(4, 0.2);
  constexpr int kSteps = 60;
  const auto place = [](int i) {
    return Affine3(
        Eigen::AngleAxisd(2 * kHalfTurn * i / kSteps, Vector3::UnitY()) * Eigen::Translation3d(1, 0, 0) *
        Eigen::AngleAxisd(kHalfTurn / 2 * i / kSteps, Vector3::UnitZ()) * Eigen::Translation3d(-1, 0, 0));
  };
  Profile moved_square = square;
  for (Vector2& point : moved_square.points) point.x() += 1.0;
  std::vector<SweepStep> steps;
  for (int i = 0; i < kSteps; ++i) {
    const Affine3 next = place(i + 1) * place(i).inverse();
    const Eigen::AngleAxisd turn(Matrix3(next.linear()));
    steps.push_back(turned_about(turn.axis(), turn.angle(), 1));
    steps.back().translation = next.translation();
  }
  const TriangleMesh mesh = made(moved_square, steps, ExtrusionEnds::Joined);
  expect_solid(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 4U * kSteps);
  EXPECT_NEAR(volume(mesh), 0.08 * 2 * kHalfTurn, 0.08 * 2 * kHalfTurn * 0.01);
}

TEST(Extrusion, HelixPipeTendsToTheVolumeOfItsTurn) {
  const Profile circle = *regular_polygon(16, 0.1, {1, 0});
  constexpr double kAngle = 6 * kHalfTurn;
  double error_before = 0.0;
  for (const int steps : {60, 120, 240}) {
    SweepStep step = turned_about({0, 1, 0}, kAngle / steps, steps);
    step.translation = {0, 1.5 / steps, 0};
    const TriangleMesh mesh = made(circle, {step});
    expect_solid(mesh, 2);
    const double error = std::abs(volume(mesh) / (moment_of(circle) * kAngle) - 1);
    EXPECT_LT(error, 3 * std::pow(kAngle / steps, 2));
    if (error_before > 0.0) {
      EXPECT_GT(error_before / error, 3.5);
    }
    error_before = error;
  }
}

TEST(Extrusion, ThinBladeCanBeTwisted) {
  for (const double twist : {0.1, -0.1}) {
    SweepStep step = turned_about({0, 0, 1}, twist, 15);
    step.translation = {0, 0, 0.05};
    const TriangleMesh blade = made(outline({{-0.5, 0}, {0.5, 0}, {0.5, 0.003}, {-0.5, 0.003}}), {step});
    expect_solid(blade, 2);
    EXPECT_NEAR(volume(blade), 0.003 * 0.75, 0.003 * 0.75 * 0.02);
  }
}

TEST(Extrusion, TenThousandStepsKeepTheAxisInPlace) {
  const Profile triangle = outline({{0.1, 0}, {0.4, 0}, {0.1, 1}});
  const TriangleMesh cone =
      made(triangle, {turned_about({0, 7, 0}, 2 * kHalfTurn / 10'000, 10'000, {0.1, 3, 0})},
           ExtrusionEnds::Joined);
  expect_solid(cone, 2);
  EXPECT_EQ(cone.positions.size(), 10'002U);
  const TriangleMesh rod = made(*regular_polygon(20, 0.1), {moved({0, 0, 1e-4}, 10'000)});
  EXPECT_TRUE(is_closed(rod));
  EXPECT_EQ(rod.triangles.size(), 2U * 20 * 10'000 + 2U * 18);
  EXPECT_NEAR(volume(rod), area_of(*regular_polygon(20, 0.1)), 1e-13);
  SweepStep coil = turned_about({0, 1, 0}, 0.01, 10'000);
  coil.translation = {0, 0.005, 0};
  const TriangleMesh spring = made(*regular_polygon(12, 0.1, {1, 0}), {coil});
  expect_solid(spring, 2);
}

TEST(Extrusion, ShrinkingShellEndsInOneVertex) {
  SweepStep step = turned_about({0, 1, 0}, 0.3, 400);
  step.scaling = Vector3::Constant(0.9);
  const TriangleMesh shell = made(*regular_polygon(16, 0.3, {1, 0}), {step});
  EXPECT_TRUE(is_closed(shell));
  EXPECT_EQ(euler_characteristic(shell), 2);
  EXPECT_GT(volume(shell), 0.0);
}

TEST(Extrusion, SquareFlattenedToALineIsARoof) {
  const TriangleMesh roof = made(outline({{-1, 0}, {1, 0}, {1, 3}, {-1, 3}}), {scaled({0, 1, 1}, {0, 0, 2})});
  expect_solid(roof, 2);
  EXPECT_EQ(roof.positions.size(), 6U);
  EXPECT_NEAR(volume(roof), 2 * 3 * 2 / 2, 1e-14);
  expect_solid(made(*regular_polygon(32, 1), {scaled({0, 1, 1}, {0, 0, 2})}), 2);
  expect_contains(failure(outline({{-1, 0}, {1, 1}, {1, 3}, {-1, 5}}), {scaled({0, 1, 1}, {0, 0, 2})}),
                  "step 1 flattens the profile to a line");
}

TEST(Extrusion, SteppedShaftAndCupStepWithinAPlane) {
  const Profile square = outline({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  const TriangleMesh shaft = made(square, {moved({0, 0, 1}), scaled({2, 2, 1}), moved({0, 0, 1})});
  expect_solid(shaft, 2);
  EXPECT_NEAR(volume(shaft), 4 + 16, 1e-13);
  const TriangleMesh cup = made(square, {moved({0, 0, 1}), scaled({0.5, 0.5, 1}), moved({0, 0, -0.75})});
  expect_solid(cup, 2);
  EXPECT_NEAR(volume(cup), 4 - 0.75, 1e-13);
  EXPECT_NEAR(surface_area(cup), 4 + 8 + 4 + 4 * 0.75, 1e-13);
}

TEST(Extrusion, OpenEndsLeaveTwoRims) {
  const TriangleMesh tube = made(rectangle(1, 1), {moved({0, 0, -2}, 3)}, ExtrusionEnds::Open);
  const MeshReport report = analyse_topology(tube).report;
  EXPECT_EQ(report.boundary_edges, 8U);
  EXPECT_EQ(report.inconsistent_edges, 0U);
  for (std::size_t t = 0; t < tube.triangles.size(); ++t) {
    const Vector3 normal =
        (tube.corner(t, 1) - tube.corner(t, 0)).cross(tube.corner(t, 2) - tube.corner(t, 0));
    const Vector3 middle = (tube.corner(t, 0) + tube.corner(t, 1) + tube.corner(t, 2)) / 3;
    EXPECT_GT(normal.dot(middle - Vector3(0.5, 0.5, -1)), 0.0);
  }
}

TEST(Extrusion, OpenProfileMakesASheet) {
  const TriangleMesh sheet = made(line({{0, 0}, {1, 0}, {1, 1}}), {moved({0, 0, 0.5}, 4)});
  EXPECT_EQ(sheet.triangles.size(), 16U);
  EXPECT_NEAR(surface_area(sheet), 4.0, 1e-14);
  EXPECT_EQ(analyse_topology(sheet).report.boundary_edges, 2U * 2 + 2 * 4);
  // Within its own plane too.
  EXPECT_NEAR(surface_area(made(line({{0, 0}, {1, 0}}), {moved({0, 1, 0}, 2)})), 2.0, 1e-14);
  expect_contains(failure(line({{0, 0}, {1, 0}}), {moved({1, 0, 0})}), "step 1 moves an edge");
  expect_contains(failure(line({{-1, 0}, {1, 0}}), {turned_about({0, 1, 0}, 0.1, 5)}),
                  "step 1 (repeat 1 of 5) makes the sheet cross itself");
}

TEST(Extrusion, HalfCircleTurnedIsASphere) {
  for (const bool upward : {false, true}) {
    Profile arc = line({});
    for (int i = 0; i <= 16; ++i) {
      const double angle = kHalfTurn * i / 16;
      arc.points.emplace_back(std::sin(angle), std::cos(angle));
    }
    if (upward) std::reverse(arc.points.begin(), arc.points.end());
    const TriangleMesh sphere =
        made(arc, {turned_about({0, 1, 0}, kHalfTurn / 16, 32)}, ExtrusionEnds::Joined);
    expect_solid(sphere, 2);
    EXPECT_EQ(sphere.positions.size(), 2U + 15U * 32);
    EXPECT_NEAR(surface_area(sphere), turned_area(arc, kHalfTurn / 16, 32), 1e-13);
  }
}

TEST(Extrusion, CornersOnStraightEdgesGiveNoFlatTriangles) {
  base::Random random(11);
  for (int round = 0; round < 30; ++round) {
    const Eigen::Rotation2Dd turn(random.uniform(0, 2 * kHalfTurn));
    Profile profile;
    const std::vector<Vector2> corners = {{0, 0}, {1, 0}, {1, 1}, {0.5, 0.25}, {0, 1}};
    for (std::size_t i = 0; i < corners.size(); ++i)
      for (int part = 0; part < 7; ++part)
        profile.points.emplace_back(turn * (corners[i] + (corners[(i + 1) % 5] - corners[i]) * (part / 7.0)));
    const TriangleMesh mesh = made(profile, {moved({0, 0, 1})});
    expect_solid(mesh, 2);
    EXPECT_NEAR(volume(mesh), 0.625, 1e-13);
  }
}

TEST(Extrusion, RandomStarsSweptGentlyStayClosed) {
  base::Random random(2026);
  for (int round = 0; round < 200; ++round) {
    Profile star;
    const auto corners = static_cast<int>(3 + random.index(40));
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * kHalfTurn * (i + random.uniform(0, 0.8)) / corners;
      star.points.emplace_back(random.uniform(0.2, 1.0) * Vector2(std::cos(angle), std::sin(angle)));
    }
    std::vector<SweepStep> steps;
    const double along = random.index(2) == 0 ? 0.4 : -0.4;
    for (std::uint64_t i = 0; i <= random.index(5); ++i) {
      SweepStep step = turned_about(random.direction(), random.uniform(-0.02, 0.02),
                                    static_cast<int>(1 + random.index(8)));
      step.scaling = Vector3::Constant(random.uniform(0.97, 1.03));
      step.centre = 0.5 * random.direction();
      step.translation = along * Vector3::UnitZ() + 0.05 * random.direction();
      steps.push_back(step);
    }
    const TriangleMesh mesh = made(star, steps);
    expect_solid(mesh, 2);
    EXPECT_EQ(made(star, steps).triangles, mesh.triangles);
  }
}

/// Texture coordinates of the corners at that place, of all triangles with this normal.
std::vector<Vector2> places_at(const TexturedExtrusion& made, const Vector3& place, const Vector3& normal) {
  std::vector<Vector2> found;
  for (std::size_t t = 0; t < made.mesh.triangles.size(); ++t) {
    const Vector3 one = made.mesh.corner(t, 1) - made.mesh.corner(t, 0);
    const Vector3 other = made.mesh.corner(t, 2) - made.mesh.corner(t, 0);
    if (!one.cross(other).normalized().isApprox(normal, 1e-9)) continue;
    for (int k = 0; k < 3; ++k)
      if (made.mesh.corner(t, k) == place) found.push_back(made.places[t][std::size_t(k)]);
  }
  return found;
}

/// A board of 2 m by 1 m with the picture on it once, 3 m high: seven corners and where they lie, counted out
/// by hand.
TEST(Extrusion, FoldsThePictureOfItsProfileOverTheSides) {
  Profile board{{{0, 0}, {2, 0}, {2, 1}, {0, 1}}};
  board.places = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  struct Corner {
    Vector3 place, normal;
    Vector2 picture;
  };
  const Corner corners[] = {
      {{2, 1, 0}, {0, 0, -1}, {1, 1}},  {{2, 1, 3}, {0, 0, 1}, {1, 1}},   {{2, 1, 0}, {1, 0, 0}, {1, 1}},
      {{2, 1, 3}, {1, 0, 0}, {2.5, 1}},  // 3 m are one and a half pictures wide
      {{2, 1, 3}, {0, 1, 0}, {1, 4}},   {{0, 0, 3}, {0, -1, 0}, {0, -3}}, {{0, 0, 3}, {-1, 0, 0}, {-1.5, 0}}};
  for (const bool mirrored : {false, true}) {
    if (mirrored) {
      std::ranges::reverse(board.points);
      std::ranges::reverse(board.places);
    }
    const SweepStep up{.translation = {0, 0, 3}};
    const auto made = extrude_textured(board, std::vector{up});
    ASSERT_TRUE(made) << made.error().message;
    ASSERT_EQ(made->places.size(), made->mesh.triangles.size());
    for (const Corner& it : corners) {
      const std::vector<Vector2> found = places_at(*made, it.place, it.normal);
      ASSERT_FALSE(found.empty());
      for (const Vector2& place : found) EXPECT_LT((place - it.picture).norm(), 1e-12) << place.transpose();
    }
  }
}

TEST(Extrusion, GivesEveryTriangleOfAnySweepAPlaceInThePicture) {
  auto circle = regular_polygon(12, 1.0, {3, 0});
  ASSERT_TRUE(circle);
  circle->places = circle->points;
  const SweepStep turn{.angle = 0.5235987755982988, .axis = {0, 1, 0}, .repeat = 12};
  const SweepStep back{.angle = -0.5235987755982988, .axis = {0, 1, 0}, .repeat = 5};
  const SweepStep shrink{.scaling = {0, 0, 0}, .centre = {3, 0, 1}};
  for (const auto& [steps, ends] : {std::pair{std::vector{turn}, ExtrusionEnds::Joined},
                                    std::pair{std::vector{back}, ExtrusionEnds::Capped},
                                    std::pair{std::vector{shrink}, ExtrusionEnds::Capped}}) {
    const auto plain = extrude(*circle, steps, ends);
    const auto made = extrude_textured(*circle, steps, ends);
    ASSERT_TRUE(plain && made) << made.error().message;
    EXPECT_EQ(made->mesh.triangles, plain->triangles);
    ASSERT_EQ(made->places.size(), made->mesh.triangles.size());
    for (const auto& corners : made->places)
      for (const Vector2& place : corners) EXPECT_TRUE(place.allFinite());
  }
}

TEST(Extrusion, RefusesSweepsThatRunThroughThemselves) {
  const Profile square = outline({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  expect_contains(failure(square, {moved({0, 0, 1}), turned_about({0, 1, 0}, 0.1, 5, {0.5, 0, 1})}),
                  "step 2 (repeat 1 of 5) meets the section before it");
  SweepStep half_turn = turned_about({0, 0, 1}, kHalfTurn, 1);
  half_turn.translation = {0, 0, 1};
  expect_contains(failure(square, {half_turn}), "step 1 meets the section before it");
  SweepStep screw = turned_about({0, 0, 1}, 3.0, 1);
  screw.translation = {0, 0, 1};
  expect_contains(failure(rectangle(1, 0.01), {screw}), "step 1 twists or squeezes");
  expect_contains(failure(square, {moved({0, 0, 1}), moved({0, 0, -0.5})}), "step 2 turns back");
  expect_contains(failure(square, {moved({0, 0, 1}), scaled({2, 2, 1}), moved({0, 0, -0.5})}),
                  "step 3 turns back");
  expect_contains(failure(square, {moved({1, 0, 0}), moved({0, 0, 1})}), "step 1 moves");
  expect_contains(failure(square, {scaled({0.5, 0.5, 1}), moved({0, 0, 1})}), "step 1 scales");
  expect_contains(failure(square, {scaled({2, 2, 1})}), "never leave the plane");
  expect_contains(failure(square, {moved({0, 0, 1}), scaled({2, 2, 1})}), "the last step");
  expect_contains(failure(square, {scaled({0, 0, 1}, {0, 0, 1}), moved({0, 0, 1})}),
                  "step 2 moves a profile that is scaled to nothing");
  expect_contains(failure(square, {moved({0, 0, 1})}, ExtrusionEnds::Joined), "joining the last section");
  expect_contains(failure(square, {scaled({0, 0, 1}, {0, 0, 1})}, ExtrusionEnds::Joined), "cannot be joined");
  expect_contains(failure(*regular_polygon(8, 0.2, {1, 0}), {turned_about({0, 1, 0}, kHalfTurn / 8, 16)}),
                  "step 1 (repeat 16 of 16) ends where the profile starts");
  expect_contains(failure(square, {moved({0, 0, 0})}), "move nothing");
}

TEST(Extrusion, RefusesBadProfiles) {
  const std::vector<SweepStep> up = {moved({0, 0, 1})};
  expect_contains(failure(outline({{0, 0}, {1, 0}}), up), "2 different corners");
  expect_contains(failure(outline({{0, 0}, {1, 0}, {1, 0}, {0, 0}}), up), "2 different corners");
  expect_contains(failure(outline({}), up), "0 different corners");
  expect_contains(failure(line({{1, 1}}), up), "1 different corners");
  expect_contains(failure(outline({{0, 0}, {1, 0}, {kNotANumber, 1}}), up), "corner 3");
  expect_contains(failure(outline({{0, 0}, {INFINITY, 0}, {0, 1}}), up), "corner 2");
  expect_contains(failure(outline({{0, 0}, {1e300, 0}, {0, 1}}), up), "corner 2");
  expect_contains(failure(outline({{0, 0}, {1e-200, 0}, {0, 1e-200}}), up), "smaller than");
  expect_contains(failure(outline({{1, 1}, {1, 1}, {1, 1}}), up), "smaller than");
  expect_contains(failure(outline({{0, 0}, {1, 1}, {3, 3}, {2, 2}}), up), "no area");
  expect_contains(failure(outline({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), up), "corners 1 and 3 cross");
  expect_contains(failure(outline({{0, 0}, {2, 0}, {2, 2}, {1, 0}, {0, 2}}), up), "cross or touch");
  expect_contains(failure(outline({{0, 0}, {2, 0}, {1, 0}, {1, 1}}), up), "cross or touch");
  expect_contains(failure(line({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), up), "corners 1 and 3 cross");
  expect_contains(failure({std::vector<Vector2>(20'001, Vector2::Zero()), false}, up), "20001 corners");
  // A start that is repeated at the end, as some files write it, is left out.
  EXPECT_EQ(made(outline({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), up).positions.size(), 6U);
}

TEST(Extrusion, RefusesBadSteps) {
  const Profile square = rectangle(1, 1);
  expect_contains(failure(square, {}), "no step");
  expect_contains(failure(square, {moved({0, 0, 1}), moved({0, kNotANumber, 1})}), "step 2 has a number");
  expect_contains(failure(square, {turned_about({0, 0, 0}, 1, 1)}),
                  "step 1 turns about an axis of no length");
  expect_contains(failure(square, {scaled({-1, 1, 1}, {0, 0, 1})}), "step 1 scales by less than 0");
  expect_contains(failure(square, {moved({0, 0, 1}, 0)}), "step 1 is done less than once");
  expect_contains(failure(square, {moved({0, 0, 1}, 2'000'000'000)}), "more than 20000000 triangles");
  expect_contains(failure(square, {moved({0, 0, 1}), moved({0, 0, 1e300}, 9)}),
                  "step 2 (repeat 1 of 9) leads");
  SweepStep doubling = scaled({2, 2, 2}, {0, 0, 1});
  doubling.repeat = 10'000;
  expect_contains(failure(square, {doubling}), "leads further");
}

TEST(RegularPolygon, HasEqualSidesAroundItsCentre) {
  const Profile heptagon = *regular_polygon(7, 2.0, {3, 4});
  ASSERT_EQ(heptagon.points.size(), 7U);
  for (int i = 0; i < 7; ++i) {
    EXPECT_NEAR((heptagon.points[i] - Vector2(3, 4)).norm(), 2.0, 1e-14);
    EXPECT_NEAR((heptagon.points[i] - heptagon.points[(i + 1) % 7]).norm(), 4 * std::sin(kHalfTurn / 7),
                1e-14);
  }
  EXPECT_GT(area_of(heptagon), 0.0);
  for (const int corners : {-1, 2, 20'001}) EXPECT_FALSE(regular_polygon(corners, 1.0));
  for (const double radius : {0.0, -1.0, 1e7, kNotANumber}) EXPECT_FALSE(regular_polygon(5, radius));
  EXPECT_FALSE(regular_polygon(5, 1.0, {kNotANumber, 0}));
}

TEST(RepeatedCopies, StairsRiseByTheSameStepEachTime) {
  const auto places = repeated_copies(Affine3(Eigen::Translation3d(0, 0.25, 0.18)), {5, 6, 7}, 12);
  ASSERT_TRUE(places);
  ASSERT_EQ(places->size(), 12U);
  for (int i = 0; i < 12; ++i)
    EXPECT_TRUE(((*places)[i] * Vector3(1, 2, 3))
                    .isApprox(Vector3(1, 2, 3) + (i + 1) * Vector3(0, 0.25, 0.18), 1e-14));
}

TEST(RepeatedCopies, SpiralStairsTurnAboutThePivot) {
  const Vector3 pivot(1, -2, 0);
  const double angle = kHalfTurn / 9;
  const Affine3 step = Eigen::Translation3d(0, 0, 0.2) * Affine3(Eigen::AngleAxisd(angle, Vector3::UnitZ()));
  const auto places = repeated_copies(step, pivot, 18);
  ASSERT_TRUE(places);
  for (int i = 0; i < 18; ++i) {
    const double turned = angle * (i + 1);
    const Vector3 expected = pivot + Vector3(std::cos(turned), std::sin(turned), 0.2 * (i + 1));
    EXPECT_LT(((*places)[i] * Vector3(pivot + Vector3::UnitX()) - expected).norm(), 1e-13);
  }
}

TEST(RepeatedCopies, RefusesWhatCannotBeRepeated) {
  const Affine3 lift(Eigen::Translation3d(0, 0, 1));
  EXPECT_TRUE(repeated_copies(lift, Vector3::Zero(), 0));
  Affine3 broken = lift;
  broken.matrix()(0, 3) = kNotANumber;
  EXPECT_FALSE(repeated_copies(broken, Vector3::Zero(), 3));
  EXPECT_FALSE(repeated_copies(lift, Vector3(INFINITY, 0, 0), 3));
  EXPECT_FALSE(repeated_copies(Affine3::Identity(), Vector3::Zero(), 3));
  EXPECT_FALSE(repeated_copies(Affine3(Eigen::Scaling(1.0, 0.0, 1.0)), Vector3::Zero(), 3));
  EXPECT_FALSE(repeated_copies(lift, Vector3::Zero(), kMaximumCopies + 1));
  EXPECT_FALSE(repeated_copies(Affine3(Eigen::Scaling(1e10)), Vector3::Zero(), 100));
}

}  // namespace
}  // namespace icome::geometry
