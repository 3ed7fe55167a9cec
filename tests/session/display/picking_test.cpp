#include "session/display/picking.h"

#include <cmath>
#include <limits>

#include "geometry/csg/csg_solid.h"
#include "geometry/implicit/implicit_surface.h"
#include "geometry/loop/loop_surface.h"
#include "geometry/mesh/geodesic_sphere.h"
#include "geometry/primitive/primitive.h"
#include "haptics/shapes/mesh_shape.h"
#include "haptics/shapes/primitive_shape.h"
#include "haptics/shapes/smooth_shape.h"
#include "session/felt/haptic_representation.h"
#include "world/random_edits.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Bounds;
using base::Pose;
using base::Random;
using base::Vector3;
using geometry::CsgTree;
using geometry::TriangleMesh;
using haptics::HapticObject;
using haptics::HapticScene;
using interaction::Ray;
using ShapePointer = std::shared_ptr<const haptics::Shape>;

#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
constexpr int kFewer = 20;  // sanitizers slow the code by about this much
#else
constexpr int kFewer = 1;
#endif

HapticObject picked_object(std::uint32_t id, ShapePointer shape, const Pose& pose = Pose::Identity()) {
  HapticObject object;
  object.id = {id, 1};
  object.shape = std::move(shape);
  object.world_from_object = pose;
  return object;
}

ShapePointer mesh_shape(TriangleMesh mesh) {
  return std::make_shared<haptics::MeshShape>(std::make_shared<const TriangleMesh>(std::move(mesh)),
                                              haptics::MeshShapeSettings{});
}

ShapePointer primitive_shape(const geometry::Primitive& primitive) {
  return std::make_shared<haptics::PrimitiveShape>(primitive);
}

std::shared_ptr<const HapticScene> scene_of(ShapePointer shape, const Pose& pose = Pose::Identity()) {
  return HapticScene::compile({picked_object(1, std::move(shape), pose)});
}

Pose turned_pose(Random& random, double distance) {
  Pose pose(Eigen::AngleAxisd(random.uniform(0.0, 6.28), random.direction()));
  pose.pretranslate(distance * random.direction());
  return pose;
}

/// From somewhere around, past somewhere near the middle.
Ray ray_at(Random& random, double from, double past) {
  const Vector3 origin = from * random.direction();
  return {origin, (past * random.uniform(0.0, 1.0) * random.direction() - origin).normalized()};
}

/// Three numbers: in tests, which are not optimised, Eigen's take ten times as long.
struct PlainVector {
  double x, y, z;

  static PlainVector of(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
  PlainVector operator-(const PlainVector& other) const { return {x - other.x, y - other.y, z - other.z}; }
  double dot(const PlainVector& other) const { return x * other.x + y * other.y + z * other.z; }
  PlainVector cross(const PlainVector& other) const {
    return {y * other.z - z * other.y, z * other.x - x * other.z, x * other.y - y * other.x};
  }
};

/// Moeller and Trumbore (1997), over all triangles.
std::optional<double> brute_distance(const TriangleMesh& mesh, const Ray& ray) {
  std::optional<double> best;
  const PlainVector origin = PlainVector::of(ray.origin), direction = PlainVector::of(ray.direction);
  const auto corner = [&](std::size_t i, int k) { return PlainVector::of(mesh.corner(i, k)); };
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const PlainVector a = corner(i, 0), u = corner(i, 1) - a, v = corner(i, 2) - a;
    const PlainVector p = direction.cross(v);
    const double det = u.dot(p);
    if (det == 0.0) continue;
    const PlainVector s = origin - a, q = s.cross(u);
    const double x = s.dot(p) / det, y = direction.dot(q) / det, t = v.dot(q) / det;
    if (x < 0.0 || y < 0.0 || x + y > 1.0 || t < 0.0) continue;
    if (!best || t < *best) best = t;
  }
  return best;
}

/// The first change of `inside` along the ray, by looking at many places.
template <typename Inside>
std::optional<double> sampled_distance(Inside&& inside, const Ray& ray, double length, int samples) {
  const auto at = [&](double s) { return inside(Vector3(ray.origin + s * ray.direction)); };
  const bool first = at(0.0);
  for (int i = 1; i <= samples; ++i) {
    double a = length * (i - 1) / samples, b = length * i / samples;
    if (at(b) == first) continue;
    for (int k = 0; k < 50; ++k) {
      const double middle = 0.5 * (a + b);
      (at(middle) == first ? a : b) = middle;
    }
    return b;
  }
  return std::nullopt;
}

