// The surface contact point on the limits of Loop's subdivision, against finely subdivided meshes.
#include <gtest/gtest.h>

#include <filesystem>

#include "files/mesh/mesh_reader.h"
#include "geometry/loop/loop_surface.h"
#include "haptics/loop_controls.h"
#include "places.h"

namespace icome::haptics {
namespace {

std::shared_ptr<const Shape> limit_shape(const ControlMesh& control) {
  auto surface = geometry::LoopSurface::create(control);
  EXPECT_TRUE(surface.has_value()) << (surface ? "" : surface.error().message);
  return std::make_shared<SmoothShape>(*surface);
}

// ---- Random presses and slides

/// Fails on whatever is wrong along a random way.
void touch_at_random(const ControlMesh& control, std::uint64_t seed, int ticks) {
  const BruteLoop loop(control);
  ASSERT_LT(loop.margin(), 0.01 * kLoopSize);
  TouchCheck check;
  check.size = kLoopSize;
  check.sample = 40;
  check.report = [](const TouchFailure& failure) { ADD_FAILURE() << failure; };
  const auto count = std::size_t(ticks);
  const auto path = loop.closed() ? random_touch(loop, seed, count, kLoopSize)
                                  : random_touch(SheetGround{loop}, seed, count, kLoopSize);
  const TouchFigures figures = CheckedTouch(loop, limit_shape(control), check).run(path);
  EXPECT_EQ(figures.failures, 0u);
  EXPECT_GT(figures.touching, path.size() / 10);
}

class TouchedLoops : public testing::TestWithParam<TouchedLoop> {};

INSTANTIATE_TEST_SUITE_P(Controls, TouchedLoops, testing::ValuesIn(touched_loops()),
                         [](const auto& it) { return it.param.name; });

TEST_P(TouchedLoops, GivesTheConstrainedPlaceAndNoPops) { touch_at_random(GetParam().control, 7, 2000); }

// Creases at random make shallow grooves too, where the tip is beyond the rims of both sides.
TEST(ScpOnLoop, RestsInShallowGrooves) {
  const TriangleMesh ball = geometry::loop_reference::wild_ball(1, 30, 0.15, 30);
  touch_at_random(fitted(geometry::loop_reference::torn(ball, 0.0, 0.1, 0.05, 30)), 30, 1000);
}

TEST(ScpOnLoop, GivesTheConstrainedPlaceOnRealModels) {
  const auto folder = places::shared_data() / "meshes" / "control";
  for (const char* name : {"spot.obj", "bob_small.ply"}) {
    if (!std::filesystem::exists(folder / name)) GTEST_SKIP() << folder / name << " is not there";
    SCOPED_TRACE(name);
    const auto model = files::read_mesh(folder / name);
    ASSERT_TRUE(model.has_value()) << model.error().message;
    touch_at_random(fitted({model->mesh, {}, {}}), 5, 2000);
  }
}

// ---- Normals

/// The largest turn (rad) of the normal from one tick to the next, all around a shape, 6 mm deep.
double largest_turn(const BruteLoop& loop, const std::shared_ptr<const Shape>& shape) {
  Toucher toucher(HapticScene::compile({object(1, shape)}));
  const int ticks = 6000;
  double largest = 0.0;
  Vector3 last = Vector3::Zero();
  for (int i = 0; i <= ticks; ++i) {
    const double angle = 6.283185307179586 * i / ticks;
    const Vector3 out = Vector3(std::cos(angle), std::sin(angle), 0.3 * std::sin(3.0 * angle)).normalized();
    if (i == 0) toucher.step(0.1 * out);
    const ScpState& state =
        toucher.step(loop.tree().first_hit(0.1 * out, Vector3::Zero())->point - 0.006 * out);
    EXPECT_TRUE(state.touching && state.converged) << i;
    if (i > 0) largest = std::max(largest, std::acos(std::min(1.0, last.dot(state.normal))));
    last = state.normal;
  }
  return largest;
}

TEST(ScpOnLoop, TurnsItsNormalSmoothlyFromFaceToFace) {
  const ControlMesh round_controls[] = {icosahedron(), bipyramid(3), bipyramid(4), bipyramid(12)};
  for (const ControlMesh& control : round_controls) {
    SCOPED_TRACE(control.mesh.triangles.size());
    const BruteLoop loop(control, 10'000);
    const BruteLoop facets(control, 16 * control.mesh.triangles.size());  // two subdivisions
    const double on_limit = largest_turn(loop, limit_shape(control));
    const double on_facets = largest_turn(loop, shape_of(shared(facets.triangles())));
    EXPECT_LT(10.0 * on_limit, on_facets);
  }
}

// ---- Sheets

/// A square of side 0.1 m at z = 0 whose limit is flat; its rim is a curve with round corners.
ControlMesh level_sheet() {
  return {height_field(0.1, 4, [](double, double) { return 0.0; }), {}, {}};
}

TEST(ScpOnLoop, LeavesASheetOverItsRimWithoutAJump) {
  for (const double depth : {0.002, 0.0002, 0.00001}) {
    for (const double y : {0.0, 0.013, -0.031}) {
      Toucher toucher(HapticScene::compile({object(1, limit_shape(level_sheet()))}));
      toucher.step({0.0, y, 0.001});
      const double step = 1e-4;
      Vector3 last = toucher.step({0.0, y, -depth}).scp;
      bool left = false;
      for (int i = 1; i < 700; ++i) {
        const Vector3 tip(step * i, y, -depth);
        const ScpState& state = toucher.step(tip);
        ASSERT_TRUE(state.converged) << i;
        ASSERT_LE((state.scp - last).norm(), std::hypot(depth, step) * (1.0 + 1e-6)) << i;
        if (state.touching) {
          ASSERT_FALSE(left) << i;
          ASSERT_LT((state.scp - Vector3(tip.x(), y, 0.0)).norm(), 1e-9) << i;
        } else if (!left) {
          left = true;
          EXPECT_NEAR(tip.x(), 0.05, 1.01 * step);  // straight sides stay where they are
        }
        last = state.scp;
      }
      EXPECT_TRUE(left);
    }
  }
}

// Pressed in at a side of a box whose top is framed by creases, and drawn up: over the top nothing holds.
TEST(ScpOnLoop, LeavesASideOverItsCrease) {
  const ControlMesh control = creased_box();
  const BruteLoop loop(control);
  double top = 0.0;
  for (const Vector3& p : loop.triangles().positions) top = std::max(top, p.z());
  for (const double depth : {1e-5, 0.002, 0.01}) {
    Toucher toucher(HapticScene::compile({object(1, limit_shape(control))}));
    const Vector3 out(0.07, 0.005, 0.5 * top);
    Vector3 tip = brute_nearest(loop.triangles(), out).point - Vector3(depth, 0.0, 0.0);
    toucher.step(out);
    toucher.go(out, tip, 50);
    while (tip.z() < 1.3 * top) {
      tip.z() += 1e-4;
      const ScpState& state = toucher.step(tip);
      ASSERT_TRUE(state.converged);
      ASSERT_EQ(state.touching, tip.z() <= top) << tip.z() - top;
    }
  }
}

TEST(ScpOnLoop, FeelsASheetFromBothSidesOnlyWhenAsked) {
  const ControlMesh control = open_sheet();
  const BruteLoop loop(control);
  const auto shape = limit_shape(control);
  Random random(6);
  for (const TouchableSides sides : {TouchableSides::Front, TouchableSides::Both}) {
    const ScenePointer scene = HapticScene::compile({object(1, shape, Pose::Identity(), sides)});
    for (int i = 0; i < repeats(100); ++i) {
      const Vector3 up(0.0, 0.0, 0.05);
      const Vector3 place(random.uniform(-0.035, 0.035), random.uniform(-0.035, 0.035), 0.0);
      const auto on_sheet = loop.tree().first_hit(place + up, place - up);
      ASSERT_TRUE(on_sheet.has_value());
      for (const double side : {-1.0, 1.0}) {
        Toucher toucher(scene);
        const Vector3 start = place + side * up, tip = on_sheet->point - 0.05 * side * up;
        toucher.step(start);
        const ScpState& state = toucher.go(start, tip, 40);
        ASSERT_TRUE(state.converged) << i;
        ASSERT_EQ(state.touching, side > 0.0 || sides == TouchableSides::Both) << i;
        if (!state.touching) continue;
        ASSERT_GT(side * state.normal.z(), 0.0) << i;
        if (i % 5 > 0) continue;
        const ScpError found = brute_scp_error(loop, tip, state.scp, kLoopSize);
        ASSERT_LT(found.error, 1e-5 * kLoopSize) << i;
      }
    }
  }
}

// ---- Stabs

TEST(ScpOnLoop, IsNotStabbedThroughThinParts) {
  ControlMesh lens = icosahedron();
  for (Vector3& p : lens.mesh.positions) p.z() *= 0.01;
  const BruteLoop loop(lens);
  const auto shape = limit_shape(lens);
  const ScenePointer scene = HapticScene::compile({object(1, shape)});
  Random random(9);
  int pops = 0;
  for (int i = 0; i < repeats(1000); ++i) {
    const double side = i % 2 ? 1.0 : -1.0;
    const double angle = random.uniform(0.0, 6.28), rho = random.uniform(0.0, 0.02);
    Vector3 way = Vector3(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), -side).normalized();
    const Vector3 middle(rho * std::cos(angle), rho * std::sin(angle), 0.0);
    const double speed = std::pow(10.0, random.uniform(-4.0, -2.0));  // m a tick
    Toucher toucher(scene);
    for (double t = -0.004; t < 0.006; t += speed) {
      const ScpState& state = toucher.step(middle + t * way);
      pops += side * state.scp.z() < 0.0 || loop.bound(state.scp) < 0.0;
    }
    EXPECT_TRUE(toucher.solver.state().touching && toucher.solver.state().converged) << i;
  }
  EXPECT_EQ(pops, 0);
}

}  // namespace
}  // namespace icome::haptics
