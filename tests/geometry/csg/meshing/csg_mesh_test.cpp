#include "geometry/csg/meshing/csg_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "geometry/csg_meshed.h"
#include "geometry/csg_trees.h"
#include "geometry/mesh/mesh_topology.h"

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

/// The cube of half size 0.5 without six caps of the ball and without the hole.
double volume_of_figure_5_6() {
  const double ball = 0.65, half = 0.5, drill = 0.25;
  const double height = ball - half;
  const double caps = 6 * std::numbers::pi * height * height * (3 * ball - height) / 3;
  return 4 * std::numbers::pi / 3 * ball * ball * ball - caps - 2 * half * std::numbers::pi * drill * drill;
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

TEST(CsgMesh, PlatesThatAreMeshesKeepTheirThickness) {
  for (const double thickness : {0.02, 1e-6}) {
    CsgTree tree;
    const auto plate = tree.add_leaf(mesh_solid(box_mesh({-0.5, -0.5, 0.0}, {0.5, 0.5, thickness})));
    const auto foot = tree.add_leaf(Primitive(Box{Vector3::Constant(0.2)}), moved(0.0, 0.0, -0.3));
    tree.add(CsgOperator::Union, plate, foot);
    const ContourMesh made = csg_meshed(tree, 0.036);
    EXPECT_FALSE(made.lost);
    EXPECT_NEAR(volume(made.mesh), thickness + 0.4 * 0.4 * 0.4, 1e-9);
    EXPECT_LE(made.mesh.triangles.size(), 60u);
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