/// What is picked lies where the ray goes through the solid's surface, and not behind where samples say so.
template <typename Inside>
void expect_as_sampled(const std::optional<PickedThing>& picked, Inside&& inside, const Ray& ray,
                       double size) {
  const auto sampled = sampled_distance(inside, ray, 4.0 * size, 3000);
  if (sampled) {
    ASSERT_TRUE(picked);
    EXPECT_LE(picked->place.distance, *sampled + 1e-8 * size);
  }
  if (!picked) return;
  EXPECT_TRUE(picked->place.point.isApprox(ray.origin + picked->place.distance * ray.direction, 1e-8));
  EXPECT_LE(picked->place.normal.dot(ray.direction), 1e-12);
  EXPECT_NEAR(picked->place.normal.norm(), 1.0, 1e-9);
  // Really a surface: a little along its normal one is out of what is a little against it.
  if (sampled && std::abs(picked->place.distance - *sampled) < 1e-7 * size) return;
  const double hair = 1e-7 * size;
  EXPECT_NE(inside(Vector3(picked->place.point + hair * picked->place.normal)),
            inside(Vector3(picked->place.point - hair * picked->place.normal)));
}

TEST(Picking, NothingIsThere) {
  EXPECT_FALSE(pick(*HapticScene::compile({}), {Vector3::Zero(), Vector3::UnitX()}));
  const auto scene = scene_of(primitive_shape(geometry::Sphere{1.0}));
  EXPECT_FALSE(pick(*scene, {Vector3(0, 0, 5), Vector3::UnitZ()}));
  EXPECT_FALSE(pick(*scene, {Vector3(0, 1.1, 5), -Vector3::UnitZ()}));
}

TEST(Picking, RaysThatAreNoneMeetNothing) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  const auto scene = scene_of(primitive_shape(geometry::Sphere{1.0}));
  EXPECT_FALSE(pick(*scene, {Vector3(0, 0, 5), Vector3::Zero()}));
  for (const double bad : {none, endless}) {
    EXPECT_FALSE(pick(*scene, {Vector3(0, bad, 5), -Vector3::UnitZ()}));
    EXPECT_FALSE(pick(*scene, {Vector3(0, 0, 5), Vector3(0, bad, -1)}));
  }
  // Any length of the direction will do.
  for (const double length : {1e-200, 1e200})
    EXPECT_NEAR(pick(*scene, {Vector3(0, 0, 5), -length * Vector3::UnitZ()})->place.distance, 4.0, 1e-12);
}

TEST(Picking, GivesObjectPlaceAndNormalTowardsTheEye) {
  const auto scene = HapticScene::compile(
      {picked_object(7, primitive_shape(geometry::Box{Vector3(1, 1, 1)})),
       picked_object(8, primitive_shape(geometry::Sphere{1.0}), Pose(Eigen::Translation3d(0, 0, -5)))});
  const auto front = pick(*scene, {Vector3(0.5, 0, 10), -Vector3::UnitZ()});
  ASSERT_TRUE(front);
  EXPECT_EQ(front->object.index, 7U);
  EXPECT_TRUE(front->place.point.isApprox(Vector3(0.5, 0, 1), 1e-12));
  EXPECT_TRUE(front->place.normal.isApprox(Vector3::UnitZ(), 1e-12));
  EXPECT_NEAR(front->place.distance, 9.0, 1e-12);
  const auto back = pick(*scene, {Vector3(0, 0, -10), Vector3::UnitZ()});
  EXPECT_EQ(back->object.index, 8U);
  EXPECT_NEAR(back->place.distance, 4.0, 1e-12);
  // From within, the wall's back.
  const auto within = pick(*scene, {Vector3::Zero(), Vector3::UnitX()});
  EXPECT_EQ(within->object.index, 7U);
  EXPECT_TRUE(within->place.normal.isApprox(-Vector3::UnitX(), 1e-12));
}

TEST(Picking, MeshesAsEveryTriangleSays) {
  for (const double scale : {1e-3, 1.0, 1e3}) {  // in m designs of mm and km
    TriangleMesh mesh = geometry::bumpy_geodesic_sphere(12, scale, 0.4, 7);
    Random random(5);
    const Pose pose = turned_pose(random, 3.0 * scale);
    const auto scene = scene_of(mesh_shape(mesh), pose);
    int met = 0;
    for (int i = 0; i < 400 / kFewer; ++i) {
      Ray ray = ray_at(random, i % 5 == 0 ? 0.3 * scale : 4.0 * scale, 1.5 * scale);  // some from within
      const auto brute = brute_distance(mesh, ray);
      const Ray there{pose * ray.origin, pose.linear() * ray.direction};
      const auto picked = pick(*scene, there);
      ASSERT_EQ(picked.has_value(), brute.has_value()) << i;
      if (!brute) continue;
      ++met;
      EXPECT_NEAR(picked->place.distance, *brute, 1e-11 * scale);
      EXPECT_TRUE(picked->place.point.isApprox(there.origin + *brute * there.direction, 1e-11));
      EXPECT_LT(picked->place.normal.dot(there.direction), 0.0);
    }
    EXPECT_GT(met, 150 / kFewer);
  }
}

