// What the judge evaluates by itself, against what it must not share code with.
#include "haptics/judge/plain_solid.h"

#include <gtest/gtest.h>

#include "geometry/mesh/geodesic_sphere.h"
#include "haptics/contact_world.h"
#include "haptics/csg_world.h"
#include "haptics/judge/plain_cells.h"
#include "haptics/judge/witness_tree.h"

namespace icome::haptics {
namespace {

using geometry::CsgOperator;
using geometry::CsgTree;

Vector3 place_about(Random& random, double reach) {
  return reach * Vector3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

TEST(PlainDistance, AgreesWithThatOfPrimitives) {
  Random random(1);
  for (const char* text : {"plane", "box:0.1x0.06x0.02", "sphere:0.05", "cylinder:0.03x0.1", "cone:0.04x0.1",
                           "cone:0.01x0.05x0.08", "torus:0.05x0.02", "capsule:0.02x0.06"}) {
    const geometry::Primitive it = primitive(text);
    for (int i = 0; i < 2000; ++i) {
      const Vector3 place = place_about(random, 0.1);
      EXPECT_NEAR(plain_distance(it, place), geometry::signed_distance(it, place), 1e-15) << text;
    }
  }
}

std::shared_ptr<const geometry::MeshSolid> polyhedron() {
  return std::make_shared<geometry::MeshSolid>(geometry::bumpy_geodesic_sphere(4, 0.04, 0.005, 2));
}

/// A chain of operations on shapes of all kinds at random places, stretched; or a tree that branches.
CsgTree random_plain_tree(Random& random, int leaves, bool chain) {
  CsgTree tree;
  std::vector<CsgTree::Index> open;
  const auto leaf = [&] {
    base::Affine3 placed(random_pose(random, 0.03).matrix());
    placed.scale(Vector3(random.uniform(0.5, 1.5), random.uniform(0.5, 1.5), random.uniform(-1.5, -0.5)));
    const char* texts[] = {"box:0.05x0.06x0.04", "sphere:0.03", "cone:0.03x0.05"};
    const std::size_t kind = random.index(4);
    return kind < 3 ? tree.add_leaf(primitive(texts[kind]), placed) : tree.add_leaf(polyhedron(), placed);
  };
  const auto join = [&](CsgTree::Index a, CsgTree::Index b) {
    return tree.add(CsgOperator(random.index(3)), a, b, base::Affine3(random_pose(random, 0.005).matrix()));
  };
  CsgTree::Index root = leaf();
  for (int i = 1; i < leaves; ++i) {
    const CsgTree::Index other = chain || i + 1 >= leaves ? leaf() : join(leaf(), leaf());
    root = random.index(2) == 0 ? join(root, other) : join(other, root);
  }
  return tree;
}

TEST(PlainSolid, AgreesWithTheWalkOverTheTree) {
  Random random(2);
  int held = 0;
  for (int round = 0; round < 60; ++round) {
    const CsgTree tree = random_plain_tree(random, 2 + round % 7, round % 2 == 0);
    const MembershipSolid solid = plain_solid(tree);
    for (int i = 0; i < 300; ++i) {
      const Vector3 place = place_about(random, 0.05);
      const bool inside = geometry::inside(tree, place);
      held += inside;
      ASSERT_EQ(solid.inside(place, 0.0), inside) << round << ": " << place.transpose();
    }
  }
  EXPECT_GT(held, 1000);
}

TEST(PlainSolid, IsQuickToAskHoweverDeepTheTree) {
  CsgTree tree;
  CsgTree::Index root = tree.add_leaf(primitive("sphere:0.05"));
  for (int i = 0; i < 50'000; ++i)  // far away: each takes nothing off
    root = tree.add(CsgOperator::Difference, root,
                    tree.add_leaf(primitive("sphere:0.001"),
                                  base::Affine3(Eigen::Translation3d(1.0 + 0.01 * i, 0.0, 0.0))));
  const MembershipSolid solid = plain_solid(tree);
  EXPECT_TRUE(solid.inside({0.049, 0, 0}, 0.0));
  EXPECT_FALSE(solid.inside({0.051, 0, 0}, 0.0));
}

TEST(PlainSolid, OfNothingHoldsNothing) { EXPECT_FALSE(plain_solid({}).inside(Vector3::Zero(), 0.0)); }

TEST(WitnessTree, FindsWhatBruteForceFinds) {
  Random random(3);
  const MeshPointer mesh = shared(geometry::bumpy_geodesic_sphere(7, 0.05, 0.01, 3));
  const WitnessTree tree(mesh);
  for (int i = 0; i < 300; ++i) {
    const Vector3 a = place_about(random, 0.07), b = place_about(random, 0.07);
    EXPECT_NEAR(tree.distance(a, 1.0), brute_nearest(*mesh, a).distance, 1e-15);
    EXPECT_EQ(tree.distance(a, 1e-4), std::min(1e-4, tree.distance(a, 1.0)));
    EXPECT_EQ(winding(tree, a), std::lround(brute_winding(*mesh, a)));
    bool met = false;
    tree.along(
        a, b, [&](std::uint32_t triangle) { met |= crossing(tree.corners(triangle), a, b - a).has_value(); });
    EXPECT_EQ(met, brute_crosses(*mesh, a, b, true));
  }
}

TEST(WitnessTree, CountsOverlappingPartsAndSeesThroughCavities) {
  TriangleMesh mesh =
      joined(box_mesh(Vector3::Constant(0.1)), box_mesh(Vector3::Constant(0.1)), {0.05, 0, 0});
  TriangleMesh cavity = box_mesh(Vector3::Constant(0.02));
  for (auto& triangle : cavity.triangles) std::swap(triangle[1], triangle[2]);
  mesh = joined(mesh, cavity, {-0.03, 0, 0});
  const WitnessTree tree(shared(mesh));
  EXPECT_EQ(winding(tree, {0.02, 0.001, 0.002}), 2);
  EXPECT_EQ(winding(tree, {0.09, 0.001, 0.002}), 1);
  EXPECT_EQ(winding(tree, {-0.03, 0.001, 0.002}), 0);
  EXPECT_EQ(winding(tree, {-0.06, 0.0, 0.0}), 0);
}

TEST(PlainSolid, FindsTheNearestOfItsPlaces) {
  // A plate with a needle on it; the needle is thinner than what samples in some directions would find.
  CsgTree tree;
  const auto plate = tree.add_leaf(primitive("box:0.1x0.1x0.01"));
  base::Affine3 up = base::Affine3::Identity();
  up.translation() = Vector3(0.0, 0.0, 0.02);
  const auto needle = tree.add_leaf(primitive("cylinder:0.0005x0.03"), up);
  tree.add(CsgOperator::Union, plate, needle);
  const MembershipSolid solid = plain_solid(tree);
  Random random(9);
  for (int i = 0; i < repeats(400); ++i) {
    const Vector3 place(random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01),
                        random.uniform(0.006, 0.04));
    const double beside = std::hypot(place.x(), place.y()) - 0.0005;
    const double above = std::max(0.0, place.z() - 0.035);
    const double distance = std::min(place.z() - 0.005, std::hypot(std::max(0.0, beside), above));
    const auto found = solid.nearest(place, 0.0, 0.02, 2e-5);
    EXPECT_EQ(found.has_value(), distance < 0.02);
    if (!found) continue;
    EXPECT_NEAR((*found - place).norm(), distance, 2e-5);
    EXPECT_TRUE(solid.inside(*found, 0.0));
  }
}

TEST(PlainSolid, FindsTheSameNearestPlaceWhateverWasAskedBefore) {
  constexpr double kReach = 0.02, kFineness = 2e-4;
  Random random(21);
  int found = 0;
  for (int round = 0; round < 6; ++round) {
    const CsgTree tree = random_plain_tree(random, 2 + round, round % 2 == 0);
    const MembershipSolid asked = plain_solid(tree);
    for (int i = 0; i < repeats(60); ++i) {
      const Vector3 place = place_about(random, 0.06);
      const auto now = asked.nearest(place, 0.0, kReach, kFineness);
      const auto afresh = plain_solid(tree).nearest(place, 0.0, kReach, kFineness);
      ASSERT_EQ(now.has_value(), afresh.has_value()) << round;
      if (!now) continue;
      ++found;
      ASSERT_TRUE(geometry::inside(tree, *now));
      ASSERT_NEAR((*now - place).norm(), (*afresh - place).norm(), kFineness);
    }
  }
  EXPECT_GT(found, repeats(60));
}

TEST(PlainSolid, KnowsHowFarASlitIsBelowASphereThatRestsOnIt) {
  // A sphere on both edges of a slit sinks in by some micrometres: less than cubes are small.
  constexpr double kWide = 0.0003, kRadius = 0.002;
  const CsgTree tree =
      TreeChain(box_shape(0.06, 0.06, 0.06)).cut(box_shape(kWide, 0.08, 0.06), moved(0.0, 0.0, 0.02)).tree();
  const MembershipSolid solid = plain_solid(tree);
  const double height = std::sqrt(kRadius * kRadius - 0.25 * kWide * kWide);
  Random random(22);
  for (int i = 0; i < repeats(200); ++i) {
    const double off = random.uniform(-2e-4, 2e-4), up = random.uniform(-1e-4, 3e-4);
    const Vector3 centre(off, random.uniform(-0.02, 0.02), 0.03 + height + up);
    const double expected = std::hypot(std::max(0.0, 0.5 * kWide - std::abs(off)), height + up);
    const auto found = solid.nearest(centre, 0.0, 0.0025, 4e-5);
    ASSERT_TRUE(found);
    ASSERT_GE((*found - centre).norm(), expected - 1e-12);
    ASSERT_LE((*found - centre).norm(), expected + 2.0 * 4e-5);  // to a cube, and within it
    ASSERT_FALSE(solid.nearest(centre, 0.0, expected - 1e-9, 4e-5));
  }
}

TEST(PlainCells, AreForgottenWhenThereAreTooMany) {
  std::vector<PlainStep> ball(1);
  ball[0].bound = [](const Vector3& place) { return place.norm() - 0.05; };
  PlainCells cells(ball);
  Random random(23);
  std::size_t most = 0, last = 0;
  bool forgotten = false;
  for (int i = 0; i < 20'000 && !forgotten; ++i) {
    const Vector3 place = 0.0505 * random.direction();
    const auto found = cells.nearest(place, 0.002, 2e-6);
    ASSERT_TRUE(found);
    ASSERT_NEAR((*found - place).norm(), 0.0005, 2e-6);
    forgotten = cells.kept() < last;
    last = cells.kept();
    most = std::max(most, last);
  }
  EXPECT_TRUE(forgotten);
  EXPECT_LT(most, PlainCells::kMostKept + PlainCells::kMostKept / 8);
}

TEST(PlainSolid, TellsTheJudgeOfANeedleInASphereTip) {
  CsgTree tree;
  base::Affine3 aside = base::Affine3::Identity();
  aside.rotate(Eigen::AngleAxisd(0.3, Vector3(1.0, 2.0, 0.5).normalized()));
  tree.add_leaf(primitive("cylinder:0.0002x0.02"), aside);
  const Vector3 along = aside.linear() * Vector3::UnitZ();
  JudgeSettings settings;
  settings.tip_radius = 0.005;
  ContactJudge judge({{plain_solid(tree)}}, settings);
  const Vector3 tip = 0.012 * along;  // the needle ends 2 mm away
  EXPECT_TRUE(judge.judge({.tip = tip, .scp = tip, .touching = false}).pop);
}

}  // namespace
}  // namespace icome::haptics
