#include "geometry/csg/csg_emptiness.h"

#include <gtest/gtest.h>

#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace {

CsgTree both(CsgOperator op, const Primitive& one, const Primitive& other, const Affine3& at) {
  CsgTree tree;
  const auto left = tree.add_leaf(one);
  const auto right = tree.add_leaf(other, at);
  tree.add(op, left, right);
  return tree;
}

bool empty(const CsgTree& tree) { return proved_empty(CsgProgram(tree)); }

TEST(CsgEmptiness, WhatLeavesNothingIsEmpty) {
  const Primitive ball = Sphere{0.5}, cube = Box{Vector3::Constant(0.5)};
  EXPECT_TRUE(empty(CsgTree{}));
  // Their boxes meet, but they do not.
  EXPECT_TRUE(empty(both(CsgOperator::Intersection, ball, ball, moved(0.8, 0.8, 0))));
  EXPECT_TRUE(empty(both(CsgOperator::Difference, ball, ball, moved(0, 0, 0))));
  EXPECT_TRUE(
      empty(both(CsgOperator::Difference, ball, Primitive(Box{Vector3::Constant(0.51)}), moved(0, 0, 0))));
  EXPECT_TRUE(empty(both(CsgOperator::Difference, ball, Primitive(Sphere{0.6}), moved(0.05, 0, 0))));
  // They share a face only.
  EXPECT_TRUE(empty(both(CsgOperator::Intersection, cube, cube, moved(1, 0, 0))));

  CsgTree part = both(CsgOperator::Intersection, ball, cube, moved(0.3, 0, 0));
  const auto left = part.root(), right = part.add_leaf(ball);
  part.add(CsgOperator::Difference, left, right);
  EXPECT_TRUE(empty(part));
}

TEST(CsgEmptiness, WhatIsThinIsNot) {
  const Primitive ball = Sphere{0.5}, cube = Box{Vector3::Constant(0.5)};
  EXPECT_FALSE(empty(both(CsgOperator::Difference, ball, Primitive(Sphere{0.5 - 1e-6}), moved(0, 0, 0))));
  EXPECT_FALSE(empty(both(CsgOperator::Intersection, cube, cube, moved(1 - 1e-6, 0, 0))));
  EXPECT_FALSE(empty(both(CsgOperator::Intersection, ball, ball, moved(1 - 1e-6, 0, 0))));
  CsgTree plate;
  plate.add_leaf(Primitive(Box{{100, 100, 1e-5}}));
  EXPECT_FALSE(empty(plate));
  CsgTree half_space;
  half_space.add_leaf(Primitive(Plane{}));
  EXPECT_FALSE(empty(half_space));
}

TEST(CsgEmptiness, AgreesWithPointsOfRandomTrees) {
  base::Random random(5);
  int empties = 0;
  for (std::size_t i = 0; i < 300 / kLongShare; ++i) {
    SCOPED_TRACE(i);
    RandomTreeOptions options;
    options.leaves = 2 + random.index(6);
    const CsgTree tree = random_tree(random, options);
    if (!empty(tree)) continue;
    ++empties;
    for (int k = 0; k < 2000; ++k) {
      const Vector3 point(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3));
      ASSERT_FALSE(inside(tree, point));
    }
  }
  EXPECT_GT(empties, 0);
}

}  // namespace
}  // namespace icome::geometry