TEST(Picking, AMillionTriangles) {
  const TriangleMesh mesh = geometry::bumpy_geodesic_sphere(kFewer > 1 ? 40 : 230, 0.1, 0.2, 20);
  const auto scene = scene_of(mesh_shape(mesh));
  Random random(2);
  for (int i = 0; i < 8; ++i) {
    const Ray ray = ray_at(random, 0.5, 0.11);
    const auto brute = brute_distance(mesh, ray);
    const auto picked = pick(*scene, ray);
    ASSERT_EQ(picked.has_value(), brute.has_value());
    if (brute) {
      EXPECT_NEAR(picked->place.distance, *brute, 1e-12);
    }
  }
}

TEST(Picking, NoRaySlipsThroughASeam) {
  const TriangleMesh mesh = geometry::bumpy_geodesic_sphere(6, 1.0, 0.0, 1);
  const auto scene = scene_of(mesh_shape(mesh));
  Random random(4);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Vector3 eye = 3.0 * random.direction();
    const Vector3 corner = mesh.corner(i, 0), middle = 0.5 * (mesh.corner(i, 1) + mesh.corner(i, 2));
    for (const Vector3& goal : {corner, middle}) EXPECT_TRUE(pick(*scene, {eye, (goal - eye).normalized()}));
  }
}

TEST(Picking, PrimitivesAsSamplesSay) {
  for (const char* text :
       {"box:1x0.5x0.3", "cylinder:0.4x1", "cone:0.5x0.1x1", "torus:0.5x0.2", "capsule:0.3x0.6"}) {
    const geometry::Primitive primitive = *geometry::parse_primitive(text);
    Random random(9);
    const Pose pose = turned_pose(random, 1.0);
    const auto scene = scene_of(primitive_shape(primitive), pose);
    const auto inside = [&](const Vector3& point) {
      return geometry::inside(primitive, pose.inverse() * point);
    };
    for (int i = 0; i < 60 / kFewer + 3; ++i) {
      const Ray ray = ray_at(random, 2.0, 1.5);
      expect_as_sampled(pick(*scene, ray), inside, ray, 1.0);
    }
  }
}

TEST(Picking, FloorsReachTheHorizon) {
  const auto floor = scene_of(primitive_shape(geometry::Plane{}));
  const auto near = pick(*floor, {Vector3(3, 4, 2), Vector3(0, 0.6, -0.8)});
  ASSERT_TRUE(near);
  EXPECT_NEAR(near->place.distance, 2.5, 1e-12);
  EXPECT_TRUE(pick(*floor, {Vector3(0, 0, 2), Vector3(1, 0, -0.01).normalized()}));
  EXPECT_FALSE(pick(*floor, {Vector3(0, 0, 2), Vector3(1, 0, 0.01).normalized()}));
  const auto below = pick(*floor, {Vector3(0, 0, -2), Vector3::UnitZ()});
  ASSERT_TRUE(below);
  EXPECT_LT(below->place.normal.z(), 0.0);
  // With something small before it.
  const auto both = HapticScene::compile({picked_object(1, primitive_shape(geometry::Plane{})),
                                          picked_object(2, primitive_shape(geometry::Sphere{0.01}))});
  EXPECT_EQ(pick(*both, {Vector3(0, 0, 50), -Vector3::UnitZ()})->object.index, 2U);
  EXPECT_EQ(pick(*both, {Vector3(20, 0, 50), -Vector3::UnitZ()})->object.index, 1U);
}

