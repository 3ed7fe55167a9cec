#include "render/model/render_shape.h"

#include "render/drawn_world.h"

namespace icome::render {
namespace {

TEST(RenderShape, CornersThatLookAlikeShareAVertex) {
  const auto plain = make_render_shape(*square());
  ASSERT_TRUE(plain.has_value());
  EXPECT_EQ((*plain)->mesh.vertices.size(), 4u);
  EXPECT_EQ((*plain)->triangle_count(), 2u);
  auto seam = square();
  seam->texture_coordinates[1][0] = {0.5, 0.5};
  const auto split = make_render_shape(*seam);
  EXPECT_EQ((*split)->mesh.vertices.size(), 5u);
  EXPECT_EQ((*split)->picture_places.size(), 5u);
}

TEST(RenderShape, NormalsOfTheFileAreKept) {
  auto shape = square();
  const Vector3 slanted = Vector3(0.6, 0.0, 0.8);
  shape->normals.assign(2, {slanted, slanted, slanted});
  const auto made = make_render_shape(*shape);
  for (const auto& vertex : (*made)->mesh.vertices)
    EXPECT_TRUE(vertex.normal.isApprox(slanted.cast<float>()));
}

TEST(RenderShape, VerticesNobodyUsesDoNotCount) {
  auto shape = square();
  shape->mesh.positions.push_back(Vector3::Constant(1e6));
  const auto made = make_render_shape(*shape);
  EXPECT_EQ((*made)->bounds.max().x(), 1.0);
  EXPECT_LT((*made)->mesh.radius, 2.0);
}

TEST(RenderShape, ShapesWithoutAnySurfaceAreEmpty) {
  const auto none = make_render_shape(world::MeshGeometry(geometry::TriangleMesh{}));
  ASSERT_TRUE(none.has_value());
  EXPECT_EQ((*none)->triangle_count(), 0u);
  EXPECT_TRUE((*none)->bounds.isEmpty());
  EXPECT_FALSE(make_render_shape(world::PrimitiveGeometry(geometry::Plane{})).has_value());
}

TEST(RenderShape, ExtremesReachAllRound) {
  const auto ball = make_render_shape(world::PrimitiveGeometry(geometry::Sphere{2.0}));
  base::Bounds box;
  for (const Vector3& it : (*ball)->extremes) box.extend(it);
  EXPECT_GT(box.sizes().minCoeff(), 3.8);
}

}  // namespace
}  // namespace icome::render
