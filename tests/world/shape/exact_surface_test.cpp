#include "world/shape/exact_surface.h"

#include "base/random.h"
#include "geometry/primitive/primitive.h"
#include "world/collision/collision_shape.h"
#include "world/sample_world.h"
#include "world/shape/solid_geometry.h"

namespace icome::world {
namespace {

using geometry::Primitive;

GeometryPointer primitive_shape(const Primitive& it, Axis axis = Axis::Z) {
  return std::make_shared<PrimitiveGeometry>(it, axis);
}

/// Where the way from a to b leads in, by halving; the way begins out of it.
double share_by_halving(const Primitive& it, const Vector3& a, const Vector3& b) {
  constexpr int kSteps = 4000;
  int first = 0;
  while (first <= kSteps && !geometry::inside(it, a + (double(first) / kSteps) * (b - a))) ++first;
  if (first == 0 || first > kSteps) return -1.0;
  double out = double(first - 1) / kSteps, in = double(first) / kSteps;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (out + in);
    (geometry::inside(it, a + middle * (b - a)) ? in : out) = middle;
  }
  return in;
}

/// Does the way, which begins out of it, stay clearly out of it?
bool passes_by(const Primitive& it, const Vector3& a, const Vector3& b) {
  constexpr int kSteps = 1000;
  constexpr double kClear = 1e-3;  // m, more than half a step
  for (int i = 0; i <= kSteps; ++i) {
    const Vector3 place = a + (double(i) / kSteps) * (b - a);
    if (geometry::inside(it, place) || (geometry::scp_from_outside(it, place).point - place).norm() < kClear)
      return false;
  }
  return true;
}

TEST(ExactSurface, WaysLeadIntoPrimitivesWhereTheyAre) {
  base::Random random(5);
  int passed_by = 0;
  for (const Primitive& it :
       {Primitive(geometry::Sphere{0.1}), Primitive(geometry::Cylinder{0.1, 0.2}),
        Primitive(geometry::Cone{0.1, 0.02, 0.2}), Primitive(geometry::Torus{0.1, 0.04}),
        Primitive(geometry::Capsule{0.05, 0.1}), Primitive(geometry::Box{{0.1, 0.05, 0.02}})}) {
    CollisionShape shape(primitive_shape(it));
    int hits = 0;
    for (int i = 0; i < 60; ++i) {
      const Vector3 a = 0.4 * random.direction(), b = 0.15 * random.direction() - a;
      const double share = share_by_halving(it, a, b);
      const auto found = shape.first_hit(a, b);
      if (share < 0.0) {
        const bool stays_out = passes_by(it, a, b);
        EXPECT_FALSE(stays_out && found) << geometry::name(it) << " " << i;
        passed_by += stays_out ? 1 : 0;
        continue;
      }
      ++hits;
      ASSERT_TRUE(found) << geometry::name(it) << " " << i;
      EXPECT_NEAR(found->share, share, 1e-9) << geometry::name(it);
      EXPECT_LT(found->normal.dot(b - a), 0.0);
      EXPECT_NEAR(found->normal.norm(), 1.0, 1e-9);
    }
    EXPECT_GT(hits, 5) << geometry::name(it);
  }
  EXPECT_GT(passed_by, 10);
}

TEST(ExactSurface, FlatMeshesHaveANormalWhereTheirOriginIs) {
  geometry::TriangleMesh mesh;
  mesh.positions = {{-1.0, -1.0, 0.0}, {1.0, -1.0, 0.0}, {0.0, 1.0, 0.0}};
  mesh.triangles = {{0, 1, 2}};
  CollisionShape shape(std::make_shared<MeshGeometry>(mesh));
  base::Random random(9);
  for (int i = 0; i < 100; ++i) {
    const Vector3 a = random.direction(), b = -0.7 * a;  // through the origin, up to rounding
    const auto found = shape.first_hit(a, b);
    ASSERT_TRUE(found) << i;
    EXPECT_NEAR(std::abs(found->normal.z()), 1.0, 1e-12) << i;
    EXPECT_LT(found->normal.dot(b - a), 0.0) << i;
  }
}

TEST(ExactSurface, WhoGoesOutOfASolidGoesInLater) {
  for (const GeometryPointer& it :
       {primitive_shape(geometry::Torus{0.1, 0.04}),
        GeometryPointer(*primitive_shape(geometry::Torus{0.1, 0.04})->triangles(1e-5))}) {
    CollisionShape shape(it);
    const auto found = shape.first_hit({0.1, 0.0, 0.0}, {-0.3, 0.0, 0.0});
    ASSERT_TRUE(found);
    EXPECT_NEAR(0.1 - 0.4 * found->share, -0.06, 2e-5);
  }
}

TEST(ExactSurface, StandsAsTheShapeDoes) {
  CollisionShape lying(primitive_shape(geometry::Cylinder{0.1, 0.6}, Axis::Y));
  const auto found = lying.first_hit({0.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->share, 0.7, 1e-12);
  CollisionShape floor(primitive_shape(geometry::Plane{}, Axis::Y));
  EXPECT_NEAR(floor.first_hit({0.0, 1.0, 0.0}, {0.0, -1.0, 0.0})->share, 0.5, 1e-12);
  EXPECT_FALSE(floor.first_hit({0.0, -1.0, 0.0}, {0.0, 1.0, 0.0}));
}

TEST(ExactSurface, OfAFormulaIsNotItsTriangles) {
  const auto made =
      *ImplicitGeometry::create("x^2+y^2+z^2-0.01", Bounds(Vector3::Constant(-0.2), Vector3::Constant(0.2)));
  CollisionShape shape(made);
  base::Random random(8);
  for (int i = 0; i < 20; ++i) {
    const Vector3 way = random.direction();
    const auto found = shape.first_hit(0.18 * way, 0.02 * way);
    ASSERT_TRUE(found);
    EXPECT_NEAR(0.18 - 0.16 * found->share, 0.1, 1e-10);
    EXPECT_GT(found->normal.dot(way), 1.0 - 1e-9);
  }
}

TEST(ExactSurface, DeviationsAreThoseOfTriangles) {
  const Affine3 large = at(1.0, 2.0, 3.0) * Eigen::Scaling(2.0);
  EXPECT_EQ(CollisionShape(primitive_shape(geometry::Box{{0.1, 0.1, 0.1}})).deviation(large), 0.0);
  EXPECT_EQ(CollisionShape(primitive_shape(geometry::Sphere{0.1})).deviation(large), 0.0);
  EXPECT_EQ(CollisionShape(one_triangle()).deviation(large), 0.0);
  EXPECT_EQ(CollisionShape(primitive_shape(geometry::Plane{})).deviation(large), 0.0);
  const GeometryPointer rod = primitive_shape(geometry::Cylinder{0.1, 0.5});
  EXPECT_NEAR(CollisionShape(rod).deviation(large), 2.0 * 0.5e-3, 1e-12);
  const Affine3 flat(Eigen::Scaling(1.0, 1.0, 0.5));
  EXPECT_GT(CollisionShape(primitive_shape(geometry::Sphere{0.1})).deviation(flat), 1e-4);
}

}  // namespace
}  // namespace icome::world
