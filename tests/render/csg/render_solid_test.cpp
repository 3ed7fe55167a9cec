#include "render/csg/render_solid.h"

#include <gtest/gtest.h>

#include "render/csg_scenes.h"

namespace icome::render {
namespace {

using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Cylinder;
using geometry::Primitive;
using geometry::Sphere;

std::shared_ptr<const RenderSolid> solid_of(const CsgTree& tree) {
  const auto made = make_drawn_solid(world::CsgGeometry(tree));
  EXPECT_TRUE(made.has_value() && made->surface);
  return made ? made->solid : nullptr;
}

/// Two balls and a stick between them, in shares of the distance.
CsgTree dumb_bell(double stick) {
  CsgTree tree;
  const auto left = tree.add_leaf(Primitive(Sphere{0.2}), moved_by(0.0, 0.0, -0.5));
  const auto right = tree.add_leaf(Primitive(Sphere{0.2}), moved_by(0.0, 0.0, 0.5));
  const auto balls = tree.add(CsgOperator::Union, left, right);
  tree.add(CsgOperator::Union, balls, tree.add_leaf(Primitive(Cylinder{stick, 1.0})));
  return tree;
}

TEST(DrawnSolid, HasCoarseTrianglesWhereImagesAreDrawnSoon) {
  const auto solid = solid_of(figure_5_6());
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->triangles, RenderSolid::Triangles::Coarse);
  EXPECT_EQ(solid->images.operand_count(), 3u);
}

TEST(DrawnSolid, HasFineTrianglesWhereImagesTakeLong) {
  const auto solid = solid_of(dented_ball(15));
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->triangles, RenderSolid::Triangles::Fine);
}

TEST(DrawnSolid, KnowsWhichPartsAreTooThinForTriangles) {
  const auto thick = solid_of(dumb_bell(0.05));
  const auto thread = solid_of(dumb_bell(0.0005));
  ASSERT_TRUE(thick && thread);
  EXPECT_EQ(thick->triangles, RenderSolid::Triangles::Coarse);
  EXPECT_EQ(thread->triangles, RenderSolid::Triangles::Partial);
}

TEST(DrawnSolid, OverlappingProductsOfAUnionHideNothingThatIsMissed) {
  CsgTree tree;
  auto solid = tree.add_leaf(Primitive(Sphere{0.1}));
  for (int i = 1; i < 5; ++i)
    solid = tree.add(CsgOperator::Union, solid,
                     tree.add_leaf(Primitive(Sphere{0.1}), moved_by(0.06 * i, 0.0, 0.02 * i)));
  ASSERT_TRUE(solid_of(tree));
  EXPECT_EQ(solid_of(tree)->triangles, RenderSolid::Triangles::Coarse);
}

TEST(DrawnSolid, EmptyOnesHaveNoImagesAndEndlessOnesFail) {
  const auto empty = make_drawn_solid(world::CsgGeometry(CsgTree()));
  ASSERT_TRUE(empty.has_value());
  EXPECT_FALSE(empty->solid);
  EXPECT_TRUE(empty->surface->mesh.triangles.empty());
  CsgTree endless;
  endless.add_leaf(Primitive(geometry::Plane{}));
  EXPECT_FALSE(make_drawn_solid(world::CsgGeometry(endless)).has_value());
}

}  // namespace
}  // namespace icome::render
