#include "geometry/csg/csg_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.h"
#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace csg_tree_test {
namespace {

using Op = CsgOperator;

const Primitive kCube = Box{Vector3::Constant(0.5)};

TEST(CsgTree, EmptyTreeIsTheEmptySolid) {
  const CsgTree tree;
  EXPECT_TRUE(tree.empty());
  EXPECT_FALSE(inside(tree, Vector3::Zero()));
  EXPECT_TRUE(bounds(tree).isEmpty());
  EXPECT_EQ(count(tree).nodes, 0u);
  EXPECT_EQ(count(tree).depth, 0u);
  EXPECT_TRUE(tree.tree_from_node().empty());
}

TEST(CsgTree, CountsTheTreeOfFigure56) {
  CsgTree tree;
  const auto cube = tree.add_leaf(kCube);
  const auto sphere = tree.add_leaf(Primitive(Sphere{0.65}));
  const auto rounded = tree.add(Op::Intersection, cube, sphere);
  tree.add(Op::Difference, rounded, tree.add_leaf(Primitive(Cylinder{0.2, 2.0})));
  const CsgCount counted = count(tree);
  EXPECT_EQ(counted.nodes, 5u);
  EXPECT_EQ(counted.primitives, 3u);
  EXPECT_EQ(counted.depth, 3u);
  EXPECT_TRUE(inside(tree, {0.3, 0.3, 0.3}));
  EXPECT_FALSE(inside(tree, {0.0, 0.0, 0.0}));     // in the hole
  EXPECT_FALSE(inside(tree, {0.45, 0.45, 0.45}));  // rounded away
}

TEST(CsgTree, OnlyWhatIsBelowTheRootCounts) {
  CsgTree tree;
  const auto left = tree.add_leaf(kCube, moved(1, 0, 0));
  const auto right = tree.add_leaf(Primitive(Sphere{0.5}), moved(5, 0, 0));
  const auto both = tree.add(Op::Union, left, right, moved(0, 10, 0));
  EXPECT_EQ(tree.root(), both);
  EXPECT_TRUE(inside(tree, {5, 10, 0}));
  tree.set_root(left);
  EXPECT_EQ(count(tree).nodes, 1u);
  EXPECT_EQ(bounds(tree).center(), Vector3(1, 0, 0));  // not moved by what is above
  EXPECT_TRUE(inside(tree, {1, 0, 0}));
  EXPECT_FALSE(inside(tree, {5, 10, 0}));
}

TEST(CsgTree, TransformsStack) {
  CsgTree tree;
  Affine3 twice = Affine3::Identity();
  twice.linear() *= 2.0;
  const auto leaf = tree.add_leaf(kCube, moved(1, 0, 0));
  const auto other = tree.add_leaf(kCube);
  const auto inner = tree.add(Op::Union, leaf, other, twice);
  tree.add(Op::Union, inner, tree.add_leaf(kCube), moved(0, 0, 3));
  const std::vector<Affine3> frames = tree.tree_from_node();
  EXPECT_EQ(frames[leaf] * Vector3(0, 0, 0), Vector3(2, 0, 3));
  EXPECT_EQ(frames[leaf] * Vector3(0.5, 0, 0), Vector3(3, 0, 3));
  EXPECT_TRUE(inside(tree, {3, 0, 3}));
  EXPECT_FALSE(inside(tree, {3.01, 0, 3}));
  EXPECT_EQ(bounds(tree).max(), Vector3(3, 1, 4));
}

TEST(CsgTree, EditsChangeTheSolid) {
  CsgTree tree;
  const auto left = tree.add_leaf(kCube);
  const auto right = tree.add_leaf(kCube, moved(0.5, 0, 0));
  const auto root = tree.add(Op::Union, left, right);
  EXPECT_TRUE(inside(tree, {0.9, 0, 0}));
  tree.set_operator(root, Op::Intersection);
  EXPECT_FALSE(inside(tree, {0.9, 0, 0}));
  EXPECT_TRUE(inside(tree, {0.25, 0, 0}));
  tree.set_transform(right, moved(10, 0, 0));
  EXPECT_FALSE(inside(tree, {0.25, 0, 0}));
  EXPECT_TRUE(bounds(tree).isEmpty());
}

TEST(CsgTree, BoundsFollowTheRulesOf555) {
  CsgTree tree;
  const auto a = tree.add_leaf(kCube);
  const auto b = tree.add_leaf(kCube, moved(0.5, 0, 0));
  const auto root = tree.add(Op::Union, a, b);
  EXPECT_EQ(bounds(tree).max(), Vector3(1, 0.5, 0.5));
  tree.set_operator(root, Op::Intersection);
  EXPECT_EQ(bounds(tree).min(), Vector3(0, -0.5, -0.5));
  EXPECT_EQ(bounds(tree).max(), Vector3(0.5, 0.5, 0.5));
  tree.set_operator(root, Op::Difference);
  EXPECT_EQ(bounds(tree).max(), Vector3(0.5, 0.5, 0.5));
}

TEST(CsgTree, EmptyOperandsDoNotDisturbTheBoundsOfAUnion) {
  CsgTree tree;
  const auto nothing =
      tree.add(Op::Intersection, tree.add_leaf(kCube, moved(9, 0, 0)), tree.add_leaf(kCube, moved(-9, 0, 0)));
  tree.add(Op::Union, nothing, tree.add_leaf(kCube));
  EXPECT_EQ(bounds(tree).min(), Vector3::Constant(-0.5));
  EXPECT_EQ(bounds(tree).max(), Vector3::Constant(0.5));
}

TEST(CsgTree, SurfacesCountAsTheLeavesSay) {
  CsgTree tree;
  const auto a = tree.add_leaf(kCube);
  const auto b = tree.add_leaf(kCube, moved(1, 0, 0));
  const auto root = tree.add(Op::Intersection, a, b);
  EXPECT_TRUE(inside(tree, {0.5, 0, 0}));  // the face that they share
  tree.set_operator(root, Op::Difference);
  EXPECT_FALSE(inside(tree, {0.5, 0, 0}));
}

TEST(CsgTree, InsideAgreesWithRecursion) {
  base::Random random(11);
  for (int i = 0; i < 200; ++i) {
    const CsgTree tree = random_tree(random, {.leaves = 1 + random.index(30)});
    const Bounds box = bounds(tree);
    for (int j = 0; j < 30; ++j) {
      const Vector3 point = random.uniform(0.0, 1.5) * random.direction();
      const bool expected = recursively_inside(tree, point);
      ASSERT_EQ(inside(tree, point), expected) << "tree " << i << " at " << point.transpose();
      EXPECT_TRUE(!expected || box.contains(point));
    }
  }
}

TEST(CsgTree, AMillionNodesInARowAreNoTrouble) {
  const std::size_t operations = 500'000 / kLongShare;  // a million nodes
  for (const bool left_deep : {true, false}) {
    CsgTree tree = chain(operations, left_deep, {Op::Union});
    EXPECT_EQ(tree.tree_from_node().size(), tree.size());
    for (const Op op : {Op::Union, Op::Intersection, Op::Difference}) {
      for (CsgTree::Index i = 2; i < tree.size(); i += 2) tree.set_operator(i, op);
      const CsgCount counted = count(tree);
      EXPECT_EQ(counted.nodes, 2 * operations + 1);
      EXPECT_EQ(counted.depth, operations + 1);
      // A box of 0.5 and half a million of 0.25, all in the same place.
      const bool outer = inside(tree, {0.4, 0, 0});
      const bool inner = inside(tree, {0.1, 0, 0});
      if (op == Op::Union) {
        EXPECT_TRUE(outer && inner);
        EXPECT_EQ(bounds(tree).max().x(), 0.5);
      } else if (op == Op::Intersection) {
        EXPECT_TRUE(!outer && inner);
        EXPECT_EQ(bounds(tree).max().x(), 0.25);
      } else {
        EXPECT_EQ(outer, left_deep);  // from the right: small - (small - (... - large))
        EXPECT_EQ(bounds(tree).max().x(), left_deep ? 0.5 : 0.25);
      }
    }
  }
}

TEST(CsgTree, AChainWithATransformAtEveryNodeStaysPrecise) {
  CsgTree tree;
  CsgTree::Index deep = tree.add_leaf(kCube);
  const int operations = 1000;
  for (int i = 0; i < operations; ++i) {
    const auto leaf = tree.add_leaf(kCube, moved(100, 0, 0));
    deep = tree.add(Op::Union, leaf, deep, moved(0.125, 0, 0));
  }
  EXPECT_TRUE(inside(tree, {operations * 0.125 + 0.5, 0, 0}));
  EXPECT_EQ(tree.tree_from_node()[0].translation().x(), operations * 0.125);
}

}  // namespace
}  // namespace csg_tree_test
}  // namespace icome::geometry
