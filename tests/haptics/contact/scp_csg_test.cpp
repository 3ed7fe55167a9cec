// The surface contact point on CSG solids: known places, and random presses and slides against brute force.
#include <gtest/gtest.h>

#include <cstring>

#include "haptics/csg_touch.h"

namespace icome::haptics {
namespace {

ScenePointer csg_scene(const CsgTree& tree, const Pose& pose = Pose::Identity()) {
  return HapticScene::compile({object(1, shape_of(tree), pose)});
}

// ---- Known places

/// Where the SCP ends when the tip goes straight from `a` to `b`.
Vector3 pressed(const CsgTree& tree, const Vector3& a, const Vector3& b, int ticks = 20) {
  Toucher toucher(csg_scene(tree));
  toucher.step(a);
  const ScpState& state = toucher.go(a, b, ticks);
  EXPECT_TRUE(state.converged);
  return state.scp;
}

void expect_near(const Vector3& found, const Vector3& known, double tolerance = 1e-9) {
  EXPECT_LT((found - known).norm(), tolerance) << found.transpose() << " is not " << known.transpose();
}

TEST(ScpOnCsg, RestsOnTheFacesOfTheThesisFigure) {
  const CsgTree tree = figure_5_6();
  expect_near(pressed(tree, {0.03, 0.01, 0.06}, {0.03, 0.01, 0.045}), {0.03, 0.01, 0.05});  // the cube's
  const Vector3 corner(0.04, 0.04, 0.04);
  expect_near(pressed(tree, corner, 0.8 * corner), 0.065 * corner.normalized());        // the sphere's
  expect_near(pressed(tree, {0.0, 0.0, 0.01}, {0.03, 0.0, 0.01}), {0.025, 0.0, 0.01});  // the hole's
}

TEST(ScpOnCsg, HoldsInAConcaveEdgeAndCorner) {
  const CsgTree stairs = nasty::stairs().tree;
  expect_near(pressed(stairs, {-0.032, 0.0, 0.015}, {-0.025, 0.01, 0.006}), {-0.03, 0.01, 0.01});
  const CsgTree pocket = nasty::flush_pocket().tree;
  expect_near(pressed(pocket, {0.015, 0.015, 0.03}, {0.024, 0.023, -0.005}), {0.02, 0.02, 0.0});
}

TEST(ScpOnCsg, RestsOnTheEdgeCurveBetweenTwoCylinders) {
  const CsgTree tree = TreeChain(rod_shape(0.02, 0.1))
                           .unite(rod_shape(0.02, 0.1), turned(1.5707963267948966, Vector3::UnitX()))
                           .tree();
  // The valley is where |y| = |z|, x = sqrt(r^2 - y^2); the nearest place of it is where the plane of the
  // pull and the ellipse's normal agree: t = r (cos a, sin a, sin a).
  const Vector3 tip(0.006, 0.009, 0.009);
  double low = 0.0, high = 1.5707963267948966;
  for (int i = 0; i < 60; ++i) {
    const double a = 0.5 * (low + high), c = std::cos(a), s = std::sin(a);
    const double slope = (0.02 * c - tip.x()) * -s + 2.0 * (0.02 * s - tip.y()) * c;
    (slope > 0.0 ? high : low) = a;
  }
  const Vector3 known(0.02 * std::cos(low), 0.02 * std::sin(low), 0.02 * std::sin(low));
  expect_near(pressed(tree, {0.03, 0.03, 0.03}, tip), known);
}

TEST(ScpOnCsg, SlidesOverAConvexEdgeOnceItIsFree) {
  Toucher toucher(csg_scene(figure_5_6()));
  toucher.step({0.03, 0.0, 0.052});
  toucher.go({0.03, 0.0, 0.052}, {0.03, 0.0, 0.048}, 10);
  const Vector3 before = toucher.go({0.03, 0.0, 0.048}, {0.0251, 0.0, 0.048}, 50).scp;
  expect_near(before, {0.0251, 0.0, 0.05});
  const ScpState& after = toucher.step({0.0249, 0.0, 0.048});  // over the hole
  EXPECT_FALSE(after.touching);
}

TEST(ScpOnCsg, FeelsNoSeamBetweenFlushFaces) {
  for (const NamedTree& it : {nasty::abutting(), nasty::flush_union(), nasty::plugged()}) {
    for (const bool is_askew : {false, true}) {
      const NamedTree tree = is_askew ? askew(it) : it;
      const Affine3 place = tree.tree.node(tree.tree.root()).parent_from_node;
      Toucher toucher(csg_scene(tree.tree));
      toucher.step(place * Vector3(-0.03, 0.004, 0.03));
      toucher.step(place * Vector3(-0.03, 0.004, 0.018));
      for (int i = 0; i <= 600; ++i) {
        const Vector3 tip(-0.03 + 1e-4 * i, 0.004 + 1e-5 * i, 0.018);
        const ScpState& state = toucher.step(place * tip);
        expect_near(place.inverse() * state.scp, {tip.x(), tip.y(), 0.02});
        EXPECT_TRUE(state.converged);
        if (testing::Test::HasFailure()) FAIL() << tree.name << " " << i;
      }
    }
  }
}

TEST(ScpOnCsg, FeelsNoLidOverAFlushPocket) {
  for (const NamedTree& it : {nasty::flush_pocket(), askew(nasty::flush_pocket())}) {
    const Affine3 place = it.tree.node(it.tree.root()).parent_from_node;
    Toucher toucher(csg_scene(it.tree));
    for (int i = 0; i <= 100; ++i) {
      const Vector3 tip = place * Vector3(0.003, 0.004, 0.03 - 2.9e-4 * i);
      EXPECT_FALSE(toucher.step(tip).touching) << it << " " << i;
    }
    EXPECT_TRUE(toucher.step(place * Vector3(0.003, 0.004, -0.001)).touching);
  }
}

TEST(ScpOnCsg, HoldsAtAWallOfAFifthOfAMillimetre) {
  const CsgTree tree = nasty::thin_walls().tree;
  expect_near(pressed(tree, {0.004, 0.03, 0.0}, {-0.03, 0.03, 0.0}, 7), {0.0001, 0.03, 0.0});
  expect_near(pressed(tree, {-0.004, 0.03, 0.0}, {0.03, 0.03, 0.0}, 1), {-0.0001, 0.03, 0.0});
}

TEST(ScpOnCsg, ComesOutWhenItStartsInside) {
  for (const NamedTree& it : nasty_trees()) {
    const BruteSolid solid(it.tree);
    const ScenePointer scene = csg_scene(it.tree);
    Random random(11);
    PlacePicker places(solid, random, 0.1);
    for (int i = 0; i < repeats(20); ++i) {
      const Vector3 tip = places.solid();
      Toucher toucher(scene);
      const ScpState& state = toucher.step(tip);
      EXPECT_TRUE(state.started_inside && state.touching) << it << " " << i;
      EXPECT_GT(solid.bound(state.scp), -1e-10) << it << " " << i;
      EXPECT_LT(solid.bound(state.scp), 1e-9) << it << " " << i;
    }
  }
}

TEST(ScpOnCsg, TouchesNothingOfAnEmptySolid) {
  const CsgTree gone = TreeChain(ball_shape(0.02)).cut(box_shape(0.05, 0.05, 0.05)).tree();
  for (const CsgTree& tree : {CsgTree(), gone}) {
    Toucher toucher(csg_scene(tree));
    EXPECT_FALSE(toucher.go({0.05, 0.0, 0.0}, {-0.05, 0.001, 0.0}, 20).touching);
  }
}

TEST(ScpOnCsg, RestsInAConicalPit) {
  const CsgTree tree =
      TreeChain(box_shape(0.048, 0.048, 0.02)).cut(cone_shape(0.0, 0.005, 0.01), moved(0, 0, 0.008)).tree();
  expect_near(pressed(tree, {0.0005, 0.0, 0.01}, {0.0002, 0.0001, -0.005}, 1),
              {0.0, 0.0, 0.003});  // its apex
  const BruteSolid solid(tree);
  const ScenePointer scene = csg_scene(tree);
  Random random(1);
  for (int i = 0; i < repeats(2000); ++i) {
    const double rho = random.uniform(0.0, 0.0045), angle = random.uniform(0.0, 6.28);
    Toucher toucher(scene);
    toucher.step({rho * std::cos(angle), rho * std::sin(angle), 0.011});
    for (int pull = 0; pull < 5; ++pull) {  // from the apex to the apex, pulled all ways
      const Vector3 tip(random.uniform(-0.003, 0.003), random.uniform(-0.003, 0.003),
                        random.uniform(-0.009, 0.0025));
      const ScpState& state = toucher.step(tip);
      ASSERT_TRUE(state.converged) << i;
      ASSERT_GT(solid.bound(state.scp), -1e-9)
          << i << " " << tip.transpose() << " at " << state.scp.transpose();
      if (i % 250 != 0) continue;
      EXPECT_LT(brute_scp_error(solid, tip, state.scp, 0.1).error, 1e-6) << i;
    }
  }
}

// ---- Random presses and slides

struct TouchedTree {
  NamedTree it;
  int ticks;

