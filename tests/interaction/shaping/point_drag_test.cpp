#include "interaction/shaping/point_drag.h"

#include <cmath>
#include <limits>

#include "geometry/mesh/bent_normals.h"
#include "interaction/shaping/shaping_samples.h"
#include "world/edit/edit_bytes.h"
#include "world/edit/history.h"

namespace icome::interaction {
namespace {

using base::Vector3;
using geometry::Falloff;
using geometry::TriangleMesh;

TEST(PointDrag, AVertexIsWhereTheHandIsWhateverTheObjectsFrame) {
  ShapedWorld it(sheet_of(3));
  const std::vector<Vector3> before = it.vertices();
  const std::vector<Vector3> kept = it.mesh().positions;
  const PointDrag drag = it.drag({5});
  EXPECT_EQ(drag.name(), "Drag vertex of thing");
  base::Random random(1);
  for (int i = 0; i < 20; ++i) {  // each step counts from the beginning
    const Vector3 offset = random.uniform(0.0, 2.0) * random.direction();
    const world::Edit edit = drag.by(offset);
    EXPECT_EQ(std::get<world::MoveVertices>(edit.what).vertices, std::vector<std::uint32_t>{5});
    ASSERT_TRUE(apply(it.world, edit));
    EXPECT_LT((it.vertex(5) - before[5] - offset).norm(), 1e-12);
    for (std::uint32_t v = 0; v < kept.size(); ++v) {
      EXPECT_TRUE(v == 5 || it.mesh().positions[v] == kept[v]) << v;
    }
  }
  ASSERT_TRUE(apply(it.world, drag.by(Vector3::Zero())));
  EXPECT_EQ(it.mesh().positions, kept) << "to the last bit";
}

TEST(PointDrag, OthersFollowByTheirDistanceInTheWorld) {
  for (const Falloff falloff : {Falloff::Smooth, Falloff::Linear, Falloff::Sharp}) {
    ShapedWorld it(sheet_of(10));
    const std::vector<Vector3> before = it.vertices();
    const std::uint32_t middle = 5 * 11 + 5;
    const double radius = 0.3;
    const Vector3 offset(0.3, -0.2, 0.5);
    ASSERT_TRUE(apply(it.world, it.drag({middle}, {.radius = radius, .falloff = falloff}).by(offset)));
    int follow = 0;
    for (std::uint32_t v = 0; v < before.size(); ++v) {
      const double t = (before[v] - before[middle]).norm() / radius;
      const double left = std::max(0.0, 1.0 - t);
      const double weight = falloff == Falloff::Smooth   ? 1.0 - 3.0 * t * t + 2.0 * t * t * t
                            : falloff == Falloff::Linear ? left
                                                         : left * left;
      const Vector3 wanted = t < 1.0 ? Vector3(weight * offset) : Vector3(Vector3::Zero());
      EXPECT_LT((it.vertex(v) - before[v] - wanted).norm(), 1e-12) << v;
      follow += t < 1.0 ? 1 : 0;
    }
    EXPECT_GT(follow, 5);
    EXPECT_LT(follow, 100);
  }
}

TEST(PointDrag, EdgesAndFacesMoveAsTheyAre) {
  ShapedWorld it(sheet_of(4));
  const std::vector<Vector3> before = it.vertices();
  const std::vector<std::vector<std::uint32_t>> parts = {{6, 7}, {6, 7, 12}};
  for (const auto& part : parts) {
    const PointDrag drag = it.drag(part);
    const Vector3 offset(0.1, 0.2, -0.4);
    ASSERT_TRUE(apply(it.world, drag.by(offset)));
    for (std::uint32_t v = 0; v < before.size(); ++v) {
      const bool dragged = std::ranges::find(part, v) != part.end();
      EXPECT_LT((it.vertex(v) - before[v] - (dragged ? offset : Vector3(0, 0, 0))).norm(), 1e-12);
    }
    ASSERT_TRUE(apply(it.world, drag.by(Vector3::Zero())));
  }
}

TEST(PointDrag, VerticesAtOnePlaceStayTogether) {
  TriangleMesh torn;  // two triangles that have an edge in common by place only
  torn.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  torn.triangles = {{0, 1, 2}, {3, 4, 5}};
  ShapedWorld it(torn);
  ASSERT_TRUE(apply(it.world, it.drag({1}).by({0.0, 0.0, 1.0})));
  EXPECT_EQ(it.mesh().positions[1], it.mesh().positions[3]);
  EXPECT_NE(it.mesh().positions[1], torn.positions[1]);
}

TEST(PointDrag, ADragIsOneStepBackHoweverManyItHad) {
  ShapedWorld it(sheet_of(6));
  const std::uint64_t before = hash(it.world);
  const PointDrag drag = it.drag({24}, {.radius = 0.5});
  world::History history;
  ASSERT_TRUE(history.perform(it.world, drag.by({0.1, 0.0, 0.0}), drag.name()));
  base::Random random(2);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(history.extend(it.world, drag.by(random.direction())));
  const std::uint64_t after = hash(it.world);
  const auto undone = history.undo(it.world);
  ASSERT_TRUE(undone);
  EXPECT_EQ(hash(it.world), before);
  EXPECT_EQ(to_bytes(*undone)->size(), to_bytes(drag.by({0.1, 0.0, 0.0}))->size());
  ASSERT_TRUE(history.redo(it.world));
  EXPECT_EQ(hash(it.world), after);
}

TEST(PointDrag, NothingIsRoundedTwice) {
  ShapedWorld one(sheet_of(6)), other(sheet_of(6));
  const PointDrag drag = one.drag({24}, {.radius = 0.5});
  base::Random random(3);
  for (int i = 0; i < 200; ++i) ASSERT_TRUE(apply(one.world, drag.by(random.direction())));
  const Vector3 last(0.1, 0.7, -0.3);
  ASSERT_TRUE(apply(one.world, drag.by(last)));
  ASSERT_TRUE(apply(other.world, other.drag({24}, {.radius = 0.5}).by(last)));
  EXPECT_EQ(one.mesh().positions, other.mesh().positions);
}

/// With the normals of the facets at their corners.
std::shared_ptr<world::MeshGeometry> faceted(const TriangleMesh& mesh) {
  auto shape = std::make_shared<world::MeshGeometry>(mesh);
  shape->normals.assign(mesh.triangles.size(), {Vector3(0, 0, 1), Vector3(0, 0, 1), Vector3(0, 0, 1)});
  shape->recipe = "{}";
  return shape;
}

TEST(PointDrag, CornerNormalsBendAlong) {
  const auto shape = faceted(sheet_of(4));
  ShapedWorld it{world::GeometryPointer(shape)};
  const PointDrag drag = it.drag({12});
  const std::uint64_t before = hash(it.world);
  const Vector3 offset = 0.2 * it.place().linear().col(2);
  world::History history;
  ASSERT_TRUE(history.perform(it.world, drag.by(0.5 * offset), "Drag"));
  ASSERT_TRUE(history.extend(it.world, drag.by(offset)));
  EXPECT_FALSE(drag.last(offset)) << "they have been bent already";
  const auto& now = dynamic_cast<const world::MeshGeometry&>(it.shape());
  EXPECT_EQ(now.normals, geometry::bent_normals(shape->mesh, now.mesh.positions, shape->normals));
  EXPECT_NE(now.normals, shape->normals);
  EXPECT_EQ(now.recipe, "");
  ASSERT_TRUE(history.undo(it.world));
  EXPECT_EQ(hash(it.world), before);
}

TEST(PointDrag, CornerNormalsOfBigMeshesBendAtTheEnd) {
  const auto shape = faceted(sheet_of(80));
  ShapedWorld it{world::GeometryPointer(shape)};
  const PointDrag drag = it.drag({40 * 81 + 40});
  const std::uint64_t before = hash(it.world);
  const Vector3 offset = 0.2 * it.place().linear().col(2);
  world::History history;
  const world::Edit step = drag.by(offset);
  ASSERT_TRUE(std::holds_alternative<world::MoveVertices>(step.what));
  ASSERT_TRUE(history.perform(it.world, step, "Drag"));
  const auto last = drag.last(offset);
  ASSERT_TRUE(last);
  ASSERT_TRUE(history.extend(it.world, *last));
  const auto& now = dynamic_cast<const world::MeshGeometry&>(it.shape());
  EXPECT_EQ(now.normals, geometry::bent_normals(shape->mesh, now.mesh.positions, shape->normals));
  EXPECT_NE(now.normals, shape->normals);
  ASSERT_TRUE(history.undo(it.world));
  EXPECT_EQ(hash(it.world), before);
}

TEST(PointDrag, ControlMeshesOfLoopSurfacesAreDraggedLikewise) {
  ShapedWorld it(std::make_shared<world::LoopGeometry>(geometry::ControlMesh{sheet_of(3), {}, {}}));
  const std::vector<Vector3> before = it.vertices();
  const Vector3 offset(0.2, 0.1, 0.4);
  ASSERT_TRUE(apply(it.world, it.drag({5}).by(offset)));
  EXPECT_EQ(it.shape().kind(), "loop");
  EXPECT_LT((it.vertex(5) - before[5] - offset).norm(), 1e-12);
}

TEST(PointDrag, WhatCannotBeDraggedIsToldOf) {
  ShapedWorld it(sheet_of(2));
  const auto ball = world::add_object(it.world, it.ids, "ball", world::box(1.0));
  world::ObjectId flat;  // within parents that shrink space to nothing
  for (int i = 0; i < 4; ++i)
    flat = world::add_object(it.world, it.ids, "flat", std::make_shared<world::MeshGeometry>(sheet_of(1)),
                             flat, base::Affine3(Eigen::Scaling(1e-100)));
  const MeshPart vertex{.kind = PartKind::Vertex, .vertices = {0}};
  const auto complaint = [&](world::ObjectId id, const MeshPart& part, const geometry::SoftSelection& soft) {
    const auto made = drag_part(it.world, id, part, soft);
    return made ? std::string() : made.error().message;
  };
  EXPECT_NE(complaint(ball, vertex, {}).find("make a mesh of it first"), std::string::npos);
  EXPECT_NE(complaint(flat, vertex, {}).find("squashed flat"), std::string::npos);
  EXPECT_NE(complaint(it.world.find(it.thing)->parent, vertex, {}).find("no shape"), std::string::npos);
  EXPECT_NE(complaint({}, vertex, {}), "");
  EXPECT_NE(complaint(it.thing, {.vertices = {9}}, {}), "");
  EXPECT_NE(complaint(it.thing, {}, {}), "");
  EXPECT_NE(complaint(it.thing, vertex, {.radius = -1.0}), "");
  EXPECT_NE(complaint(it.thing, vertex, {.radius = std::numeric_limits<double>::quiet_NaN()}), "");
  EXPECT_EQ(complaint(it.thing, vertex, {.radius = 1e300}), "");
}

TEST(PointDrag, PlacesThatAreNotFiniteAreRefusedAndChangeNothing) {
  for (const auto& shape : {std::make_shared<world::MeshGeometry>(sheet_of(2)), faceted(sheet_of(2))}) {
    ShapedWorld it{world::GeometryPointer(shape)};
    const std::uint64_t before = hash(it.world);
    const PointDrag drag = it.drag({4});
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 1.7e308})
      EXPECT_FALSE(apply(it.world, drag.by(Vector3::Constant(bad)))) << bad;
    EXPECT_EQ(hash(it.world), before);
  }
}

}  // namespace
}  // namespace icome::interaction
