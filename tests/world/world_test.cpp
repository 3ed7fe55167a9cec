#include "world/world.h"

#include "world/sample_world.h"

namespace icome::world {
namespace {

TEST(World, PlacesObjectsByTheirParents) {
  World world;
  IdSource ids;
  const ObjectId car = add_object(world, ids, "car", box(2.0), {}, at(10.0, 0.0, 0.0));
  const Affine3 turned = at(1.0, 0.0, 0.0) * Eigen::AngleAxisd(std::acos(-1.0) / 2, Vector3::UnitZ());
  const ObjectId wheel = add_object(world, ids, "wheel", box(1.0), car, turned);
  const ObjectId bolt = add_object(world, ids, "bolt", box(0.5), wheel, at(0.25, 0.0, 0.0));
  const Vector3 place = world_from_object(world, bolt) * Vector3::Zero();
  EXPECT_NEAR((place - Vector3(11.0, 0.25, 0.0)).norm(), 0.0, 1e-15);
  applied(world, PlaceObject{car, at(20.0, 0.0, 0.0)});  // children go along
  EXPECT_NEAR(world_from_object(world, bolt).translation().x(), 21.0, 1e-15);
  EXPECT_TRUE(is_within(world, bolt, car));
  EXPECT_FALSE(is_within(world, car, bolt));
  EXPECT_EQ(subtree(world, car), (std::vector{car, wheel, bolt}));
}

TEST(World, BoundsHoldAllBelow) {
  World world;
  IdSource ids;
  const ObjectId group = add_object(world, ids, "group", nullptr, {}, at(1.0, 0.0, 0.0));
  EXPECT_TRUE(bounds(world, group).isEmpty());
  const Affine3 turned(Eigen::AngleAxisd(std::acos(-1.0) / 4, Vector3::UnitZ()));
  add_object(world, ids, "turned", box(2.0), group, turned);
  const Bounds box = bounds(world, group);
  EXPECT_NEAR(box.max().x(), 1.0 + std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(box.max().z(), 1.0, 1e-12);
  // What has no end cannot widen them, however it lies.
  add_object(world, ids, "floor", std::make_shared<PrimitiveGeometry>(geometry::Plane{}), group, turned);
  EXPECT_EQ(bounds(world, group).max(), box.max());
  EXPECT_EQ(bounds(world, group).min(), box.min());
}

TEST(World, HashTellsWorldsApartAndTheSameAlike) {
  const auto make = [](const std::string& name, double size) {
    World world;
    IdSource ids;
    add_object(world, ids, name, box(size));
    return hash(world);
  };
  EXPECT_EQ(make("a", 1.0), make("a", 1.0));
  EXPECT_NE(make("a", 1.0), make("b", 1.0));
  EXPECT_NE(make("a", 1.0), make("a", 1.0 + 1e-15));
}

TEST(PrimitiveGeometry, StandsAlongTheAxisAskedFor) {
  const geometry::Cone cone{0.2, 0.0, 1.0};
  const PrimitiveGeometry along_z(cone), along_y(cone, Axis::Y);
  EXPECT_EQ(along_z.shape_from_primitive(), base::Matrix3::Identity());
  // Its top, +z in its own frame, is +y.
  EXPECT_EQ(along_y.shape_from_primitive() * Vector3::UnitZ(), Vector3::UnitY());
  EXPECT_EQ(along_y.shape_from_primitive().determinant(), 1.0);
  EXPECT_EQ(along_y.bounds().min(), Vector3(-0.2, -0.5, -0.2));
  EXPECT_EQ(along_y.bounds().max(), Vector3(0.2, 0.5, 0.2));
  EXPECT_NE(along_y.hash(), along_z.hash());
  const Bounds below = PrimitiveGeometry(geometry::Plane{}, Axis::Y).bounds();
  EXPECT_EQ(below.max().y(), 0.0);
  EXPECT_EQ(below.min().z(), -std::numeric_limits<double>::infinity());
}

TEST(IdSource, GivesEveryAuthorIdsOfTheirOwn) {
  IdSource one(1), other(2);
  EXPECT_NE(one.next<ObjectId>(), other.next<ObjectId>());
  EXPECT_NE(one.next<ObjectId>(), one.next<ObjectId>());
}

TEST(Geometry, HashesTellKindsAndSizesApart) {
  const auto sphere = [](double radius) { return PrimitiveGeometry(geometry::Sphere{radius}).hash(); };
  EXPECT_EQ(sphere(1.0), sphere(1.0));
  EXPECT_NE(sphere(1.0), sphere(2.0));
  geometry::CsgTree tree;
  tree.add_leaf(geometry::Primitive(geometry::Sphere{1.0}));
  geometry::CsgTree moved = tree;
  moved.set_transform(0, at(0.0, 1.0, 0.0));
  EXPECT_NE(CsgGeometry(tree).hash(), CsgGeometry(moved).hash());
  EXPECT_NE(CsgGeometry(tree).hash(), sphere(1.0));
  const Bounds box(Vector3(-1.0, -1.0, -1.0), Vector3(1.0, 1.0, 1.0));
  const auto one = ImplicitGeometry::create("x*x + y*y + z*z - 0.25", box);
  const auto other = ImplicitGeometry::create("x*x + y*y + z*z - 0.36", box);
  ASSERT_TRUE(one && other);
  EXPECT_NE((*one)->hash(), (*other)->hash());
}

}  // namespace
}  // namespace icome::world
