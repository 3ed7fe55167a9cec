// The thesis's renderers in a scene: several objects, objects that move, come, change and go.
#include "haptics/thesis/thesis_solver.h"

#include <gtest/gtest.h>

#include "haptics/contact_world.h"
#include "haptics/servo/renderer.h"
#include "haptics/servo/scene_feed.h"
#include "haptics/thesis/thesis_shapes.h"

namespace icome::haptics {
namespace {

using geometry::CsgTree;

std::shared_ptr<const Shape> thesis_leaf(std::string_view text) {
  CsgTree tree;
  tree.add_leaf(primitive(text));
  return *ThesisCsgShape::create(tree);
}

/// A solver that goes from scene to scene as the servo would.
struct ThesisToucher {
  explicit ThesisToucher(ScenePointer first) { show(std::move(first)); }

  void show(ScenePointer next) {
    std::vector<SceneChange> changes;
    if (scene != nullptr) changes = changes_between(*scene, *next);
    const ScenePointer old = std::exchange(scene, std::move(next));
    solver.adopt(*scene, changes);
  }
  const ScpState& step(const Vector3& tip, double elapsed = 0.0) { return solver.step(tip, elapsed); }

  ScenePointer scene;
  ThesisSolver solver;
};

ScenePointer box_at(const Pose& pose, const Motion& motion = {}) {
  HapticObject box = object(1, thesis_leaf("box:0.1x0.1x0.1"), pose);
  box.motion = motion;
  return HapticScene::compile({box});
}

TEST(ThesisSolver, TouchesWhatTheTipGoesInto) {
  ThesisToucher toucher(box_at(translation(0.2, 0, 0)));
  EXPECT_FALSE(toucher.step({0.2, 0.0, 0.051}).touching);
  EXPECT_EQ(toucher.solver.state().scp, Vector3(0.2, 0.0, 0.051));
  const ScpState& state = toucher.step({0.2, 0.01, 0.049});
  EXPECT_TRUE(state.touching);
  EXPECT_FALSE(state.started_inside);
  EXPECT_TRUE(state.converged);
  EXPECT_LT((state.scp - Vector3(0.2, 0.01, 0.05)).norm(), 1e-15);
  EXPECT_LT((state.normal - Vector3::UnitZ()).norm(), 1e-15);
  EXPECT_EQ(state.object, 0u);
  EXPECT_FALSE(toucher.step({0.2, 0.01, 0.0501}).touching);
}

TEST(ThesisSolver, SaysWhenTheTipBeganInside) {
  ThesisToucher toucher(box_at(translation(0, 0, 0)));
  EXPECT_TRUE(toucher.step({0.0, 0.0, 0.049}).started_inside);
  EXPECT_FALSE(toucher.step({0.0, 0.0, 0.049}).started_inside);
  EXPECT_TRUE(toucher.solver.state().touching);
  toucher.solver.reset();
  EXPECT_TRUE(toucher.step({0.0, 0.0, 0.049}).started_inside);
}

TEST(ThesisSolver, AMovingObjectTakesTheScpAlong) {
  Motion motion;
  motion.linear = {0.1, 0.0, 0.0};
  ThesisToucher toucher(box_at(translation(0, 0, 0), motion));
  toucher.step({0.0, 0.0, 0.051}, 0.0);
  const ScpState& state = toucher.step({0.0, 0.0, 0.049}, 0.01);
  EXPECT_TRUE(state.touching);
  EXPECT_LT((state.surface_velocity - motion.linear).norm(), 1e-15);
  // A face comes from the side and pushes the tip, which never was inside before.
  ThesisToucher pushed(box_at(translation(0, 0, 0), motion));
  pushed.step({0.0505, 0.0, 0.0}, 0.0);
  EXPECT_FALSE(pushed.solver.state().touching);
  const ScpState& hit = pushed.step({0.0505, 0.0, 0.0}, 0.01);
  EXPECT_TRUE(hit.touching);
  EXPECT_FALSE(hit.started_inside);
  EXPECT_LT((hit.scp - Vector3(0.051, 0.0, 0.0)).norm(), 1e-12);
}

TEST(ThesisSolver, CarriesOnOverScenes) {
  ThesisToucher toucher(box_at(translation(0, 0, 0)));
  toucher.step({0.0, 0.0, 0.051});
  toucher.step({0.0, 0.0, 0.049});
  HapticObject other = object(9, thesis_leaf("sphere:0.01"), translation(1, 0, 0));
  HapticObject box = object(1, toucher.scene->objects()[0].shape, translation(0, 0, 0.001));
  toucher.show(HapticScene::compile({other, box}));
  EXPECT_TRUE(toucher.solver.state().touching);
  EXPECT_EQ(toucher.solver.state().object, 1u);  // its place in the new scene
  const ScpState& state = toucher.step({0.0, 0.0, 0.049});
  EXPECT_TRUE(state.touching);
  EXPECT_FALSE(state.started_inside);
  EXPECT_EQ(state.object, 1u);
  EXPECT_LT((state.scp - Vector3(0.0, 0.0, 0.051)).norm(), 1e-15);
}

TEST(ThesisSolver, AShapeThatComesOrGrowsAroundTheTipStartsInside) {
  ThesisToucher toucher(HapticScene::compile({}));
  EXPECT_FALSE(toucher.step({0.0, 0.0, 0.049}).touching);
  toucher.show(box_at(translation(0, 0, 0)));
  EXPECT_TRUE(toucher.step({0.0, 0.0, 0.049}).started_inside);
  // Felt already, and edited: it carries on.
  toucher.show(HapticScene::compile({object(1, thesis_leaf("box:0.1x0.1x0.11"))}));
  const ScpState& state = toucher.step({0.0, 0.0, 0.049});
  EXPECT_TRUE(state.touching);
  EXPECT_FALSE(state.started_inside);
  EXPECT_NEAR(state.scp.z(), 0.055, 1e-15);
  // Edited while the tip is beside it.
  EXPECT_FALSE(toucher.step({0.0, 0.0, 0.06}).touching);
  toucher.show(HapticScene::compile({object(1, thesis_leaf("box:0.1x0.1x0.13"))}));
  EXPECT_TRUE(toucher.step({0.0, 0.0, 0.06}).started_inside);
  toucher.show(HapticScene::compile({}));
  EXPECT_FALSE(toucher.solver.state().touching);
  EXPECT_FALSE(toucher.step({0.0, 0.0, 0.06}).touching);
}

TEST(ThesisSolver, FeelsNoWallBetweenObjectsThatTouch) {
  const auto plate = thesis_leaf("box:0.1x0.1x0.02");
  ThesisToucher toucher(HapticScene::compile(
      {object(1, plate, translation(-0.04, 0, 0)), object(2, plate, translation(0.04, 0, 0))}));
  for (double x = -0.06; x <= 0.06; x += 1e-3) {
    toucher.step({x, 0.0, 0.0101});
    const ScpState& state = toucher.step({x, 0.0, 0.0095});
    ASSERT_TRUE(state.touching);
    EXPECT_LT((state.scp - Vector3(x, 0.0, 0.01)).norm(), 1e-12) << x;
  }
}

TEST(ThesisSolver, AnswersInTheObjectsFrame) {
  Random random(5);
  const Pose pose = random_pose(random, 0.3);
  ThesisToucher toucher(box_at(pose));
  toucher.step(pose * Vector3(0.0, 0.051, 0.0));
  const ScpState& state = toucher.step(pose * Vector3(0.01, 0.048, 0.02));
  EXPECT_LT((state.scp - pose * Vector3(0.01, 0.05, 0.02)).norm(), 1e-12);
  EXPECT_LT((state.normal - pose.linear() * Vector3::UnitY()).norm(), 1e-12);
}

TEST(ThesisSolver, PassesOverWhatItCannotTouchAndSaysWhenThereIsTooMuch) {
  ThesisToucher toucher(HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))}));
  EXPECT_FALSE(toucher.step({0.0, 0.0, 0.049}).touching);
  std::vector<HapticObject> many;
  const auto ball = thesis_leaf("sphere:0.05");
  for (std::uint32_t i = 0; i < ThesisSolver::kMostObjects + 1; ++i) many.push_back(object(i + 1, ball));
  toucher.show(HapticScene::compile(many));
  EXPECT_FALSE(toucher.step({0.0, 0.0, 0.049}).converged);
  EXPECT_TRUE(toucher.solver.state().touching);
}