/// A drilled block with a ball on it, one hole along its edge, an operand flush with another.
CsgTree drilled_block() {
  const auto moved = [](double x, double y, double z) { return Affine3(Eigen::Translation3d(x, y, z)); };
  CsgTree tree;
  const auto block = tree.add_leaf(geometry::Primitive(geometry::Box{Vector3(0.5, 0.4, 0.3)}));
  const auto hole = tree.add_leaf(geometry::Primitive(geometry::Cylinder{0.15, 2.0}), moved(0.2, 0, 0));
  auto root = tree.add(geometry::CsgOperator::Difference, block, hole);
  const auto edge = tree.add_leaf(geometry::Primitive(geometry::Torus{0.3, 0.1}), moved(-0.5, 0, 0));
  root = tree.add(geometry::CsgOperator::Difference, root, edge);
  const auto ball = tree.add_leaf(geometry::Primitive(geometry::Sphere{0.2}), moved(-0.2, 0, 0.3));
  root = tree.add(geometry::CsgOperator::Union, root, ball);
  const auto flush =
      tree.add_leaf(geometry::Primitive(geometry::Box{Vector3(0.1, 0.1, 0.1)}), moved(0.6, 0, 0));
  tree.add(geometry::CsgOperator::Union, root, flush);
  return tree;
}

TEST(Picking, CsgSolidsAsSamplesSay) {
  const CsgTree tree = drilled_block();
  const auto scene =
      scene_of(std::make_shared<haptics::SmoothShape>(std::make_shared<geometry::CsgSolid>(tree)));
  const auto inside = [&](const Vector3& point) { return geometry::inside(tree, point); };
  Random random(11);
  for (int i = 0; i < 300 / kFewer; ++i) {
    const Ray ray = ray_at(random, i % 4 == 0 ? 0.2 : 2.0, 0.7);
    expect_as_sampled(pick(*scene, ray), inside, ray, 1.0);
  }
  // Straight down the hole, and along faces that lie in one plane.
  EXPECT_FALSE(pick(*scene, {Vector3(0.2, 0.0, 3.0), -Vector3::UnitZ()}));
  EXPECT_FALSE(pick(*scene, {Vector3(0.35 - 1e-6, 0.0, 3.0), -Vector3::UnitZ()}));
  EXPECT_NEAR(pick(*scene, {Vector3(0.45, 0.0, 3.0), -Vector3::UnitZ()})->place.distance, 2.7, 1e-9);
  EXPECT_NEAR(pick(*scene, {Vector3(3.0, 0.0, 0.05), -Vector3::UnitX()})->place.distance, 2.3, 1e-9);
}

TEST(Picking, LoopSurfacesAsTheirFinestTrianglesSay) {
  geometry::ControlMesh control;
  control.mesh = geometry::bumpy_geodesic_sphere(2, 1.0, 0.5, 3);
  const auto surface = *geometry::LoopSurface::create(control);
  const auto scene = scene_of(std::make_shared<haptics::SmoothShape>(surface));
  const TriangleMesh fine = *surface->tessellate(5);
  Random random(12);
  int met = 0;
  for (int i = 0; i < 40 / kFewer + 2; ++i) {
    const Ray ray = ray_at(random, i % 4 == 0 ? 0.1 : 4.0, 0.7);
    const auto brute = brute_distance(fine, ray);
    const auto picked = pick(*scene, ray);
    if (!brute) continue;
    ++met;
    ASSERT_TRUE(picked);
    EXPECT_NEAR(picked->place.distance, *brute, 2e-3);  // what the triangles are off
    EXPECT_LT(picked->place.normal.dot(ray.direction), 0.0);
  }
  EXPECT_GT(met, kFewer > 1 ? 0 : 20);
}

TEST(Picking, ASheetIsMetFromBothSides) {
  geometry::ControlMesh control;
  control.mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  control.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  const auto scene =
      scene_of(std::make_shared<haptics::SmoothShape>(*geometry::LoopSurface::create(control)));
  for (const double side : {-1.0, 1.0}) {
    const auto picked = pick(*scene, {Vector3(0.5, 0.5, 2.0 * side), -side * Vector3::UnitZ()});
    ASSERT_TRUE(picked);
    EXPECT_NEAR(picked->place.distance, 2.0, 1e-9);
    EXPECT_NEAR(picked->place.normal.z(), side, 1e-9);
  }
}

TEST(Picking, ImplicitSurfacesAsSamplesSay) {
  struct Case {
    const char* formula;
    Bounds box;
  };
  const Vector3 one = Vector3::Ones();
  for (const Case& it : {Case{"x^4 + y^4 + z^4 - 0.5*(x^2+y^2+z^2) + 0.05", {-one, one}},
                         Case{"z - 0.1*sin(10*x + t)*cos(8*y)", {-one, one}},
                         Case{"sin(9*x)*cos(9*y) + sin(9*y)*cos(9*z) + sin(9*z)*cos(9*x)", {-one, one}}}) {
    const auto made = geometry::ImplicitSurface::create(it.formula, it.box);
    ASSERT_TRUE(made) << it.formula;
    const auto surface = *made;
    const auto scene = scene_of(std::make_shared<haptics::SmoothShape>(surface));
    const auto inside = [&](const Vector3& point) { return surface->inside(point, 0.0); };
    Random random(13);
    for (int i = 0; i < 100 / kFewer + 2; ++i) {
      const Ray ray = ray_at(random, i % 4 == 0 ? 0.3 : 3.0, 1.2);
      expect_as_sampled(pick(*scene, ray), inside, ray, 1.0);
    }
  }
}