  friend std::ostream& operator<<(std::ostream& out, const TouchedTree& tree) { return out << tree.it.name; }
};

std::vector<TouchedTree> touched_trees() {
  std::vector<TouchedTree> trees{{{"Figure56", figure_5_6()}, 10'000}};
  for (const NamedTree& it : nasty_trees()) {
    trees.push_back({it, 1000});
    trees.push_back({askew(it), 1000});
  }
  struct Sizes {
    std::size_t primitives;
    std::uint64_t first, count;
  };
  for (const Sizes& it :
       {Sizes{2, 0, 8}, {3, 0, 6}, {5, 0, 5}, {10, 0, 4}, {30, 0, 2}, {100, 0, 1}, {200, 0, 1}}) {
    for (std::uint64_t seed = it.first; seed < it.first + it.count; ++seed) {
      const std::string name = "Random" + std::to_string(it.primitives) + "of" + std::to_string(seed);
      trees.push_back({{name, random_tree(seed, it.primitives)}, it.primitives < 30 ? 1000 : 400});
    }
  }
  return trees;
}

class TouchedTrees : public testing::TestWithParam<TouchedTree> {};

INSTANTIATE_TEST_SUITE_P(Trees, TouchedTrees, testing::ValuesIn(touched_trees()),
                         [](const auto& it) { return it.param.it.name; });

TEST_P(TouchedTrees, GivesTheConstrainedPlaceAndNoPops) {
  const CsgTree& tree = GetParam().it.tree;
  TouchCheck check;
  check.sample = 40;
  check.report = [](const TouchFailure& failure) { ADD_FAILURE() << failure; };
  const auto path = random_touch(BruteSolid(tree), 7, std::size_t(repeats(GetParam().ticks)));
  const TouchFigures figures = CheckedTouch(tree, check).run(path);
  EXPECT_EQ(figures.failures, 0u);
}

/// Runs a path on a solid; fails on whatever is wrong with it.
std::vector<Vector3> checked_run(const CsgTree& tree, const std::vector<Vector3>& path,
                                 TouchCheck check = {}) {
  check.report = [](const TouchFailure& failure) { ADD_FAILURE() << failure; };
  return CheckedTouch(tree, check).run(path).scps;
}

TEST(ScpOnCsg, RepeatsItsBits) {
  const CsgTree tree = random_tree(3, 20);
  const auto path = random_touch(BruteSolid(tree), 9, std::size_t(repeats(1000)));
  const auto once = checked_run(tree, path, {.sample = 0});
  const auto again = checked_run(tree, path, {.sample = 0});
  EXPECT_EQ(std::memcmp(once.data(), again.data(), once.size() * sizeof(Vector3)), 0);
}

TEST(ScpOnCsg, IsAlikeInMetresAndMillimetres) {
  const auto path = random_touch(BruteSolid(figure_5_6()), 5, std::size_t(repeats(1000)));
  std::vector<Vector3> scaled;
  for (const Vector3& tip : path) scaled.push_back(1000.0 * tip);
  const auto metres = checked_run(figure_5_6(), path);
  const auto millimetres = checked_run(figure_5_6(1000.0), scaled, {.size = 100.0});
  for (std::size_t i = 0; i < path.size(); ++i) expect_near(1e-3 * millimetres[i], metres[i]);
}

TEST(ScpOnCsg, IsAlikeInAnyPose) {
  Random random(8);
  for (const CsgTree& tree : {figure_5_6(), nasty::crossed_holes().tree, nasty::flush_pocket().tree}) {
    const Pose pose = random_pose(random, 0.3);
    const auto path = random_touch(BruteSolid(tree), 15, std::size_t(repeats(800)));
    checked_run(tree, path, {.pose = pose});
  }
}

// ---- Solids that move and change

TEST(ScpOnCsg, IsCarriedByAMovingSolid) {
  Random random(4);
  for (const CsgTree& tree : {figure_5_6(), nasty::crossed_holes().tree, nasty::stairs().tree}) {
    const BruteSolid solid(tree);
    PlacePicker places(solid, random, 0.1);
    for (int i = 0; i < repeats(30); ++i) {
      HapticObject moving = object(1, shape_of(tree), random_pose(random, 0.1));
      moving.motion.linear = random.uniform(0.0, 0.3) * random.direction();
      moving.motion.angular = random.uniform(0.0, 3.0) * random.direction();
      const ScenePointer scene = HapticScene::compile({moving});
      Toucher toucher(scene);
      const Vector3 tip = moving.world_from_object * places.free();
      Vector3 last = moving.world_from_object.inverse() * tip;
      for (int tick = 0; tick < 90; ++tick) {
        const ScpState& state = toucher.solver.step(tip, 1e-3 * tick);
        const Pose object_from_world = scene->pose(0, 1e-3 * tick).inverse();
        const Vector3 scp = object_from_world * state.scp;
        ASSERT_GT(solid.bound(scp), -1e-9) << i << " " << tick;
        ASSERT_TRUE(state.converged) << i << " " << tick;
        ASSERT_NE(brute_way(solid, last, scp, scp, 0.1), Way::None) << i << " " << tick;
        if (state.touching && tick % 30 == 29) {
          EXPECT_LT(brute_scp_error(solid, object_from_world * tip, scp, 0.1).error, 1e-6)
              << i << " " << tick;
        }
        last = scp;
      }
    }
  }
}

}  // namespace
}  // namespace icome::haptics
