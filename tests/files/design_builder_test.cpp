// What readers put worlds together with.
#include "files/design_builder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>

#include "world/motion.h"
#include "world/shape/solid_geometry.h"

namespace icome::files {
namespace {

using geometry::Primitive;
using world::Axis;

TEST(DesignBuilder, EqualPrimitivesAreShapesOfTheirOwnThatLieInMemoryOnce) {
  // Of each kind one, then such that differ in a size or in the axis alone.
  const std::vector<std::pair<Primitive, Axis>> different = {
      {geometry::Plane{}, Axis::Z},
      {geometry::Box{{0.1, 0.2, 0.3}}, Axis::Z},
      {geometry::Sphere{0.1}, Axis::Z},
      {geometry::Cylinder{0.1, 0.2}, Axis::Z},
      {geometry::Cone{0.1, 0.0, 0.2}, Axis::Z},
      {geometry::Torus{0.2, 0.1}, Axis::Z},
      {geometry::Capsule{0.1, 0.2}, Axis::Z},
      {geometry::Box{{0.1, 0.2, std::nextafter(0.3, 1.0)}}, Axis::Z},
      {geometry::Sphere{std::nextafter(0.1, 1.0)}, Axis::Z},
      {geometry::Cylinder{0.1, 0.2}, Axis::Y},
      {geometry::Cone{0.0, 0.1, 0.2}, Axis::Z},
  };
  io::MemoryBudget memory;
  DesignBuilder builder(memory);
  std::vector<std::vector<world::GeometryId>> ids(different.size());
  for (int round = 0; round < 3; ++round) {
    for (std::size_t i = 0; i < different.size(); ++i) {
      const auto& [primitive, axis] = different[i];
      ids[i].push_back(builder.add(std::make_shared<world::PrimitiveGeometry>(primitive, axis)));
    }
  }
  EXPECT_EQ(builder.world().geometries().size(), 3 * different.size());
  std::set<const world::Geometry*> in_memory;
  for (std::size_t i = 0; i < different.size(); ++i) {
    for (const world::GeometryId id : ids[i]) {
      const auto& shape = builder.world().find(id)->shape;
      EXPECT_EQ(shape, builder.world().find(ids[i].front())->shape);
      const auto& its = dynamic_cast<const world::PrimitiveGeometry&>(*shape);
      EXPECT_TRUE(its.primitive == different[i].first && its.axis == different[i].second) << i;
      in_memory.insert(shape.get());
    }
  }
  EXPECT_EQ(in_memory.size(), different.size());
}

TEST(DesignBuilder, AMotionThatManyObjectsHaveTakesMemoryOnce) {
  world::Motion motion;
  for (int key = 0; key < 10'000; ++key) {
    motion.translation.times.push_back(1e-4 * key);
    motion.translation.values.insert(motion.translation.values.end(), {0.0, 0.0, 1e-4 * key});
  }
  io::MemoryBudget memory(1'000'000);
  DesignBuilder builder(memory);
  const auto add_some = [&](const world::MotionPointer& moves) {
    for (int i = 0; i < 100; ++i) builder.add(world::PhysicalObject{.name = "a", .motion = moves});
  };
  add_some(std::make_shared<const world::Motion>(motion));
  EXPECT_FALSE(builder.has_failed());
  EXPECT_LT(memory.left(), 1'000'000 - world::bytes_of(motion));
  for (int i = 0; i < 3; ++i) add_some(std::make_shared<const world::Motion>(motion));
  EXPECT_TRUE(builder.has_failed()) << "others count";
}

}  // namespace
}  // namespace icome::files