TEST(Picking, WhatChangesWithTimeIsMetWhereItIsThen) {
  const Vector3 one = Vector3::Ones();
  const auto surface = *geometry::ImplicitSurface::create("z - 0.2*t", {-one, one});
  HapticObject object = picked_object(1, std::make_shared<haptics::SmoothShape>(surface));
  object.time = 1.0;
  object.motion.linear = Vector3(0, 0, 1);
  const auto scene = HapticScene::compile({object});
  const Ray down{Vector3(0.1, 0.2, 5), -Vector3::UnitZ()};
  EXPECT_NEAR(pick(*scene, down)->place.point.z(), 0.2, 1e-9);
  EXPECT_NEAR(pick(*scene, down, 0.1)->place.point.z(), 0.32, 1e-9);
}

TEST(Picking, OfManyObjectsTheNearest) {
  Random random(21);
  std::vector<HapticObject> objects;
  std::vector<std::pair<Vector3, double>> balls;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    const Vector3 at(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double radius = random.uniform(0.001, 0.03);
    balls.emplace_back(at, radius);
    objects.push_back(
        picked_object(i, primitive_shape(geometry::Sphere{radius}), Pose(Eigen::Translation3d(at))));
  }
  const auto scene = HapticScene::compile(objects);
  for (int i = 0; i < 500 / kFewer; ++i) {
    const Ray ray = ray_at(random, i % 2 == 0 ? 0.5 : 3.0, 1.0);
    double nearest = std::numeric_limits<double>::infinity();
    std::uint32_t which = 0;
    for (std::uint32_t k = 0; k < balls.size(); ++k) {
      const Vector3 from = ray.origin - balls[k].first;
      const double b = from.dot(ray.direction);
      const double root = b * b - from.squaredNorm() + balls[k].second * balls[k].second;
      if (root < 0.0) continue;
      for (const double t : {-b - std::sqrt(root), -b + std::sqrt(root)}) {
        if (t >= 0.0 && t < nearest) nearest = t, which = k;
      }
    }
    const auto picked = pick(*scene, ray);
    ASSERT_EQ(picked.has_value(), std::isfinite(nearest));
    if (!picked) continue;
    EXPECT_EQ(picked->object.index, which);
    EXPECT_NEAR(picked->place.distance, nearest, 1e-9);
  }
}

TEST(Picking, FromFarAwayAndOfVerySmallThings) {
  // A design of a micrometre seen from a kilometre, in line: only the eye's own rounding is left.
  const Vector3 direction = Vector3(1, 2, 3).normalized();
  const auto scene = scene_of(primitive_shape(geometry::Box{Vector3::Constant(1e-6)}));
  const auto picked = pick(*scene, {-1e3 * direction, direction});
  ASSERT_TRUE(picked);
  EXPECT_NEAR(picked->place.point.z(), -1e-6, 1e-12);
}

TEST(Picking, StretchedAndMirroredObjectsAsTheyAreFelt) {
  using world::at;
  world::World world;
  world::IdSource ids;
  Affine3 place = Affine3::Identity();
  place.linear() << -2.0, 0.0, 0.0, 0.0, 1.0, 0.5, 0.0, 0.0, 3.0;
  place.translation() = Vector3(10.0, 0.0, 0.0);
  const auto box = add_object(world, ids, "box", world::box(1.0), {}, place);
  HapticRepresentation felt;
  felt.show(world);
  // The image of the box's front: x -> 10 - 2 x.
  const auto picked = pick(*felt.scene(), {Vector3(50.0, 0.1, 0.2), -Vector3::UnitX()});
  ASSERT_TRUE(picked);
  EXPECT_EQ(felt.object(picked->object), box);
  const auto bounds = world::box(1.0)->bounds();
  EXPECT_NEAR(picked->place.point.x(), 10.0 - 2.0 * bounds.min().x(), 1e-9);
  EXPECT_TRUE(picked->place.normal.isApprox(Vector3::UnitX(), 1e-9));
}

}  // namespace
}  // namespace icome::session
