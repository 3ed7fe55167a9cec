#include "render/primitive_places.h"

#include <gtest/gtest.h>

#include "world/mesh_geometry.h"

namespace icome::render {
namespace {

using base::Vector2;
using base::Vector3;
using world::Axis;

/// The picture's place at the corner of a triangle that faces `out` and is nearest to the point.
Vector2 place_at(const world::PrimitiveGeometry& shape, const Vector3& point, const Vector3& out) {
  const auto surface = shape.triangles(0.02);
  const auto& mesh = (*surface)->mesh;
  const auto places = primitive_places(shape, mesh);
  Vector2 best(-1.0, -1.0);
  double nearest = 1e9;
  for (std::size_t t = 0; t < places.size(); ++t) {
    const Vector3 normal =
        (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0)).normalized();
    if (normal.dot(out) < 0.9) continue;
    for (int k = 0; k < 3; ++k) {
      const double away = (mesh.corner(t, k) - point).norm();
      if (away >= nearest) continue;
      nearest = away;
      best = places[t][std::size_t(k)];
    }
  }
  return best;
}

TEST(PrimitivePlaces, BoxesShowThePictureUprightOnEachSide) {
  const world::PrimitiveGeometry box(geometry::Box{{1.0, 2.0, 3.0}});
  EXPECT_EQ(place_at(box, {-1, -2, 3}, Vector3::UnitZ()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {1, 2, 3}, Vector3::UnitZ()), Vector2(1, 1));
  EXPECT_EQ(place_at(box, {1, -2, -3}, -Vector3::UnitZ()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {1, -2, 3}, Vector3::UnitX()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {-1, -2, -3}, -Vector3::UnitX()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {-1, 2, 3}, Vector3::UnitY()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {-1, -2, -3}, -Vector3::UnitY()), Vector2(0, 0));
}

TEST(PrimitivePlaces, CylindersAreWrappedFromTheBackLeftwards) {
  const world::PrimitiveGeometry bar(geometry::Cylinder{1.0, 2.0}, Axis::Y);
  EXPECT_NEAR((place_at(bar, {0, 1, 1}, Vector3::UnitZ()) - Vector2(0.5, 1.0)).norm(), 0.0, 0.03);
  EXPECT_NEAR((place_at(bar, {-1, -1, 0}, -Vector3::UnitX()) - Vector2(0.25, 0.0)).norm(), 0.0, 0.03);
  EXPECT_NEAR((place_at(bar, {1, -1, 0}, Vector3::UnitX()) - Vector2(0.75, 0.0)).norm(), 0.0, 0.03);
  EXPECT_NEAR((place_at(bar, {1, 1, 0}, Vector3::UnitY()) - Vector2(1.0, 0.5)).norm(), 0.0, 0.05);
  EXPECT_NEAR((place_at(bar, {0, 1, -1}, Vector3::UnitY()) - Vector2(0.5, 1.0)).norm(), 0.0, 0.05);
}

TEST(PrimitivePlaces, NoTriangleRunsBackOverTheWholePicture) {
  for (const geometry::Primitive& primitive :
       {geometry::Primitive(geometry::Sphere{1.0}), geometry::Primitive(geometry::Cylinder{1.0, 2.0}),
        geometry::Primitive(geometry::Cone{1.0, 0.0, 2.0})}) {
    for (const Axis axis : {Axis::Y, Axis::Z}) {
      const world::PrimitiveGeometry shape(primitive, axis);
      const auto surface = shape.triangles(0.01);
      const auto places = primitive_places(shape, (*surface)->mesh);
      ASSERT_EQ(places.size(), (*surface)->mesh.triangles.size());
      for (const auto& corners : places) {
        for (std::size_t k = 0; k < 3; ++k) {
          ASSERT_TRUE(corners[k].allFinite());
          ASSERT_GE(corners[k].y(), -1e-9);
          ASSERT_LE(corners[k].y(), 1.0 + 1e-9);
          ASSERT_LE(std::abs(corners[k].x() - corners[(k + 1) % 3].x()), 0.51);
        }
      }
    }
  }
}

TEST(PrimitivePlaces, OthersHaveNone) {
  const world::PrimitiveGeometry ring(geometry::Torus{2.0, 0.5});
  EXPECT_TRUE(primitive_places(ring, (*ring.triangles(0.1))->mesh).empty());
}

}  // namespace
}  // namespace icome::render
