#include "geometry/csg_edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "csg_trees.h"

namespace icome::geometry {
namespace {

double length_of(const std::vector<CurveArc>& edges) {
  constexpr int kSteps = 64;
  double length = 0.0;
  for (const CurveArc& arc : edges) {
    const double step = (arc.last() - arc.first()) / kSteps;
    for (int i = 0; i < kSteps; ++i)
      length += (arc.at(arc.first() + (i + 1) * step) - arc.at(arc.first() + i * step)).norm();
  }
  return length;
}

Affine3 standing_askew() {
  Affine3 placing = Affine3::Identity();
  placing.rotate(Eigen::AngleAxisd(0.9, Vector3(0.2, 0.7, -0.4).normalized()));
  placing.pretranslate(Vector3(0.3, -0.2, 0.1));
  return placing;
}

TEST(CsgEdges, BlockWithManySquareHolesHasTheEdgesOfAll) {
  constexpr int kHoles = 5;
  constexpr double kHalf = 0.02, kThick = 0.3;
  CsgTree tree;
  CsgTree::Index root = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.5 * kThick}}));
  for (int i = 0; i < kHoles; ++i) {
    for (int k = 0; k < kHoles; ++k) {
      const auto hole =
          tree.add_leaf(Primitive(Box{{kHalf, kHalf, 1.0}}), moved(0.16 * (i - 2), 0.16 * (k - 2), 0));
      root = tree.add(CsgOperator::Difference, root, hole);
    }
  }
  const double block = 8 * 1.0 + 4 * kThick, hole = 2 * 4 * 2 * kHalf + 4 * kThick;
  for (const bool askew : {false, true}) {
    if (askew) tree.set_transform(tree.root(), standing_askew());
    const auto edges = csg_edges(CsgFaces(tree, 0.0));
    ASSERT_TRUE(edges);
    EXPECT_NEAR(length_of(*edges), block + kHoles * kHoles * hole, 1e-6);
    for (const CurveArc& arc : *edges) EXPECT_EQ(arc.sagitta(), 0.0);
  }
}

TEST(CsgEdges, BarsThroughEachOtherHaveTheEdgesOfTheirUnion) {
  // Three bars along the axes: each ends in 4 + 8 rims and runs to the cube in the middle, twice.
  CsgTree tree;
  CsgTree::Index root = 0;
  for (int axis = 0; axis < 3; ++axis) {
    Vector3 half = Vector3::Constant(0.1);
    half[axis] = 0.6;
    const auto bar = tree.add_leaf(Primitive(Box{half}));
    root = axis == 0 ? bar : tree.add(CsgOperator::Union, root, bar);
  }
  // Where bars meet, the four lines of each end at the cube's side make its 12 edges, concave.
  const double rims = 6 * 4 * 0.2, along = 6 * 4 * 0.5, cube = 12 * 0.2;
  for (const bool askew : {false, true}) {
    if (askew) tree.set_transform(root, standing_askew());
    const auto edges = csg_edges(CsgFaces(tree, 0.0));
    ASSERT_TRUE(edges);
    EXPECT_NEAR(length_of(*edges), rims + along + cube, 1e-6);
  }
}

TEST(CsgEdges, RimsOfAHoleAreCircles) {
  CsgTree tree;
  const auto plate = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.1}}));
  const auto hole = tree.add_leaf(Primitive(Cylinder{0.2, 1.0}));
  tree.add(CsgOperator::Difference, plate, hole);
  tree.set_transform(tree.root(), standing_askew());
  const auto edges = csg_edges(CsgFaces(tree, 0.0));
  ASSERT_TRUE(edges);
  EXPECT_NEAR(length_of(*edges), 8 * 1.0 + 4 * 0.2 + 2 * 2 * std::numbers::pi * 0.2, 1e-3);
}

}  // namespace
}  // namespace icome::geometry
