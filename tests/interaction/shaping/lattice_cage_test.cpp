#include "interaction/shaping/lattice_cage.h"

#include <algorithm>
#include <limits>

#include "interaction/shaping/shaping_samples.h"
#include "world/edit/history.h"

namespace icome::interaction {
namespace {

using base::Affine3;
using base::Vector3;
using geometry::TriangleMesh;
using world::ObjectId;

LatticeCage cage_round(const world::World& world, const std::vector<ObjectId>& objects,
                       const std::array<int, 3>& cells = {2, 3, 1}) {
  auto made = LatticeCage::create(world, objects, cells);
  if (!made) throw std::runtime_error(made.error().message);
  return std::move(*made);
}

/// Drags a point there, as one who has it in his hand does.
void drag_point_to(world::World& world, LatticeCage& cage, std::size_t point, const Vector3& place) {
  const Vector3 start = cage.lattice().points[point];
  ASSERT_TRUE(apply(world, cage.drag(point).by(place - start)));
  cage.put(point, place);
  cage.accept(world);
}

/// Points all over the unit cube, in triangles that mean nothing.
TriangleMesh cloud(std::uint64_t seed) {
  base::Random random(seed);
  TriangleMesh mesh;
  for (std::uint32_t i = 0; i < 60; ++i) {
    mesh.positions.emplace_back(random.uniform(), random.uniform(), random.uniform());
    if (i % 3 == 2) mesh.triangles.push_back({i - 2, i - 1, i});
  }
  return mesh;
}

TEST(LatticeCage, IsRoundTheObjectAndMovesNothingAtRest) {
  ShapedWorld it(cloud(1));
  const std::vector<Vector3> kept = it.mesh().positions;
  const LatticeCage cage = cage_round(it.world, {it.thing});
  EXPECT_EQ(cage.lattice().points.size(), 3u * 4u * 2u);
  const Affine3 box_from_world = cage.lattice().space_from_box.inverse();
  Vector3 lowest = Vector3::Constant(1.0), highest = Vector3::Zero();
  for (const Vector3& vertex : it.vertices()) {
    lowest = lowest.cwiseMin(box_from_world * vertex);
    highest = highest.cwiseMax(box_from_world * vertex);
  }
  EXPECT_LT(lowest.norm(), 1e-12);
  EXPECT_LT((highest - Vector3::Ones()).norm(), 1e-12);
  for (std::size_t point = 0; point < cage.lattice().points.size(); ++point) {
    ASSERT_TRUE(apply(it.world, cage.drag(point).by(Vector3::Zero())));
    EXPECT_EQ(it.mesh().positions, kept) << "to the last bit";
  }
}

TEST(LatticeCage, AnAffineMotionOfAllPointsMovesVerticesAlike) {
  ShapedWorld it(cloud(2));
  const std::vector<Vector3> before = it.vertices();
  LatticeCage cage = cage_round(it.world, {it.thing});
  const Affine3 motion = askew(0.9);
  const std::vector<Vector3> rest = cage.lattice().points;
  for (std::size_t point = 0; point < rest.size(); ++point)
    drag_point_to(it.world, cage, point, motion * rest[point]);
  for (std::uint32_t v = 0; v < before.size(); ++v)
    EXPECT_LT((it.vertex(v) - motion * before[v]).norm(), 1e-12);
}

TEST(LatticeCage, APointDraggedTwiceGivesWhatTheLatticeSays) {
  ShapedWorld it(cloud(3));
  const std::vector<Vector3> before = it.vertices();
  LatticeCage cage = cage_round(it.world, {it.thing});
  const geometry::FfdBinding binding(before, cage.lattice());
  base::Random random(4);
  for (int i = 0; i < 30; ++i) {
    const std::size_t point = random.index(cage.lattice().points.size());
    drag_point_to(it.world, cage, point, cage.lattice().points[point] + 0.3 * random.direction());
    const std::vector<Vector3> wanted = binding.deformed(cage.lattice());
    for (std::uint32_t v = 0; v < before.size(); ++v) EXPECT_LT((it.vertex(v) - wanted[v]).norm(), 1e-12);
  }
}

TEST(LatticeCage, TouchesOnlyWhatGoesAlong) {
  ShapedWorld it(sheet_of(30));
  const LatticeCage cage = cage_round(it.world, {it.thing}, {2, 2, 1});
  const PointDrag drag = cage.drag(0);
  const auto& followers = drag.followers();
  ASSERT_EQ(followers.size(), 1u);
  EXPECT_LT(followers[0].vertices.size(), it.mesh().positions.size()) << "faces opposite stay";
  EXPECT_TRUE(std::ranges::all_of(followers[0].weights, [](double weight) { return weight > 0.0; }));
}

TEST(LatticeCage, GoesRoundSeveralAndMovesSharedShapesOnce) {
  world::World world;
  world::IdSource ids;
  const auto shape = std::make_shared<world::MeshGeometry>(cloud(5));
  const ObjectId group = add_object(world, ids, "group", nullptr, {}, world::at(1.0, 2.0, 3.0));
  const ObjectId one = add_object(world, ids, "one", shape, group);
  const ObjectId loop = add_object(
      world, ids, "loop", std::make_shared<world::LoopGeometry>(geometry::ControlMesh{sheet_of(2), {}, {}}),
      group, world::at(3.0, 0.0, 0.0));
  const ObjectId clone = add_object(world, ids, "clone", nullptr, {}, world::at(0.0, 0.0, 7.0));
  ASSERT_TRUE(apply(world, world::ChooseGeometry{clone, world.find(one)->geometry}));
  const std::uint64_t before = hash(world);
  LatticeCage cage = cage_round(world, {group, one, clone}, {1, 1, 1});
  world::History history;
  const PointDrag drag = cage.drag(6);
  EXPECT_EQ(drag.name(), "Deform 2 objects");
  EXPECT_EQ(drag.followers().size(), 2u);
  const auto corner = [&] {
    return draggable_mesh(*world.find(world.find(loop)->geometry)->shape)->positions[8];
  };
  EXPECT_EQ(corner(), Vector3(1, 1, 0));
  ASSERT_TRUE(history.perform(world, drag.by({0.0, 0.5, 0.0}), drag.name()));
  ASSERT_TRUE(history.extend(world, drag.by({0.0, 1.0, 0.0})));
  // By the corner (1, 1, 0) of the box from (1, 2, 3), which is 4 wide.
  const Vector3 there = cage.lattice().space_from_box.inverse() * Vector3(5.0, 3.0, 3.0);
  EXPECT_NEAR(corner().y(), 1.0 + there.x() * there.y() * (1.0 - there.z()), 1e-12);
  ASSERT_TRUE(history.undo(world));
  EXPECT_EQ(hash(world), before);
}

TEST(LatticeCage, FindsTheControlPointThatIsPointedAt) {
  ShapedWorld it(cloud(6));
  const LatticeCage cage = cage_round(it.world, {it.thing});
  for (std::size_t point = 0; point < cage.lattice().points.size(); ++point) {
    const Vector3& place = cage.lattice().points[point];
    EXPECT_EQ(cage.find(probe_round(place + Vector3(1e-3, 0, 0), 0.01)), point);
    const Vector3 eye(3.0, 5.0, 7.0);
    const auto found = cage.find(probe_along({eye, (place - eye).normalized()}, 1e-6));
    EXPECT_EQ(found, point);
  }
  EXPECT_FALSE(cage.find(probe_round(Vector3::Constant(100.0), 0.01)));
  EXPECT_FALSE(cage.find(probe_round(Vector3::Constant(std::numeric_limits<double>::quiet_NaN()), 1.0)));
}

TEST(LatticeCage, KnowsWhenTheWorldIsAnother) {
  ShapedWorld it(cloud(7));
  LatticeCage cage = cage_round(it.world, {it.thing});
  EXPECT_TRUE(cage.is_current(it.world));
  drag_point_to(it.world, cage, 3, Vector3(1, 2, 3));
  EXPECT_TRUE(cage.is_current(it.world));
  world::World moved = it.world;
  ASSERT_TRUE(apply(moved, world::PlaceObject{it.thing, world::at(1, 0, 0)}));
  EXPECT_FALSE(cage.is_current(moved));
  world::World bent = it.world;
  ASSERT_TRUE(apply(bent, it.drag({1}).by({0.1, 0.0, 0.0})));
  EXPECT_FALSE(cage.is_current(bent));
  EXPECT_FALSE(cage.is_current(world::World()));
}

TEST(LatticeCage, HasALineForEachRowOfPoints) {
  ShapedWorld it(cloud(8));
  const LatticeCage cage = cage_round(it.world, {it.thing}, {2, 3, 1});
  const std::vector<Vector3> lines = cage.lines();
  const auto partings = std::ranges::count_if(lines, [](const Vector3& p) { return !p.allFinite(); });
  EXPECT_EQ(partings, 4 * 2 + 3 * 2 + 3 * 4);
  EXPECT_EQ(lines.size(), 3u * 24u + std::size_t(partings));
}

TEST(LatticeCage, WhatCannotBeDeformedIsToldOf) {
  ShapedWorld it(cloud(9));
  const ObjectId box = add_object(it.world, it.ids, "box", world::box(1.0));
  const auto complaint = [&](const std::vector<ObjectId>& objects, const std::array<int, 3>& cells) {
    const auto made = LatticeCage::create(it.world, objects, cells);
    return made ? std::string() : made.error().message;
  };
  EXPECT_NE(complaint({it.thing, box}, {2, 2, 2}).find("'box' is an exact shape"), std::string::npos);
  EXPECT_NE(complaint({}, {2, 2, 2}).find("select"), std::string::npos);
  EXPECT_NE(complaint({it.thing}, {0, 2, 2}), "");
  EXPECT_NE(complaint({it.thing}, {2, 1 << 30, 1 << 30}), "");
  TriangleMesh point;
  point.positions.assign(3, Vector3::Ones());
  point.triangles = {{0, 1, 2}};
  const ObjectId none = add_object(it.world, it.ids, "none", std::make_shared<world::MeshGeometry>(point));
  EXPECT_NE(complaint({none}, {2, 2, 2}).find("no size"), std::string::npos);
}

}  // namespace
}  // namespace icome::interaction
