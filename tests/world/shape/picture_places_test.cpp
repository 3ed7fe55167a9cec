#include "world/shape/picture_places.h"

#include <gtest/gtest.h>

#include "world/shape/mesh_geometry.h"

namespace icome::world {
namespace {

/// The picture's place at the corner of a triangle that faces `out` and is nearest to the point.
Vector2 place_at(const PrimitiveGeometry& shape, const Vector3& point, const Vector3& out) {
  const auto surface = shape.triangles(0.02);
  const auto& mesh = (*surface)->mesh;
  const auto places = picture_places(shape, mesh);
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

TEST(PicturePlaces, BoxesShowThePictureUprightOnEachSide) {
  const PrimitiveGeometry box(geometry::Box{{1.0, 2.0, 3.0}});
  EXPECT_EQ(place_at(box, {-1, -2, 3}, Vector3::UnitZ()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {1, 2, 3}, Vector3::UnitZ()), Vector2(1, 1));
  EXPECT_EQ(place_at(box, {1, -2, -3}, -Vector3::UnitZ()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {1, -2, 3}, Vector3::UnitX()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {-1, -2, -3}, -Vector3::UnitX()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {-1, 2, 3}, Vector3::UnitY()), Vector2(0, 0));
  EXPECT_EQ(place_at(box, {-1, -2, -3}, -Vector3::UnitY()), Vector2(0, 0));
}

TEST(PicturePlaces, CylindersAreWrappedFromTheBackLeftwards) {
  const PrimitiveGeometry bar(geometry::Cylinder{1.0, 2.0}, Axis::Y);
  EXPECT_NEAR((place_at(bar, {0, 1, 1}, Vector3::UnitZ()) - Vector2(0.5, 1.0)).norm(), 0.0, 0.03);
  EXPECT_NEAR((place_at(bar, {-1, -1, 0}, -Vector3::UnitX()) - Vector2(0.25, 0.0)).norm(), 0.0, 0.03);
  EXPECT_NEAR((place_at(bar, {1, -1, 0}, Vector3::UnitX()) - Vector2(0.75, 0.0)).norm(), 0.0, 0.03);
  EXPECT_NEAR((place_at(bar, {1, 1, 0}, Vector3::UnitY()) - Vector2(1.0, 0.5)).norm(), 0.0, 0.05);
  EXPECT_NEAR((place_at(bar, {0, 1, -1}, Vector3::UnitY()) - Vector2(0.5, 1.0)).norm(), 0.0, 0.05);
}

/// VRML 2.0, 6.42: from the back round to the left as seen from above, from the lowest point to the highest.
TEST(PicturePlaces, SpheresStandUprightHoweverTheyAreKept) {
  for (const Axis axis : {Axis::Y, Axis::Z}) {
    const PrimitiveGeometry ball(geometry::Sphere{1.0}, axis);
    EXPECT_NEAR((place_at(ball, {0, 0, 1}, Vector3::UnitZ()) - Vector2(0.5, 0.5)).norm(), 0.0, 0.05);
    EXPECT_NEAR((place_at(ball, {-1, 0, 0}, -Vector3::UnitX()) - Vector2(0.25, 0.5)).norm(), 0.0, 0.05);
    EXPECT_NEAR((place_at(ball, {1, 0, 0}, Vector3::UnitX()) - Vector2(0.75, 0.5)).norm(), 0.0, 0.05);
    EXPECT_NEAR(place_at(ball, {0, 1, 0}, Vector3::UnitY()).y(), 1.0, 1e-9);
    EXPECT_NEAR(place_at(ball, {0, -1, 0}, -Vector3::UnitY()).y(), 0.0, 1e-9);
  }
}

/// A picture that is not repeated would end within a triangle that lies across.
TEST(PicturePlaces, NothingLiesAcrossTheSeam) {
  for (const geometry::Primitive& primitive :
       {geometry::Primitive(geometry::Sphere{1.0}), geometry::Primitive(geometry::Cylinder{1.0, 2.0}),
        geometry::Primitive(geometry::Cone{1.0, 0.0, 2.0})}) {
    for (const double tolerance : {0.1, 0.02, 0.004}) {
      const PrimitiveGeometry shape(primitive, Axis::Y);
      const auto surface = shape.triangles(tolerance);
      for (const auto& corners : picture_places(shape, (*surface)->mesh)) {
        for (const Vector2& place : corners) ASSERT_LE(place.x(), 1.0 + 1e-9);
      }
    }
  }
}

TEST(PicturePlaces, NoTriangleRunsBackOverTheWholePicture) {
  for (const geometry::Primitive& primitive :
       {geometry::Primitive(geometry::Sphere{1.0}), geometry::Primitive(geometry::Cylinder{1.0, 2.0}),
        geometry::Primitive(geometry::Cone{1.0, 0.0, 2.0})}) {
    for (const Axis axis : {Axis::Y, Axis::Z}) {
      const PrimitiveGeometry shape(primitive, axis);
      const auto surface = shape.triangles(0.01);
      const auto places = picture_places(shape, (*surface)->mesh);
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

TEST(PicturePlaces, OthersHaveNone) {
  const PrimitiveGeometry ring(geometry::Torus{2.0, 0.5});
  EXPECT_TRUE(picture_places(ring, (*ring.triangles(0.1))->mesh).empty());
}

}  // namespace
}  // namespace icome::world
