#include "geometry/csg/meshing/csg_mesh_check.h"

#include <gtest/gtest.h>

#include "geometry/csg/meshing/csg_mesh.h"
#include "geometry/mesh/mesh_topology.h"

namespace icome::geometry {
namespace {

using Index = CsgTree::Index;
using Translation = Eigen::Translation3d;

CsgTree two_balls(double gap) {
  CsgTree tree;
  const double away = 0.5 + 0.5 * gap;
  const Index left = tree.add_leaf(Sphere{0.5}, Affine3(Translation(-away, 0.0, 0.0)));
  const Index right = tree.add_leaf(Sphere{0.5}, Affine3(Translation(away, 0.0, 0.0)));
  tree.add(CsgOperator::Union, left, right);
  return tree;
}

CsgTree rod_through_ball(double radius) {
  CsgTree tree;
  const Index ball = tree.add_leaf(Sphere{0.5});
  const Affine3 tilt(base::Quaternion(Eigen::AngleAxisd(0.6, Eigen::Vector3d(1.0, 0.3, 0.2).normalized())));
  tree.add(CsgOperator::Union, ball, tree.add_leaf(Cylinder{radius, 1.0}, tilt));
  return tree;
}

ContourMesh meshed(const CsgTree& tree, double cells) {
  return contour(tree, {.cell = bounds(tree).sizes().maxCoeff() / cells, .measures = false}).value();
}

TEST(CsgMeshCheck, BodiesThatNearlyTouchStayApart) {
  for (const double cells : {28.0, 60.0, 100.0})
    for (const double gap : {0.02, 0.01, 0.004, 0.002, 0.001, 0.0003}) {
      const ContourMesh made = meshed(two_balls(gap), cells);
      EXPECT_FALSE(made.lost) << gap;
      EXPECT_EQ(analyse_topology(made.mesh).report.components, 2U) << gap << " m in " << cells << " cells";
    }
}

// Whatever comes of a thin rod, it is whole or it is told.
TEST(CsgMeshCheck, ARodInCrumbsIsNoMeshOfIt) {
  int told = 0;
  for (const double radius : {0.02, 0.006, 0.003, 0.002, 0.001}) {
    const ContourMesh made = meshed(rod_through_ball(radius), 28.0);
    told += made.lost ? 1 : 0;
    EXPECT_TRUE(made.lost || analyse_topology(made.mesh).report.components == 1) << radius;
  }
  EXPECT_LT(told, 4);
}

TEST(CsgMeshCheck, FindsAMeshThatJoinsWhatIsApart) {
  // One ball for two that nearly touch has all their surface within a cell, but for the gap.
  const CsgTree apart = two_balls(0.02);
  CsgTree joined = apart;
  const Index both = joined.root();
  joined.add(CsgOperator::Union, both, joined.add_leaf(Sphere{0.03}));
  const ContourMesh made = meshed(joined, 100.0);
  const auto place = place_that_mesh_lacks(CsgProgram(apart), made.mesh, 0.07, 0.0);
  ASSERT_TRUE(place);
  EXPECT_LT(place->norm(), 0.035);
  EXPECT_FALSE(place_that_mesh_lacks(CsgProgram(apart), meshed(apart, 100.0).mesh, 0.07, 0.0));
}

}  // namespace
}  // namespace icome::geometry