TEST(ThesisSolver, TouchesALoopSurface) {
  const auto levels = *geometry::LoopLevels::create({box_mesh({0.1, 0.1, 0.1}), {}, {}}, {.finest = 3});
  ThesisToucher toucher(HapticScene::compile({object(1, *ThesisLoopShape::create(levels))}));
  Vector3 tip(0.0, 0.0, 0.06);
  EXPECT_FALSE(toucher.step(tip).touching);
  while (!toucher.solver.state().touching && tip.z() > 0.0) toucher.step(tip -= Vector3(0, 0, 1e-3));
  const ScpState& state = toucher.step(tip);
  ASSERT_TRUE(state.touching);
  EXPECT_LT(brute_nearest(levels->level(3).mesh, state.scp).distance, 1e-12);
  EXPECT_GT(state.normal.z(), 0.9);
}

TEST(Renderer, IsChosenByName) {
  EXPECT_EQ(*parse_renderer("exact"), Renderer::Exact);
  EXPECT_EQ(*parse_renderer("limit"), Renderer::Exact);
  EXPECT_EQ(*parse_renderer("thesis"), Renderer::Thesis);
  ASSERT_FALSE(parse_renderer("Exact"));
  EXPECT_NE(parse_renderer("fast").error().message.find("exact, limit or thesis"), std::string::npos);
  EXPECT_NE(dynamic_cast<ThesisSolver*>(make_solver(Renderer::Thesis, {}).get()), nullptr);
  EXPECT_NE(dynamic_cast<ScpSolver*>(make_solver(Renderer::Exact, {}).get()), nullptr);
}

TEST(Renderer, SaysWhatItCannotTouch) {
  const ScenePointer own = box_at(translation(0, 0, 0));
  const ScenePointer plain = HapticScene::compile({object(1, shape_of(primitive("box:0.1x0.1x0.1")))});
  EXPECT_TRUE(check_renderer(Renderer::Thesis, *own, {}));
  EXPECT_TRUE(check_renderer(Renderer::Exact, *plain, {}));
  EXPECT_FALSE(check_renderer(Renderer::Exact, *own, {}));
  ASSERT_FALSE(check_renderer(Renderer::Thesis, *plain, {}));
  EXPECT_NE(check_renderer(Renderer::Thesis, *plain, {}).error().message.find("object 1"), std::string::npos);
  EXPECT_FALSE(check_renderer(Renderer::Thesis, *own, {.tip_radius = 0.001}));
}

}  // namespace
}  // namespace icome::haptics
