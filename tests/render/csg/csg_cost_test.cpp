#include "render/csg/csg_cost.h"

#include <gtest/gtest.h>

#include "render/csg_scenes.h"

namespace icome::render {
namespace {

using geometry::Box;
using geometry::CsgOperator;
using geometry::CsgTree;
using geometry::Cylinder;
using geometry::Primitive;

double cost(const CsgTree& tree) {
  const auto geometry = make_csg_geometry(tree);
  EXPECT_TRUE(geometry.has_value());
  const Camera camera = fit_camera(geometry->surface, {});
  return software_seconds(*geometry, camera.clip_from_world(), 1600.0 * 758.0);
}

TEST(SoftwareSeconds, GrowsWithOperandsThatOverlap) {
  EXPECT_LT(cost(figure_5_6()), 0.1);
  EXPECT_LT(cost(dented_ball(4)), cost(dented_ball(20)) / 5.0);
}

TEST(SoftwareSeconds, CountsOperandsSideBySideOnce) {
  CsgTree tree;
  auto solid = tree.add_leaf(Primitive(Box{{0.1, 0.1, 0.01}}));
  for (int i = 0; i < 40; ++i) {
    const auto hole = tree.add_leaf(Primitive(Cylinder{0.004, 0.04}),
                                    moved_by(0.02 * (i % 8) - 0.07, 0.03 * (i / 8) - 0.06, 0.0));
    solid = tree.add(CsgOperator::Difference, solid, hole);
  }
  EXPECT_LT(cost(tree), cost(dented_ball(40)) / 5.0);
}

TEST(ReasonAgainstImages, IsTheTimeWhereItWouldBeLong) {
  const auto context = Offscreen::create();
  if (!context || !context->has_built_in_pipeline() || !context->is_software()) {
    GTEST_SKIP() << "no OpenGL in software here; install libgl1-mesa-dri";
  }
  const auto small = make_csg_geometry(figure_5_6());
  const auto large = make_csg_geometry(dented_ball(60));
  ASSERT_TRUE(small.has_value() && large.has_value());
  const Matrix4 clip = fit_camera(large->surface, {}).clip_from_world();
  EXPECT_FALSE(reason_against_images(*context, *small, clip, 1e6).has_value());
  const auto reason = reason_against_images(*context, *large, clip, 1e6);
  ASSERT_TRUE(reason.has_value());
  EXPECT_NE(reason->find("61 operands"), std::string::npos) << *reason;
}

}  // namespace
}  // namespace icome::render
