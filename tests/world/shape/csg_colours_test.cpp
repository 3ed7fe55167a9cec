#include "world/shape/csg_colours.h"

#include <gtest/gtest.h>

#include "world/sample_world.h"

namespace icome::world {
namespace {

using geometry::Box;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Primitive;
using geometry::Sphere;

std::shared_ptr<const MeshGeometry> coloured_triangles(const CsgTree& tree) {
  const auto surface = CsgGeometry(tree).triangles(0.05);
  EXPECT_TRUE(surface.has_value());
  return coloured_by_operands(tree, *surface);
}

TEST(ColouredByOperands, EachTriangleHasTheColourOfTheSurfaceThatItIsOn) {
  CsgTree tree;
  const auto block = tree.add_leaf(Primitive(Box{{1.0, 1.0, 1.0}}));
  const auto dent =
      tree.add_leaf(Primitive(Sphere{0.7}), at(0.0, 0.0, 1.0), CsgTree::Colour{1.0F, 0.0F, 0.0F, 1.0F});
  tree.add(CsgOperator::Difference, block, dent);
  const auto made = coloured_triangles(tree);
  ASSERT_EQ(made->colours.size(), made->mesh.triangles.size());
  std::size_t in_dent = 0;
  for (std::size_t t = 0; t < made->mesh.triangles.size(); ++t) {
    const Vector3 middle =
        (made->mesh.corner(t, 0) + made->mesh.corner(t, 1) + made->mesh.corner(t, 2)) / 3.0;
    const double off_ball = std::abs((middle - Vector3::UnitZ()).norm() - 0.7);
    const double off_block = std::abs(middle.cwiseAbs().maxCoeff() - 1.0);
    if (std::abs(off_ball - off_block) < 0.01) continue;  // along the rim either will do
    const Colour red = {1.0F, 0.0F, 0.0F};
    EXPECT_EQ(made->colours[t][0], off_ball < off_block ? red : kMaterialsColour) << middle.transpose();
    in_dent += off_ball < off_block;
  }
  EXPECT_GT(in_dent, 100u);
}

TEST(ColouredByOperands, TheFirstOfSurfacesThatCoincideCounts) {
  CsgTree tree;
  const auto first =
      tree.add_leaf(Primitive(Sphere{1.0}), at(0.0, 0.0, 0.0), CsgTree::Colour{0.0F, 0.0F, 1.0F, 1.0F});
  const auto second =
      tree.add_leaf(Primitive(Sphere{1.0}), at(0.0, 0.0, 0.0), CsgTree::Colour{0.0F, 1.0F, 0.0F, 1.0F});
  tree.add(CsgOperator::Union, first, second);
  const Colour blue = {0.0F, 0.0F, 1.0F};
  const auto coloured = coloured_triangles(tree);  // the loop alone would not keep it
  for (const auto& corners : coloured->colours) EXPECT_EQ(corners[0], blue);
}

TEST(ColouredByOperands, AThinSheetIsNotWhatItLiesOn) {
  const CsgTree::Colour grey{0.5F, 0.5F, 0.5F, 1.0F}, red{1.0F, 0.0F, 0.0F, 1.0F};
  CsgTree tree;
  const auto table = tree.add_leaf(Primitive(Box{{0.5, 0.5, 0.02}}), at(0.0, 0.0, -0.02), grey);
  const auto sheet = tree.add_leaf(Primitive(Box{{0.3, 0.2, 0.0002}}), at(0.0, 0.0, 0.0002), red);
  const auto both = tree.add(CsgOperator::Union, table, sheet);
  const auto badge = tree.add_leaf(Primitive(geometry::Cylinder{0.04, 0.0004}), at(0.4, 0.4, 0.0002), red);
  tree.add(CsgOperator::Union, both, badge);
  const auto made = coloured_triangles(tree);
  std::size_t above = 0;
  for (std::size_t t = 0; t < made->mesh.triangles.size(); ++t) {
    const double height =
        (made->mesh.corner(t, 0) + made->mesh.corner(t, 1) + made->mesh.corner(t, 2)).z() / 3.0;
    if (height > 1e-6 && height < 3.9e-4) continue;  // sides, which chords may leave
    const Colour expected = height > 1e-6 ? Colour{1.0F, 0.0F, 0.0F} : Colour{0.5F, 0.5F, 0.5F};
    EXPECT_EQ(made->colours[t][0], expected) << height;
    above += height > 1e-6;
  }
  EXPECT_GE(above, 4U);  // the top of the sheet is two triangles at least, and so is the badge's
}

TEST(ColouredByOperands, WithoutColoursTrianglesStayWhatTheyAre) {
  CsgTree tree;
  tree.add_leaf(Primitive(Sphere{1.0}));
  const auto surface = CsgGeometry(tree).triangles(0.1);
  ASSERT_TRUE(surface.has_value());
  EXPECT_EQ(coloured_by_operands(tree, *surface), *surface);
  const auto nothing = std::make_shared<const MeshGeometry>(geometry::TriangleMesh{});
  EXPECT_EQ(coloured_by_operands(CsgTree(), nothing), nothing);
}

}  // namespace
}  // namespace icome::world
