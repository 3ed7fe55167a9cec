// Sphere tips on Loop surfaces: their centre against the surface subdivided by the rules in the literature
// (loop_brute.h), and against closed forms.
#include <gtest/gtest.h>

#include <limits>
#include <tuple>

#include "geometry/loop/loop_offset.h"
#include "haptics/loop_controls.h"

namespace icome::haptics {
namespace {

using geometry::LoopOffset;

std::shared_ptr<const LoopOffset> loop_centres(const ControlMesh& control, double radius) {
  const auto surface = geometry::LoopSurface::create(control);
  EXPECT_TRUE(surface) << (surface ? "" : surface.error().message);
  const auto centres = LoopOffset::create(*surface, radius);
  EXPECT_TRUE(centres) << (centres ? "" : centres.error().message);
  return *centres;
}

/// A solver with the program's own budget.
Toucher ball_on_loop(const ControlMesh& control, double radius,
                     TouchableSides sides = TouchableSides::Front) {
  const auto shape = std::make_shared<SmoothShape>(loop_centres(control, radius), radius);
  return Toucher(HapticScene::compile({object(1, shape, Pose::Identity(), sides)}), radius);
}

/// From a place to the surface around its nearest vertex, m; exact where that is the nearest part.
double exact_distance(const BruteLoop& loop, const Vector3& place) {
  constexpr int kZooms = 14;
  LoopZoom zoom(loop, place);
  for (int i = 0; i < kZooms; ++i) zoom.refine();
  double least = std::numeric_limits<double>::infinity();
  zoom.samples([&](const Vector3& point, bool) { least = std::min(least, (point - place).norm()); });
  return least;
}

class BallsOnLoops : public testing::TestWithParam<std::tuple<TouchedLoop, double>> {};

INSTANTIATE_TEST_SUITE_P(Controls, BallsOnLoops,
                         testing::Combine(testing::ValuesIn(touched_loops()),
                                          testing::Values(1e-4, 1e-3, 5e-3, 1e-2)),
                         [](const auto& it) {
                           return std::get<0>(it.param).name +
                                  std::to_string(int(1e6 * std::get<1>(it.param))) + "um";
                         });

TEST_P(BallsOnLoops, KeepTheirRadiusFromTheSurface) {
  const auto& [named, radius] = GetParam();
  const BruteLoop loop(named.control, 12'000 / kSanitizerShare);
  Toucher toucher =
      ball_on_loop(named.control, radius, loop.closed() ? TouchableSides::Front : TouchableSides::Both);
  // A sheet's way begins below it, far from its ground.
  const auto count = std::size_t(loop.closed() ? std::max(150, repeats(600)) : 3000);
  const auto path = loop.closed() ? random_touch(loop, 7, count, kLoopSize)
                                  : random_touch(SheetGround{loop}, 7, count, kLoopSize);
  const double margin = 2.0 * loop.margin() + 1e-5 * radius;
  std::size_t touching = 0, tick = 0;
  for (const Vector3& tip : path) {
    const ScpState& state = toucher.step(tip);
    ++tick;
    ASSERT_TRUE(state.touching || state.scp == tip) << tick;
    const auto nearest = loop.tree().nearest(state.scp);
    ASSERT_FALSE(loop.inside(state.scp)) << tick;
    ASSERT_GT(nearest->parameter, radius - margin) << tick;
    if (!state.touching) continue;
    ++touching;
    ASSERT_LT(nearest->parameter, radius + margin) << tick;
    if (tick % 25 == 0) {
      ASSERT_GT(exact_distance(loop, state.scp), radius * (1.0 - 1e-5) - 1e-9) << tick;
    }
  }
  EXPECT_GT(touching, count / 20);
}

// The limit of a level control mesh is level, and its straight sides stay where they are.
TEST(BallOnLoop, RollsOverALevelSheetAndRoundItsRim) {
  const double half = 0.05;
  const ControlMesh sheet{height_field(2.0 * half, 4, [](double, double) { return 0.0; }), {}, {}};
  for (const double radius : {1e-4, 1e-3, 5e-3, 1e-2}) {
    Toucher toucher = ball_on_loop(sheet, radius, TouchableSides::Both);
    toucher.step({0.0, 0.003, 2.0 * radius});
    for (int i = 0; i <= 300; ++i) {
      const Vector3 tip(2e-4 * i, 0.003, 0.5 * radius);
      const ScpState& state = toucher.step(tip);
      const double apart = std::hypot(std::max(0.0, state.scp.x() - half), state.scp.z());
      ASSERT_GE(apart, radius - 1e-9) << i;
      ASSERT_TRUE(state.touching ? apart < radius + 1e-8 : state.scp == tip) << i;
      if (tip.x() <= half) {
        ASSERT_LT((state.scp - Vector3(tip.x(), tip.y(), radius)).norm(), 1e-8) << i;
      }
    }
    EXPECT_FALSE(toucher.solver.state().touching);
  }
}

// A groove that is narrower than the ball: it rests on both walls, at the same height all along.
TEST(BallOnLoop, RestsOnBothWallsOfANarrowGroove) {
  const ControlMesh ground{
      height_field(0.1, 20, [](double x, double) { return -0.01 * std::exp(-x * x / 2e-5); }), {}, {}};
  const BruteLoop loop(ground, 12'000 / kSanitizerShare);
  const double radius = 0.01, margin = 2.0 * loop.margin() + 1e-7;
  Toucher toucher = ball_on_loop(ground, radius);
  toucher.step({0.0, -0.02, 0.02});
  toucher.go({0.0, -0.02, 0.02}, {0.0, -0.02, -0.005}, 30);
  for (int i = 0; i <= 200; ++i) {
    const ScpState& state = toucher.step({0.0, -0.02 + 2e-4 * i, -0.005});
    ASSERT_TRUE(state.touching);
    ASSERT_NEAR(loop.tree().nearest(state.scp)->parameter, radius, margin) << i;
    ASSERT_LT(std::abs(state.scp.x()), 1e-3) << i;
    ASSERT_NEAR(state.scp.y(), -0.02 + 2e-4 * i, 1e-3) << i;
  }
}

TEST(BallOnLoop, ComesOutWhereItOverlapsAtTheStart) {
  Random random(3);
  for (const ControlMesh& control : {icosahedron(), quad_torus(10, 6), creased_box()}) {
    const BruteLoop loop(control, 12'000 / kSanitizerShare);
    for (int i = 0; i < std::max(4, repeats(20)); ++i) {
      const double radius = random.uniform(1e-3, 6e-3);
      const Vector3 tip = 0.06 * random.uniform(0.0, 1.0) * random.direction();
      Toucher toucher = ball_on_loop(control, radius);
      const ScpState& state = toucher.step(tip);
      const double before = loop.tree().nearest(tip)->parameter, margin = 2.0 * loop.margin() + 1e-7;
      EXPECT_FALSE(loop.inside(state.scp));
      EXPECT_GT(loop.tree().nearest(state.scp)->parameter, radius - margin);
      if (std::abs(before - radius) < margin) continue;
      EXPECT_EQ(state.started_inside, loop.inside(tip) || before < radius);
    }
  }
}

}  // namespace
}  // namespace icome::haptics
