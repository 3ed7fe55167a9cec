#include "geometry/csg/meshing/csg_settle.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "geometry/csg_trees.h"

namespace icome::geometry {
namespace {

/// Atoms 0 to 2: side, bottom and top.
CsgTree lone_cylinder(double radius, double height) {
  CsgTree tree;
  tree.add_leaf(Primitive(Cylinder{radius, height}));
  return tree;
}

TEST(CsgSettle, CornersOfChordsGoOntoTheRim) {
  const CsgTree tree = lone_cylinder(1.0, 2.0);
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  TriangleMesh mesh;
  mesh.positions = {{0.9, 0.0, 1.0}, {0.0, 1.0, 1.0}, {0.0, 0.0, 1.0}, {1.0, 0.0, 0.0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  settle_vertices(mesh, {2, 0}, surfaces);
  EXPECT_LT((mesh.positions[0] - Vector3(1.0, 0.0, 1.0)).norm(), 1e-12);
  EXPECT_LT((mesh.positions[2] - Vector3(0.0, 0.0, 1.0)).norm(), 1e-12);
}

TEST(CsgSettle, NoTriangleIsTurnedOver) {
  const CsgTree tree = lone_cylinder(1.0, 2.0);
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  TriangleMesh mesh;
  mesh.positions = {{0.9, 0.0, 1.0}, {0.95, 0.3, 1.0}, {0.95, -0.3, 1.0}, {1.5, 0.0, 0.5}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 1}};
  const TriangleMesh before = mesh;
  settle_vertices(mesh, {2, 0}, surfaces);
  EXPECT_EQ(mesh.positions[0], before.positions[0]);
}

TEST(CsgSettle, ChordsStandForBentFacesWhileTheyAreNear) {
  const CsgTree tree = lone_cylinder(1.0, 2.0);
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  const ChordJudge judge(program, surfaces, 0.1);  // 0.003 off
  const auto strip = [](double angle) {
    return std::array<Vector3, 3>{Vector3(1.0, 0.0, -0.8), Vector3(std::cos(angle), std::sin(angle), -0.8),
                                  Vector3(1.0, 0.0, 0.8)};
  };
  EXPECT_TRUE(judge.stands_for(0, strip(0.14)));   // 1 - cos(0.07) = 0.0024
  EXPECT_FALSE(judge.stands_for(0, strip(0.17)));  // 0.0036
  EXPECT_TRUE(judge.stands_for(1, strip(2.0)));    // planes have no chords
}

TEST(CsgSettle, ChordsAreNearAgainstTheirWall) {
  // A tube with a wall of 0.01: chords of both sides may be a twentieth of that off, however large its hole.
  CsgTree tree;
  const auto whole = tree.add_leaf(Primitive(Cylinder{1.0, 2.0}));
  const auto hole = tree.add_leaf(Primitive(Cylinder{0.99, 3.0}));
  tree.add(CsgOperator::Difference, whole, hole);
  const CsgProgram program(tree);
  const CsgSurfaces surfaces(program);
  const ChordJudge judge(program, surfaces, 1.0);
  for (const double angle : {0.05, 0.1, 0.35}) {  // 0.0003, 0.0012 and, beyond the wall, 0.015 off
    const Vector3 along(std::cos(angle), std::sin(angle), 0.0), up(0.0, 0.0, 0.8);
    const std::array<Vector3, 3> outside{Vector3::UnitX() - up, along - up, Vector3::UnitX() + up};
    EXPECT_EQ(judge.stands_for(0, outside), angle < 0.08) << angle;
    const std::array<Vector3, 3> within{0.99 * along - up, 0.99 * Vector3::UnitX() - up,
                                        0.99 * Vector3::UnitX() + up};
    EXPECT_EQ(judge.stands_for(3, within), angle < 0.08) << angle;
  }
}

}  // namespace
}  // namespace icome::geometry
