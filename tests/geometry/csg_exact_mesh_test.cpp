// Solids that are cut out as what they are, flat or thin: one thread does that.
#include <gtest/gtest.h>

#include <numbers>

#include "csg_meshed.h"
#include "csg_trees.h"

namespace icome::geometry {
namespace {

using base::Random;

/// Boxes whose corners have whole coordinates below `size`, put together at random.
CsgTree random_boxes(Random& random, int leaves, int size) {
  CsgTree tree;
  CsgTree::Index root = 0;
  for (int i = 0; i < leaves; ++i) {
    Vector3 low, high;
    for (int k = 0; k < 3; ++k) {
      const auto a = int(random.index(std::size_t(size)));
      low[k] = a;
      high[k] = a + 1 + int(random.index(std::size_t(size - a)));
    }
    const Vector3 middle = 0.5 * (low + high);
    const auto leaf =
        tree.add_leaf(Primitive(Box{0.5 * (high - low)}), moved(middle.x(), middle.y(), middle.z()));
    const std::size_t choice = random.index(5);
    const CsgOperator op = choice < 2   ? CsgOperator::Union
                           : choice < 4 ? CsgOperator::Difference
                                        : CsgOperator::Intersection;
    root = i == 0 ? leaf : tree.add(op, root, leaf);
  }
  return tree;
}

/// Its volume in unit cubes, of which the reference asks the middles.
int unit_cubes(const CsgTree& tree, int size) {
  int cubes = 0;
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      for (int z = 0; z < size; ++z) cubes += inside(tree, Vector3(x + 0.5, y + 0.5, z + 0.5));
    }
  }
  return cubes;
}

Affine3 tilted() {
  Affine3 placing = Affine3::Identity();
  placing.rotate(Eigen::AngleAxisd(1.1, Vector3(0.3, -0.5, 0.8).normalized()));
  return placing;
}

CsgTree placed(CsgTree tree, const Affine3& placing) {
  tree.set_transform(tree.root(), placing * tree.node(tree.root()).parent_from_node);
  return tree;
}

CsgTree with_hole(const Primitive& whole, const Primitive& hole, const Affine3& at = Affine3::Identity()) {
  CsgTree tree;
  const auto left = tree.add_leaf(whole);
  const auto right = tree.add_leaf(hole, at);
  tree.add(CsgOperator::Difference, left, right);
  return tree;
}

TEST(CsgMesh, BoxesAreExactAndOfFewTriangles) {
  Random random(17);
  constexpr int kSize = 6;
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const CsgTree tree = random_boxes(random, 2 + int(random.index(7)), kSize);
    const int cubes = unit_cubes(tree, kSize);
    if (cubes == 0) continue;
    const CsgTree turned_tree = i % 2 == 0 ? tree : placed(tree, tilted());
    const ContourMesh made = csg_meshed(turned_tree, 0.06);
    EXPECT_NEAR(volume(made.mesh), cubes, 1e-6);
    EXPECT_LT(made.error, 1e-7);
    EXPECT_FALSE(made.lost);
    EXPECT_LT(made.mesh.triangles.size(), 600u);
    if (HasFailure()) return;
  }
}

TEST(CsgMesh, CubeLessACubeHasTensOfTriangles) {
  const CsgTree notched =
      with_hole(Box{Vector3::Constant(0.5)}, Box{Vector3::Constant(0.5)}, moved(0.6, 0.7, 0.8));
  for (const CsgTree& tree : {notched, placed(notched, tilted())}) {
    const ContourMesh made = csg_meshed(tree, 0.01);
    EXPECT_LE(made.mesh.triangles.size(), 40u);
    EXPECT_NEAR(volume(made.mesh), 1.0 - 0.4 * 0.3 * 0.2, 1e-9);
    EXPECT_EQ(euler_characteristic(made.mesh), 2);
  }
}

TEST(CsgMesh, SlitsStayOpenHoweverNarrow) {
  for (const double width : {0.002, 1e-5}) {
    const CsgTree slit =
        with_hole(Box{Vector3::Constant(0.5)}, Box{{0.5 * width, 0.6, 0.4}}, moved(0, 0, 0.2));
    for (const double cell : {0.036, 0.01}) {
      for (const CsgTree& tree : {slit, placed(slit, tilted())}) {
        const ContourMesh made = csg_meshed(tree, cell);
        EXPECT_NEAR(volume(made.mesh), 1.0 - width * 0.7, 1e-9);
        EXPECT_EQ(euler_characteristic(made.mesh), 2);
        EXPECT_FALSE(made.lost);
      }
    }
  }
  // Between a cylinder and its hole: two parts, of which the outer is a ring.
  CsgTree bearing = with_hole(Cylinder{0.3, 0.2}, Cylinder{0.2, 0.4});
  const auto ring = bearing.root();
  bearing.add(CsgOperator::Union, ring, bearing.add_leaf(Primitive(Cylinder{0.1995, 0.2})));
  const ContourMesh made = csg_meshed(bearing, 0.01);
  EXPECT_EQ(analyse_topology(made.mesh).report.components, 2u);
  EXPECT_EQ(euler_characteristic(made.mesh), 0 + 2);
  EXPECT_FALSE(made.lost);
}

TEST(CsgMesh, DrilledPlatesKeepThicknessAndHole) {
  const double pi = std::numbers::pi;
  for (const double thickness : {0.018, 0.005, 1e-4}) {
    const CsgTree plate = with_hole(Box{{0.5, 0.5, 0.5 * thickness}}, Cylinder{0.1, 0.3});
    for (const CsgTree& tree : {plate, placed(plate, tilted())}) {
      for (const double cell : {0.036, 0.01}) {
        SCOPED_TRACE(testing::Message() << thickness << " " << cell);
        const ContourMesh made = csg_meshed(tree, cell);
        EXPECT_NEAR(volume(made.mesh) / (thickness * (1.0 - pi * 0.01)), 1.0, 0.005);
        EXPECT_EQ(euler_characteristic(made.mesh), 0);
        EXPECT_FALSE(made.lost);
      }
    }
  }
}

TEST(CsgMesh, BallThatTouchesAPlateAndOneThatDipsIn) {
  for (const double dip : {0.0, 1e-3}) {
    CsgTree tree;
    const auto plate = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.05}}));
    const auto ball = tree.add_leaf(Primitive(Sphere{0.2}), moved(0.1, 0.07, 0.25 - dip));
    tree.add(CsgOperator::Union, plate, ball);
    const ContourMesh made = csg_meshed(tree, 0.01);
    EXPECT_NEAR(volume(made.mesh) / (0.1 + 4 * std::numbers::pi / 3 * 0.008), 1.0, 0.005);
    EXPECT_FALSE(made.lost);
    if (dip > 0.0) {
      EXPECT_EQ(euler_characteristic(made.mesh), 2);
    }
  }
}

}  // namespace
}  // namespace icome::geometry
