#include "session/display/part_outlines.h"

#include <gtest/gtest.h>

#include "interaction/operations/looks/texture_projector.h"
#include "world/sample_world.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Bounds;
using base::Vector3;
using geometry::CsgTree;
using world::ObjectId;

base::Bounds bounds_of_lines(const render::SceneOverlay& overlay) {
  Bounds bounds;
  for (const auto& line : overlay.lines)
    for (const Vector3& point : line.points)
      if (point.allFinite()) bounds.extend(point);
  return bounds;
}

/// One object of a shape, 1 m along x, and its outlines.
struct Outlined {
  world::World world;
  world::IdSource ids;
  ObjectId object;
  PartOutlines outlines;

  explicit Outlined(world::GeometryPointer shape) {
    object = world::add_object(world, ids, "it", std::move(shape), {}, world::at(1.0, 0.0, 0.0));
    outlines.renew(world, {}, std::vector{object});
  }
  Bounds bounds() const { return bounds_of_lines(outlines.overlay({})); }
};

world::GeometryPointer alone(geometry::CsgShape shape) {
  CsgTree tree;
  tree.add_leaf(std::move(shape), world::at(0.0, 0.5, 0.0));
  return std::make_shared<world::CsgGeometry>(std::move(tree));
}

TEST(PartOutlines, GhostsLieRoundTheirShapesWhereTheseStandInTheSolid) {
  const geometry::TriangleMesh ball = geometry::tessellate(geometry::Sphere{0.1}, 1e-3);
  for (const geometry::CsgShape& shape : std::vector<geometry::CsgShape>{
           geometry::Box{{0.1, 0.2, 0.3}}, geometry::Sphere{0.1}, geometry::Cylinder{0.1, 0.3},
           geometry::Cone{0.1, 0.0, 0.3}, geometry::Torus{0.2, 0.05}, geometry::Capsule{0.1, 0.2},
           std::make_shared<const geometry::MeshSolid>(
               geometry::tessellate(geometry::Box{{0.1, 0.2, 0.3}}, 0.1)),
           std::make_shared<const geometry::MeshSolid>(ball)}) {
    const Bounds wanted = geometry::shape_bounds(shape, world::at(1.0, 0.5, 0.0));
    const Bounds seen = Outlined(alone(shape)).bounds();
    EXPECT_LT((seen.min() - wanted.min()).norm(), 2e-3) << geometry::shape_name(shape);
    EXPECT_LT((seen.max() - wanted.max()).norm(), 2e-3) << geometry::shape_name(shape);
  }
  const Bounds plane = Outlined(alone(geometry::Primitive(geometry::Plane{}))).bounds();
  EXPECT_TRUE(plane.sizes().allFinite() && plane.sizes().maxCoeff() > 0.0);
  EXPECT_TRUE(Outlined(world::box(1.0)).outlines.empty()) << "an exact shape is all of one piece";
}

TEST(PartOutlines, ARayPicksTheGhostThatItPassesThoughItLiesInTheSolid) {
  CsgTree tree;
  const auto block = tree.add_leaf(geometry::Box{Vector3::Constant(0.5)});
  const auto hollow = tree.add_leaf(geometry::Sphere{0.2});
  tree.add(geometry::CsgOperator::Difference, block, hollow);
  const Outlined it(std::make_shared<world::CsgGeometry>(std::move(tree)));
  const auto picked = [&](double x, double y) {
    return it.outlines.pick({Vector3(x, y, 3.0), -Vector3::UnitZ()}, 1e-3);
  };
  const auto inner = picked(1.2003, 0.0);
  ASSERT_TRUE(inner);
  EXPECT_EQ(inner->part, (interaction::PlacedPart{it.object, hollow}));
  EXPECT_LT((inner->place.point - Vector3(1.2, 0.0, 0.0)).norm(), 1e-9);
  const auto outer = picked(1.4998, 0.1);
  ASSERT_TRUE(outer);
  EXPECT_EQ(outer->part.operand, block);
  EXPECT_FALSE(picked(1.3, 0.13)) << "between their lines";
  EXPECT_EQ(it.outlines.nearest(Vector3(1.0, 0.203, 0.0), 5e-3),
            (interaction::PlacedPart{it.object, hollow}));
  EXPECT_FALSE(it.outlines.nearest(Vector3(1.0, 0.21, 0.0), 5e-3));
}

TEST(PartOutlines, ProjectorsAreTheFrameOfOnePicture) {
  const world::GeometryPointer triangle = world::one_triangle();
  const auto& mesh = dynamic_cast<const world::MeshGeometry&>(*triangle);
  for (const auto projection :
       {geometry::TextureProjection::Planar, geometry::TextureProjection::Box,
        geometry::TextureProjection::Cylindrical, geometry::TextureProjection::Spherical}) {
    geometry::TextureProjector projector{.projection = projection};
    projector.mesh_from_projector = Affine3(Eigen::Scaling(2.0));
    const auto thrown = interaction::with_projector(mesh, projector);
    ASSERT_TRUE(thrown);
    const Bounds seen = Outlined(*thrown).bounds();
    EXPECT_NEAR(seen.center().x(), 1.0, 0.11);
    EXPECT_GE(seen.sizes().x(), 2.0 - 1e-9);
    EXPECT_LT(seen.sizes().maxCoeff(), 2.7);
  }
}

TEST(PartOutlines, WhatIsMarkedStandsOutAndGoesWithADragThatIsNoEditYet) {
  const Outlined it(alone(geometry::Sphere{0.1}));
  const interaction::PlacedPart part{it.object, 0};
  const auto plain = it.outlines.overlay({}).lines.at(0);
  const auto marked = it.outlines.overlay(MarkedPart{.part = part}).lines.at(0);
  EXPECT_GT(marked.width, plain.width);
  EXPECT_NE(marked.colour.red, plain.colour.red);
  const Bounds moved =
      bounds_of_lines(it.outlines.overlay(MarkedPart{.part = part, .motion = world::at(0.0, 0.0, 7.0)}));
  EXPECT_NEAR(moved.center().z(), 7.0, 1e-9);
}

}  // namespace
}  // namespace icome::session
