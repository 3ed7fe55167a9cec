#include "geometry/csg_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "closed_mesh.h"
#include "csg_trees.h"
#include "geometry/mesh_topology.h"

namespace icome::geometry {
namespace {

using base::Random;

/// Figure 5.6 of the thesis: a cube rounded by a ball, with a hole: (cube & ball) - cylinder.
CsgTree figure_5_6(double scale) {
  CsgTree tree;
  const auto cube = tree.add_leaf(Primitive(Box{Vector3::Constant(0.5 * scale)}));
  const auto ball = tree.add_leaf(Primitive(Sphere{0.65 * scale}));
  const auto rounded = tree.add(CsgOperator::Intersection, cube, ball);
  const auto drill = tree.add_leaf(Primitive(Cylinder{0.25 * scale, 2 * scale}));
  tree.add(CsgOperator::Difference, rounded, drill);
  return tree;
}

void expect_closed(const TriangleMesh& mesh) {
  const MeshReport report = analyse_topology(mesh).report;
  EXPECT_EQ(report.boundary_edges + report.non_manifold_edges + report.inconsistent_edges, 0u);
  EXPECT_TRUE(is_closed(mesh));
}

ContourMesh csg_meshed(const CsgTree& tree, double cell) {
  auto made = contour(tree, {.cell = cell});
  EXPECT_TRUE(made.has_value()) << (made ? "" : made.error().message);
  if (!made) return {};
  expect_closed(made->mesh);
  return std::move(*made);
}

/// The cube of half size 0.5 without six caps of the ball and without the hole.
double volume_of_figure_5_6() {
  const double pi = std::numbers::pi, ball = 0.65, half = 0.5, drill = 0.25;
  const double height = ball - half;
  const double caps = 6 * pi * height * height * (3 * ball - height) / 3;
  return 4 * pi / 3 * ball * ball * ball - caps - 2 * half * pi * drill * drill;
}

TEST(CsgMesh, TreeOfFigure56HasTheRightShapeAndVolume) {
  for (const double cell : {0.1, 0.05}) {
    const ContourMesh made = csg_meshed(figure_5_6(1.0), cell);
    EXPECT_EQ(euler_characteristic(made.mesh), 0);  // one hole
    EXPECT_NEAR(signed_volume(made.mesh) / volume_of_figure_5_6(), 1.0, cell * cell);
    EXPECT_LT(made.error, cell * cell);
    for (const Vector3& position : made.mesh.positions) {
      const double cube = position.cwiseAbs().maxCoeff() - 0.5, ball = position.norm() - 0.65;
      const double drill = 0.25 - std::hypot(position.x(), position.y());
      EXPECT_NEAR(std::max({cube, ball, drill}), 0.0, 1e-3 * cell);
    }
  }
}

TEST(CsgMesh, TreeInAnotherUnitGivesTheSameMesh) {
  const ContourMesh metres = csg_meshed(figure_5_6(1.0), 0.08);
  const ContourMesh millimetres = csg_meshed(figure_5_6(1.0 / 1024), 0.08 / 1024);
  EXPECT_EQ(metres.mesh.triangles.size(), millimetres.mesh.triangles.size());
  EXPECT_NEAR(metres.error, 1024 * millimetres.error, 1e-6 * metres.error);
}

TEST(CsgMesh, RandomTreesGiveClosedMeshesOfTheirSolid) {
  Random random(3);
  for (std::size_t i = 0; i < 40 / kLongShare; ++i) {
    SCOPED_TRACE(i);
    RandomTreeOptions options;
    options.leaves = 2 + random.index(12);
    CsgTree tree = random_tree(random, options);
    const auto frame = tree.add_leaf(Primitive(Box{Vector3::Constant(1.0)}));  // limits half-spaces
    tree.add(CsgOperator::Intersection, frame - 1, frame);
    const double cell = 0.1;
    const ContourMesh made = csg_meshed(tree, cell);

    // Against the share of random points that the reference says are inside.
    const int throws = 20000;
    int hits = 0;
    for (int k = 0; k < throws; ++k) {
      const Vector3 point(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      hits += inside(tree, point);
    }
    const double share = static_cast<double>(hits) / throws;
    const double spread = std::sqrt(share * (1 - share) / throws);
    // Parts thinner than a cell may be lost or joined: some of the volume near the surface.
    const double thin = 0.2 * cell * surface_area(made.mesh) / 8;
    EXPECT_NEAR(signed_volume(made.mesh) / 8, share, 5 * spread + thin + 0.002);
    if (HasFailure()) return;
  }
}

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

TEST(CsgMesh, WhatIsLostIsTold) {
  // Plates that are meshes cannot be cut out, and smaller cells do not find one of a micrometre.
  for (const double thickness : {0.02, 1e-6}) {
    CsgTree tree;
    const auto plate = tree.add_leaf(mesh_solid(box_mesh({-0.5, -0.5, 0.0}, {0.5, 0.5, thickness})));
    const auto foot = tree.add_leaf(Primitive(Box{Vector3::Constant(0.2)}), moved(0.0, 0.0, -0.3));
    tree.add(CsgOperator::Union, plate, foot);
    const auto made = contour(tree, {.cell = 0.036, .measures = false});
    ASSERT_TRUE(made.has_value()) << made.error().message;
    EXPECT_EQ(made->lost.has_value(), thickness < 0.01);
    if (made->lost) {
      EXPECT_NEAR(made->lost->z(), 0.0, 1e-5);
    }
  }
}

TEST(CsgMesh, EmptyAndUnlimitedTrees) {
  const auto nothing = contour(CsgTree{}, {.cell = 0.1});
  ASSERT_TRUE(nothing.has_value());
  EXPECT_TRUE(nothing->mesh.triangles.empty());

  CsgTree apart;
  const auto one = apart.add_leaf(Primitive(Sphere{0.1}));
  const auto other = apart.add_leaf(Primitive(Sphere{0.1}), moved(1, 0, 0));
  apart.add(CsgOperator::Intersection, one, other);
  const auto empty = contour(apart, {.cell = 0.01});
  ASSERT_TRUE(empty.has_value());
  EXPECT_TRUE(empty->mesh.triangles.empty());

  CsgTree half_space;
  half_space.add_leaf(Primitive(Plane{}));
  const auto unlimited = contour(half_space, {.cell = 0.1});
  ASSERT_FALSE(unlimited.has_value());
  EXPECT_NE(unlimited.error().message.find("intersect it with a box"), std::string::npos);
}

}  // namespace
}  // namespace icome::geometry
