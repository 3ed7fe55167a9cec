#include "sketch/relief/relief.h"

#include <gtest/gtest.h>

#include <cmath>

#include "world/shape/mesh_geometry.h"

namespace icome::sketch {
namespace {

constexpr double kInMm = 0.001;

/// A drawing of one straight line of 2 mm width from (100, 100) to (120, 100) mm.
Drawing one_line() {
  Drawing drawing;
  Layer layer;
  layer.id = drawing.next_layer_id();
  layer.name = "Lines";
  auto stroke = std::make_shared<Stroke>();
  stroke->id = drawing.next_stroke_id();
  stroke->curve.segments = {CubicBezier::line({0.1, 0.1}, {0.12, 0.1})};
  stroke->curve.widths = {{0.0, 2.0 * kInMm, 1.0, 2.0 * kInMm}};
  stroke->colour = {1.0F, 0.0F, 0.0F};
  stroke->ends = CurveEnds::Flat;
  layer.strokes.push_back(std::move(stroke));
  drawing.layers.push_back(std::move(layer));
  return drawing;
}

const world::PhysicalObject* object_named(const world::World& world, const std::string& name) {
  for (const auto& [id, object] : world.objects())
    if (object.name == name) return &object;
  return nullptr;
}

std::shared_ptr<const world::MeshGeometry> mesh_of(const world::World& world,
                                                   const world::PhysicalObject& object) {
  return world.find(object.geometry)->shape->triangles(1e-3).value();
}

double volume_of(const geometry::TriangleMesh& mesh) {
  double sixfold = 0.0;
  for (const auto& triangle : mesh.triangles)
    sixfold +=
        mesh.positions[triangle[0]].dot(mesh.positions[triangle[1]].cross(mesh.positions[triangle[2]]));
  return sixfold / 6.0;
}

// The middle of A4 across is (148.5, 105) mm, so the line lies at x from -48.5 to -28.5 and y from 4 to 6.
TEST(Relief, PutsARidgeWhereTheLineIs) {
  const auto world =
      relief_of(one_line(), {.heights = {.height = 0.5 * kInMm}, .paper = find_paper("paper").value()});
  ASSERT_TRUE(world) << world.error().message;
  const world::PhysicalObject* ridge = object_named(*world, "stroke 2");
  ASSERT_NE(ridge, nullptr);
  const auto mesh = mesh_of(*world, *ridge);
  const base::Bounds box = mesh->bounds();
  EXPECT_LT((box.min() - base::Vector3(-0.0485, 0.004, 0.0)).norm(), 1e-6);
  EXPECT_LT((box.max() - base::Vector3(-0.0285, 0.006, 0.0005)).norm(), 1e-6);
  // Closed and facing out: 20 x 2 x 0.5 mm.
  EXPECT_NEAR(volume_of(mesh->mesh), 20e-9, 1e-12);
}

TEST(Relief, HasALayerAsAGroupAndASheetThatFeelsAsThePaper) {
  const auto world = relief_of(one_line(), {.paper = find_paper("canvas").value()});
  ASSERT_TRUE(world) << world.error().message;
  const world::PhysicalObject* group = object_named(*world, "Lines");
  ASSERT_NE(group, nullptr);
  EXPECT_EQ(group->children.size(), 1U);
  const world::PhysicalObject* sheet = object_named(*world, "sheet");
  ASSERT_NE(sheet, nullptr);
  EXPECT_EQ(world->find(sheet->material)->touch.stiffness, 400.0);
  EXPECT_EQ(world->find(sheet->material)->touch.static_friction, 0.46);
}

TEST(Relief, IsHigherWhereLinesAreWider) {
  const auto world = relief_of(one_line(), {.heights = {0.5 * kInMm, 0.25}, .sheet = 0.0});
  ASSERT_TRUE(world) << world.error().message;
  EXPECT_NEAR(mesh_of(*world, *object_named(*world, "stroke 2"))->bounds().max().z(), 1.0 * kInMm, 1e-9);
  EXPECT_EQ(object_named(*world, "sheet"), nullptr);
}

// A ring that a line draws has a hole: what its fill covers is flatter, and lies under it.
TEST(Relief, OfAFilledRingIsTwoSolids) {
  Drawing drawing = one_line();
  auto ring = std::make_shared<Stroke>(*drawing.layers[0].strokes[0]);
  const Vector2 corners[] = {{0.05, 0.05}, {0.07, 0.05}, {0.07, 0.07}, {0.05, 0.07}};
  ring->id = drawing.next_stroke_id();
  ring->curve.segments.clear();
  for (int i = 0; i < 4; ++i)
    ring->curve.segments.push_back(CubicBezier::line(corners[i], corners[(i + 1) % 4]));
  ring->curve.widths = {{0.0, 2.0 * kInMm, 4.0, 2.0 * kInMm}};
  ring->curve.closed = true;
  ring->fill = Colour{0.0F, 1.0F, 0.0F};
  drawing.layers[0].strokes.push_back(ring);
  const auto world = relief_of(drawing, {.heights = {.height = 1.0 * kInMm}});
  ASSERT_TRUE(world) << world.error().message;
  const auto fill = mesh_of(*world, *object_named(*world, "fill 3"));
  // A ridge was there before, so this is 0.2 % higher.
  EXPECT_NEAR(volume_of(fill->mesh), 20.0 * 20.0 * 0.3 * 1.002 * 1e-9, 1e-11);
  // 20 mm around the middle, 2 mm wide, corners rounded: 4 x 20 x 2 - (4 - pi) mm^2 of corners, 1 mm high.
  const auto line = mesh_of(*world, *object_named(*world, "stroke 3"));
  EXPECT_NEAR(volume_of(line->mesh), (160.0 - (4.0 - M_PI)) * 1.002e-9, 0.2e-9);
}

TEST(Relief, OfNothingThatIsSeenFails) {
  Drawing drawing = one_line();
  drawing.layers[0].visible = false;
  const auto world = relief_of(drawing, {});
  ASSERT_FALSE(world);
  EXPECT_EQ(world.error().message, "nothing of this drawing can be seen, so there is nothing to touch");
}

}  // namespace
}  // namespace icome::sketch
