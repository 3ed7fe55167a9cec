#include "geometry/csg/csg_edges.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "geometry/csg_trees.h"

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
  // One along x through a thicker one along y: no face is flush with another.
  CsgTree tree;
  const auto thin = tree.add_leaf(Primitive(Box{{0.6, 0.1, 0.1}}));
  const auto thick = tree.add_leaf(Primitive(Box{{0.1, 0.6, 0.2}}));
  tree.add(CsgOperator::Union, thin, thick);
  const double ends_of_thin = 2 * 4 * 0.2 + 2 * 4 * 0.5, all_of_thick = 4 * (0.2 + 0.4 + 1.2);
  const double where_they_meet = 2 * 4 * 0.2;  // concave
  for (const bool askew : {false, true}) {
    if (askew) tree.set_transform(tree.root(), standing_askew());
    const auto edges = csg_edges(CsgFaces(tree, 0.0));
    ASSERT_TRUE(edges);
    EXPECT_NEAR(length_of(*edges), ends_of_thin + all_of_thick + where_they_meet, 1e-6);
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
  // Arcs of bent edges overlap.
  constexpr int kParts = 90;
  std::array<std::array<bool, kParts>, 2> met{};
  std::vector<CurveArc> straight;
  for (const CurveArc& arc : *edges) {
    if (arc.sagitta() == 0.0) straight.push_back(arc);
    for (int i = 0; arc.sagitta() > 0.0 && i <= 100; ++i) {
      const Vector3 place =
          standing_askew().inverse() * arc.at(arc.first() + 0.01 * i * (arc.last() - arc.first()));
      EXPECT_NEAR(std::hypot(place.x(), place.y()), 0.2, 1e-8);
      EXPECT_NEAR(std::abs(place.z()), 0.1, 1e-8);
      const double turns = std::atan2(place.y(), place.x()) / (2.0 * std::numbers::pi) + 0.5;
      met[place.z() > 0.0][std::min(std::size_t(kParts * turns), std::size_t(kParts - 1))] = true;
    }
  }
  for (const auto& rim : met) EXPECT_EQ(std::count(rim.begin(), rim.end(), true), kParts);
  EXPECT_NEAR(length_of(straight), 8 * 1.0 + 4 * 0.2, 1e-6);
}

}  // namespace
}  // namespace icome::geometry
