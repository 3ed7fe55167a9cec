#include "geometry/sweep/outline_extrusion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "geometry/closed_mesh.h"

namespace icome::geometry {
namespace {

constexpr double kTurn = 6.283185307179586;

/// A ring of `corners` about a centre, counter-clockwise, or clockwise where `sense` is -1.
std::vector<Vector2> ring_about(const Vector2& centre, double radius, int corners, double sense = 1.0) {
  std::vector<Vector2> ring;
  for (int i = 0; i < corners; ++i) {
    const double angle = sense * kTurn * i / corners;
    ring.emplace_back(centre + radius * Vector2(std::cos(angle), std::sin(angle)));
  }
  return ring;
}

double area_of_circle(double radius, int corners) {
  return 0.5 * corners * radius * radius * std::sin(kTurn / corners);
}

SweepStep moved_by(const Vector3& way) {
  SweepStep step;
  step.translation = way;
  return step;
}

TEST(OutlineExtrusion, APlateWithHolesIsClosedAndAsLargeAsItsArea) {
  const Outline plate = {
      {{-2, -1}, {2, -1}, {2, 1}, {-2, 1}},
      {ring_about({-1, 0}, 0.5, 24, -1.0), ring_about({1, 0.2}, 0.3, 7), ring_about({0, 0}, 0.1, 3)}};
  const double area = 8.0 - area_of_circle(0.5, 24) - area_of_circle(0.3, 7) - area_of_circle(0.1, 3);
  for (const double height : {0.7, -0.7}) {  // to either side
    const auto mesh = extrude_outline(plate, std::vector{moved_by({0.1, 0.0, height})});
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(is_closed(*mesh));
    EXPECT_NEAR(signed_volume(*mesh), 0.7 * area, 1e-12);
  }
}

/// By Pappus: the area of a profile beside the axis times the way of its centroid, here of polygons that turn
/// in steps.
TEST(OutlineExtrusion, AHollowRingIsAsLargeAsTheWayOfItsProfile) {
  const Outline pipe = {ring_about({3, 0}, 1.0, 32), {ring_about({3, 0}, 0.6, 32)}};
  const double area = area_of_circle(1.0, 32) - area_of_circle(0.6, 32);
  SweepStep step;
  step.axis = Vector3::UnitY();
  step.angle = kTurn / 64;
  step.repeat = 64;
  const auto ring = extrude_outline(pipe, std::vector{step}, ExtrusionEnds::Joined);
  ASSERT_TRUE(ring) << ring.error().message;
  EXPECT_TRUE(is_closed(*ring));
  EXPECT_NEAR(signed_volume(*ring) / (area * kTurn * 3.0), 1.0, 0.003);
  step.repeat = 16;
  const auto bend = extrude_outline(pipe, std::vector{step});
  ASSERT_TRUE(bend) << bend.error().message;
  EXPECT_TRUE(is_closed(*bend));
  EXPECT_NEAR(signed_volume(*bend), 0.25 * signed_volume(*ring), 1e-9);
  const auto open = extrude_outline(pipe, std::vector{step}, ExtrusionEnds::Open);
  ASSERT_TRUE(open);
  EXPECT_FALSE(is_closed(*open));
}

/// The edge on the axis of the turn has no walls, so that both caps meet there.
TEST(OutlineExtrusion, AProfileMayLieOnTheAxisWithAnEdge) {
  SweepStep step;
  step.axis = Vector3::UnitY();
  step.repeat = 16;
  const std::vector<Vector2> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
  for (const double sense : {1.0, -1.0}) {
    step.angle = sense * kTurn / 64;
    for (std::size_t first = 0; first < 4; ++first) {  // also as the first edge
      Outline outline = {square, {ring_about({1, 1}, 0.5, 12)}};
      std::ranges::rotate(outline.rim, outline.rim.begin() + std::ptrdiff_t(first));
      const auto mesh = extrude_outline(outline, std::vector{step});
      ASSERT_TRUE(mesh) << mesh.error().message;
      EXPECT_TRUE(is_closed(*mesh)) << sense << " " << first;
      EXPECT_NEAR(signed_volume(*mesh) / (0.25 * kTurn * (4.0 - area_of_circle(0.5, 12))), 1.0, 0.003);
    }
  }
}

/// Random holes in the cells of a grid, along random sweeps.
TEST(OutlineExtrusion, RandomOnesAreClosedAndAsLargeAsRimLessHoles) {
  base::Random random(8);
  for (int round = 0; round < 60; ++round) {
    Outline outline = {{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {}};
    for (int cell = 0; cell < 16; ++cell) {
      if (random.index(2) == 0) continue;
      const Vector2 centre(0.5 + cell % 4, 0.5 + double(cell / 4));
      outline.holes.push_back(ring_about(centre, random.uniform(0.05, 0.45), 3 + int(random.index(20)),
                                         random.index(2) == 0 ? 1.0 : -1.0));
    }
    std::vector<SweepStep> steps(1 + random.index(3));
    for (SweepStep& step : steps) {
      step.translation = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(0.5, 1.5)};
      step.scaling = Vector3(1, 1, 1) * random.uniform(0.8, 1.2);
      step.scaling.z() = 1.0;
      step.angle = random.uniform(-0.1, 0.1);
      step.repeat = 1 + int(random.index(3));
    }
    const auto mesh = extrude_outline(outline, steps);
    ASSERT_TRUE(mesh) << mesh.error().message;
    EXPECT_TRUE(is_closed(*mesh)) << round;
    double volume = signed_volume(*extrude({outline.rim}, steps));
    for (const auto& hole : outline.holes) volume -= signed_volume(*extrude({hole}, steps));
    EXPECT_NEAR(signed_volume(*mesh), volume, 1e-9 * volume) << round;
  }
}

TEST(OutlineExtrusion, RefusesHolesThatAreNone) {
  const std::vector<Vector2> square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
  const auto complaint = [&](std::vector<std::vector<Vector2>> holes, const SweepStep& step) {
    const auto made = extrude_outline({square, std::move(holes)}, std::vector{step});
    return made ? std::string("none") : made.error().message;
  };
  const SweepStep up = moved_by({0, 0, 1});
  EXPECT_EQ(complaint({ring_about({2, 2}, 1, 9)}, up), "none");
  EXPECT_NE(complaint({ring_about({9, 2}, 1, 9)}, up).find("within its rim"), std::string::npos);
  EXPECT_NE(complaint({ring_about({4, 2}, 1, 9)}, up), "none") << "across the rim";
  EXPECT_NE(complaint({ring_about({2, 2}, 1, 9), ring_about({2.5, 2}, 1, 9)}, up), "none")
      << "across each other";
  EXPECT_NE(complaint({ring_about({2, 2}, 1, 9), ring_about({2, 2}, 0.5, 9)}, up), "none")
      << "within each other";
  EXPECT_NE(complaint({{{1, 1}, {2, 2}}}, up).find("hole 1"), std::string::npos);
  SweepStep to_a_point = up;
  to_a_point.scaling = {0, 0, 1};
  EXPECT_NE(complaint({ring_about({2, 2}, 1, 9)}, to_a_point).find("point or a line"), std::string::npos);
  SweepStep to_a_line = up;
  to_a_line.scaling = {1, 0, 1};
  to_a_line.centre = {0, 2, 0};
  EXPECT_NE(complaint({ring_about({2, 2}, 1, 12)}, to_a_line), "none");
}

}  // namespace
}  // namespace icome::geometry
