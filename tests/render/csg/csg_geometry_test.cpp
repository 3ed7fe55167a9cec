#include "render/csg/csg_geometry.h"

#include <gtest/gtest.h>

#include "render/csg_scenes.h"

namespace icome::render {
namespace {

using base::Vector3;
using geometry::Box;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Cylinder;
using geometry::Primitive;
using geometry::Sphere;

TEST(MakeCsgGeometry, ListsTheOperandsOfAProduct) {
  const auto made = make_csg_geometry(figure_5_6());
  ASSERT_TRUE(made.has_value()) << made.error().message;
  ASSERT_EQ(made->products.size(), 1U);
  ASSERT_EQ(made->operand_count(), 3U);
  const CsgOperands& product = made->products.front();
  EXPECT_FALSE(product[0].subtracted);
  EXPECT_FALSE(product[1].subtracted);
  EXPECT_TRUE(product[2].subtracted);
  for (const CsgOperand& operand : product) EXPECT_EQ(operand.layers, 1U);
}

TEST(MakeCsgGeometry, LetsSubtractedOperandsReachBeyondFlushFaces) {
  CsgTree tree;
  const auto block = tree.add_leaf(Primitive(Box{{0.05, 0.05, 0.05}}));
  const auto hole = tree.add_leaf(Primitive(Cylinder{0.02, 0.1}));
  tree.add(CsgOperator::Difference, block, hole);
  const auto made = make_csg_geometry(tree);
  ASSERT_TRUE(made.has_value());
  const CsgOperands& product = made->products.front();
  const double beyond = product[1].bounds.max().z() - product[0].bounds.max().z();
  EXPECT_GT(beyond, 2e-5);
  EXPECT_LT(beyond, 1e-3);
  // All of the block's faces move alike: the corners go out along all three axes.
  EXPECT_NEAR(product[0].bounds.max().x(), product[0].bounds.max().z(), 1e-7);
}

TEST(MakeCsgGeometry, SpreadsPointsOverTheSurface) {
  const CsgTree tree = figure_5_6();
  const auto made = make_csg_geometry(tree);
  ASSERT_TRUE(made.has_value());
  ASSERT_GT(made->surface.size(), 1'000U);
  base::Bounds box;
  for (const Vector3& point : made->surface) {
    box.extend(point);
    const Vector3 outward = 1e-3 * point;  // the solid is star-shaped but for its hole
    const bool on_wall = point.head<2>().norm() < 0.029;
    EXPECT_TRUE(on_wall || !inside(tree, point + outward)) << point.transpose();
  }
  // The cube's faces, not the ball's poles.
  EXPECT_NEAR(box.max().z(), 0.05, 1e-9);
  EXPECT_NEAR(box.min().x(), -0.05, 1e-9);
}

TEST(MakeCsgGeometry, RefusesASolidWithoutBounds) {
  CsgTree tree;
  const auto plane = tree.add_leaf(Primitive(geometry::Plane{}));
  const auto ball = tree.add_leaf(Primitive(Sphere{0.1}));
  tree.add(CsgOperator::Union, plane, ball);
  const auto made = make_csg_geometry(tree);
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("without bounds"), std::string::npos);
}

TEST(MakeCsgGeometry, RefusesTooManyOperandsOrTriangles) {
  CsgGeometryOptions options;
  options.max_operands = 5;
  EXPECT_FALSE(make_csg_geometry(dented_ball(8), options).has_value());
  EXPECT_TRUE(make_csg_geometry(dented_ball(4), options).has_value());
  options.max_triangles = 1'000;
  const auto made = make_csg_geometry(dented_ball(4), options);
  ASSERT_FALSE(made.has_value());
  EXPECT_NE(made.error().message.find("1000 triangles"), std::string::npos);
}

TEST(MakeCsgGeometry, MakesNothingOfNothing) {
  const auto made = make_csg_geometry(CsgTree());
  ASSERT_TRUE(made.has_value());
  EXPECT_EQ(made->operand_count(), 0U);
  EXPECT_TRUE(made->surface.empty());
}

}  // namespace
}  // namespace icome::render
