#include "session/felt/haptic_representation.h"

#include <numeric>

#include "haptics/effects/effect_text.h"
#include "haptics/servo/effect_feed.h"
#include "haptics/servo/renderer.h"
#include "haptics/shapes/mesh_shape.h"
#include "repeats.h"
#include "world/random_edits.h"

namespace icome::session {
namespace {

using base::Affine3;
using base::Vector3;
using world::add_object;
using world::applied;
using world::at;
using world::box;
using world::IdSource;
using world::World;

/// Applies an edit and has the representation follow.
void edit(World& world, HapticRepresentation& felt, const world::Edit& it) {
  applied(world, it);
  felt.follow(world, world::changes_of(it));
}

const haptics::HapticObject& object(const HapticRepresentation& felt, world::ObjectId id) {
  return felt.scene()->objects()[felt.scene()->find(felt.haptic_id(id).value()).value()];
}

/// Where a tip that comes down from `from` to `to` touches.
haptics::ScpState pressed(const haptics::HapticScene& scene, const Vector3& from, const Vector3& to) {
  const auto solver = haptics::make_solver(haptics::Renderer::Exact, {});
  solver->adopt(scene, {});
  for (int i = 0; i <= 200; ++i) solver->step(from + i / 200.0 * (to - from), 0.0);
  for (int i = 0; i < 20; ++i) solver->step(to, 0.0);
  return solver->state();
}

TEST(HapticRepresentation, NamesObjectsBothWays) {
  World world;
  IdSource ids;
  const auto table = add_object(world, ids, "table", box(1.0));
  const auto group = add_object(world, ids, "group", nullptr);
  const auto leg = add_object(world, ids, "leg", box(0.1), group, at(2.0, 0.0, 0.0));
  HapticRepresentation felt;
  felt.show(world);
  ASSERT_EQ(felt.scene()->objects().size(), 2U);
  for (const auto id : {table, leg}) EXPECT_EQ(felt.object(felt.haptic_id(id).value()), id);
  EXPECT_FALSE(felt.haptic_id(group));
  EXPECT_FALSE(felt.object({7, 1}));
  EXPECT_EQ(object(felt, leg).world_from_object.translation(), Vector3(2.0, 0.0, 0.0));
}

TEST(HapticRepresentation, NamesOfWhatIsGoneAreNotGivenAgain) {
  World world;
  IdSource ids;
  const auto one = add_object(world, ids, "one", box(1.0));
  HapticRepresentation felt;
  felt.show(world);
  const base::ObjectId name = felt.haptic_id(one).value();
  edit(world, felt, delete_subtree(world, one));
  EXPECT_FALSE(felt.object(name));
  EXPECT_TRUE(felt.scene()->objects().empty());
  const auto other = add_object(world, ids, "other", box(1.0));
  felt.show(world);
  EXPECT_EQ(felt.haptic_id(other)->index, name.index);
  EXPECT_FALSE(felt.object(name));
}

TEST(HapticRepresentation, MakesAShapeOnceForAllClones) {
  World world;
  IdSource ids;
  const auto leg = add_object(world, ids, "leg", world::one_triangle());
  std::vector<world::ObjectId> legs{leg};
  for (int i = 1; i < 40; ++i) {
    legs.push_back(duplicated(world, ids, leg, world::Duplicate::CloneObject));
    applied(world, world::PlaceObject{
                       legs.back(), at(i, 0.0, 0.0) * Affine3(Eigen::AngleAxisd(0.1 * i, Vector3::UnitX()))});
  }
  HapticRepresentation felt;
  felt.show(world);
  EXPECT_EQ(felt.work().shapes, 1U);
  for (const auto id : legs) EXPECT_EQ(object(felt, id).shape, object(felt, leg).shape);
  // Clones of one stretch share a shape, too, however they are turned.
  for (int i = 20; i < 40; ++i)
    applied(world, world::PlaceObject{legs[i], Affine3(Eigen::AngleAxisd(0.1 * i, Vector3(0.6, 0.8, 0.0))) *
                                                   Affine3(Eigen::Scaling(1.0, 2.0, 3.0))});
  felt.show(world);
  EXPECT_EQ(felt.work().shapes, 2U);
  EXPECT_EQ(object(felt, legs[20]).shape, object(felt, legs[39]).shape);
}

TEST(HapticRepresentation, MakesAShapeOnceForAllThatShareItInMemory) {
  World world;
  IdSource ids;
  const world::GeometryPointer ball =
      std::make_shared<world::PrimitiveGeometry>(geometry::Primitive(geometry::Sphere{0.1}));
  std::vector<world::ObjectId> balls;
  for (int i = 0; i < 5; ++i) balls.push_back(add_object(world, ids, "ball", ball, {}, at(i, 0.0, 0.0)));
  HapticRepresentation felt;
  felt.show(world);
  EXPECT_EQ(felt.work().shapes, 1U);
  for (const auto id : balls) EXPECT_EQ(object(felt, id).shape, object(felt, balls[0]).shape);

  // They are shapes of their own: an edit of one is felt on that alone, and leaves the others what they are.
  edit(world, felt, world::ReplaceGeometry{world.find(balls[0])->geometry, box(0.5)});
  EXPECT_EQ(felt.work().shapes, 2U);
  EXPECT_TRUE(std::holds_alternative<geometry::Box>(*felt.felt(balls[0])->primitive));
  for (std::size_t i = 1; i < balls.size(); ++i)
    EXPECT_TRUE(std::holds_alternative<geometry::Sphere>(*felt.felt(balls[i])->primitive));

  // The shape stays for as long as one has it, and no longer.
  const std::weak_ptr<const haptics::Shape> last = object(felt, balls[1]).shape;
  for (std::size_t i = 1; i < balls.size(); ++i) {
    EXPECT_FALSE(last.expired());
    edit(world, felt, delete_subtree(world, balls[i]));
  }
  EXPECT_TRUE(last.expired());
}

TEST(HapticRepresentation, AMeshWithTheCoordinatesOfAMapIsFeltAboutItsMiddle) {
  const Vector3 far(500'000.25, 4'200'000.5, -0.125);
  geometry::TriangleMesh mesh = geometry::tessellate(geometry::Sphere{0.05}, 1e-3);
  for (Vector3& position : mesh.positions) position += far;
  World world;
  IdSource ids;
  const Affine3 frame(Eigen::AngleAxisd(0.5, Vector3::UnitZ()) * Eigen::Scaling(2.0));
  const auto ball = add_object(world, ids, "ball", std::make_shared<world::MeshGeometry>(mesh), {}, frame);
  HapticRepresentation felt;
  felt.show(world);
  const auto expect_in_place = [&] {
    const haptics::HapticObject& it = object(felt, ball);
    const auto& shape = dynamic_cast<const haptics::MeshShape&>(*it.shape);
    EXPECT_LT(shape.bounds().center().norm(), 1.0);
    for (std::size_t v = 0; v < mesh.positions.size(); v += 10)
      EXPECT_LT((it.world_from_object * shape.mesh().positions[v] - frame * mesh.positions[v]).norm(), 1e-8);
  };
  expect_in_place();
  // Also when its vertices are moved, and the mesh follows.
  std::vector<std::uint32_t> vertices(mesh.positions.size());
  std::iota(vertices.begin(), vertices.end(), 0U);
  for (Vector3& position : mesh.positions) position.y() += 0.25;
  edit(world, felt, world::MoveVertices{world.find(ball)->geometry, vertices, mesh.positions});
  expect_in_place();
}

TEST(HapticRepresentation, OfOneSceneIsBuiltWithoutTheOthers) {
  World world;
  IdSource ids;
  const auto chair = add_object(world, ids, "chair", box(1.0));
  const auto seat = add_object(world, ids, "seat", box(0.5), chair);
  const auto tree = add_object(world, ids, "tree", box(2.0));
  const auto shed = add_object(world, ids, "shed", box(3.0));
  const world::SceneId room{100}, garden{101};
  applied(world, world::CreateScene{room, "room"});
  applied(world, world::CreateScene{garden, "garden"});
  applied(world, world::EnterScene{room, chair, 0});
  applied(world, world::EnterScene{room, seat, 1});  // a root below a root is there once
  applied(world, world::EnterScene{garden, tree, 0});
  applied(world, world::EnterScene{garden, chair, 1});
  HapticRepresentation felt;
  felt.show(world, room);
  EXPECT_EQ(felt.scene()->objects().size(), 2U);
  EXPECT_EQ(felt.work().shapes, 2U);
  const auto seat_shape = object(felt, seat).shape;
  felt.show(world, garden);
  EXPECT_EQ(felt.work().shapes, 3U);  // the tree's only
  EXPECT_TRUE(felt.haptic_id(tree) && felt.haptic_id(chair) && felt.haptic_id(seat));
  EXPECT_EQ(object(felt, seat).shape, seat_shape);
  felt.show(world, room);
  EXPECT_EQ(felt.work().shapes, 3U);  // nothing is made again
  EXPECT_FALSE(felt.haptic_id(tree));
  // What happens elsewhere costs nothing.
  const auto before = felt.work();
  edit(world, felt, world::PlaceObject{tree, at(1.0, 0.0, 0.0)});
  edit(world, felt, world::ReplaceGeometry{world.find(shed)->geometry, box(4.0)});
  EXPECT_EQ(felt.work().shapes, before.shapes);
  EXPECT_EQ(felt.work().compiled, before.compiled);
  EXPECT_EQ(felt.work().moved, before.moved);
  edit(world, felt, world::LeaveScene{room, chair});
  EXPECT_EQ(felt.scene()->objects().size(), 1U);
  EXPECT_EQ(felt.work().shapes, before.shapes);
}

TEST(HapticRepresentation, AnEditOfOneOfVeryManyObjectsIsCheap) {
  World world;
  IdSource ids;
  const int count = 100'000;
  const auto first = add_object(world, ids, "0", box(0.5));
  const auto shape = world.find(first)->geometry;
  world::ObjectId last = first;
  for (int i = 1; i < count; ++i) {
    last = ids.next<world::ObjectId>();
    applied(world,
            world::CreateObject{
                last, std::size_t(i), {.parent_from_object = at(i % 100, i / 100, 0.0), .geometry = shape}});
  }
  HapticRepresentation felt;
  felt.show(world);
  EXPECT_EQ(felt.work().shapes, 1U);
  EXPECT_EQ(felt.work().compiled, 1U);
  edit(world, felt, world::PlaceObject{last, at(0.0, 0.0, 7.0)});
  EXPECT_EQ(felt.work().shapes, 1U);
  EXPECT_EQ(felt.work().compiled, 1U);
  EXPECT_EQ(felt.work().moved, 1U);
  EXPECT_EQ(object(felt, last).world_from_object.translation().z(), 7.0);
  const world::GeometryId ball{1'000'000};
  applied(world,
          world::CreateGeometry{ball, std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{0.2})});
  edit(world, felt, world::ChooseGeometry{last, ball});
  EXPECT_EQ(felt.work().shapes, 2U);
  EXPECT_EQ(felt.work().compiled, 2U);
  edit(world, felt, world::RenameObject{last, "last"});
  EXPECT_EQ(felt.work().compiled, 2U);
  EXPECT_EQ(felt.work().moved, 1U);
}

TEST(HapticRepresentation, WhatIsDraggedGoesEvenlyToWhereItIsPut) {
  double now = 5.0;  // s
  HapticRepresentationSettings settings;
  settings.glide_seconds = 0.02;
  settings.clock = [&] { return now; };
  World world;
  IdSource ids;
  const auto table = add_object(world, ids, "table", box(1.0));
  HapticRepresentation felt(settings);
  felt.show(world);
  const auto place = [&](double later) {
    const auto& scene = *felt.scene();
    const auto index = scene.find(felt.haptic_id(table).value()).value();
    return scene.pose(index, now + later - scene.moment()).translation().x();
  };
  const auto speed = [&](double later) {
    const auto& scene = *felt.scene();
    const auto index = scene.find(felt.haptic_id(table).value()).value();
    return scene.velocity(index, now + later - scene.moment(), Vector3::Zero()).x();
  };
  edit(world, felt, world::PlaceObject{table, at(0.02, 0.0, 0.0)});
  EXPECT_NEAR(place(0.0), 0.0, 1e-12);
  EXPECT_NEAR(place(0.005), 0.005, 1e-12);
  EXPECT_NEAR(speed(0.005), 1.0, 1e-9);
  EXPECT_NEAR(place(0.5), 0.02, 1e-12);
  EXPECT_EQ(speed(0.021), 0.0);
  // On the way it is put elsewhere, and a new object makes the scene anew: it goes on from where it is.
  now += 0.01;
  edit(world, felt, world::PlaceObject{table, at(0.05, 0.0, 0.0)});
  EXPECT_NEAR(place(0.0), 0.01, 1e-12);
  EXPECT_NEAR(speed(0.0), 2.0, 1e-9);
  now += 0.005;
  const auto other = ids.next<world::ObjectId>();
  edit(world, felt,
       world::CreateObject{other, 1, {.name = "other", .geometry = world.find(table)->geometry}});
  EXPECT_NEAR(place(0.0), 0.02, 1e-12);
  EXPECT_NEAR(place(0.01), 0.04, 1e-12);
  EXPECT_NEAR(place(0.5), 0.05, 1e-12);
  now += 1.0;
  edit(world, felt, world::RenameObject{table, "board"});
  EXPECT_EQ(place(0.0), 0.05);
  EXPECT_TRUE(object(felt, table).motion.still());
}

TEST(HapticRepresentation, TakesWhatIsBelowAlong) {
  World world;
  IdSource ids;
  const auto table = add_object(world, ids, "table", box(1.0));
  const auto leg = add_object(world, ids, "leg", box(0.1), table, at(0.0, 0.0, -1.0));
  HapticRepresentation felt;
  felt.show(world);
  edit(world, felt, world::PlaceObject{table, at(5.0, 0.0, 0.0)});
  EXPECT_EQ(object(felt, leg).world_from_object.translation(), Vector3(5.0, 0.0, -1.0));
  EXPECT_EQ(felt.work().moved, 1U);
  // Stretched by its parent: a shape of its own for each.
  edit(world, felt, world::PlaceObject{table, Affine3(Eigen::Scaling(1.0, 1.0, 2.0))});
  EXPECT_EQ(object(felt, leg).world_from_object.translation(), Vector3(0.0, 0.0, -2.0));
  EXPECT_EQ(geometry::name(*felt.felt(leg)->primitive), "box:0.1x0.1x0.2");
}

TEST(HapticRepresentation, ForgetsStretchedShapesThatNobodyHasAnyMore) {
  World world;
  IdSource ids;
  const auto ball = add_object(world, ids, "ball", world::one_triangle());
  HapticRepresentation felt;
  felt.show(world);
  std::weak_ptr<const FeltShape> last = felt.felt(ball);
  for (int i = 2; i < 10; ++i) {
    edit(world, felt, world::PlaceObject{ball, Affine3(Eigen::Scaling(1.0, 1.0, double(i)))});
    EXPECT_TRUE(last.expired());
    last = felt.felt(ball);
  }
}

TEST(HapticRepresentation, FollowsMaterials) {
  World world;
  IdSource ids;
  const auto table = add_object(world, ids, "table", box(1.0));
  const world::MaterialId wood{50};
  applied(world, world::CreateMaterial{wood, {.name = "wood"}});
  applied(world, world::ChooseMaterial{table, wood});
  HapticRepresentation felt;
  felt.show(world);
  EXPECT_EQ(object(felt, table).surface.stiffness, 0.0);
  EXPECT_EQ(object(felt, table).surface.damping, haptics::kAutomaticDamping);
  world::Material rough{.name = "rough"};
  rough.touch = {.stiffness = 700.0,
                 .damping = 3.0,
                 .static_friction = 0.5,
                 .dynamic_friction = 0.25,
                 .texture = "grooves"};
  edit(world, felt, world::ChangeMaterial{wood, rough});
  const haptics::Surface surface = object(felt, table).surface;
  EXPECT_EQ(surface.stiffness, 700.0);
  EXPECT_EQ(surface.damping, 3.0);
  EXPECT_EQ(surface.static_friction, 0.5);
  EXPECT_EQ(surface.dynamic_friction, 0.25);
  EXPECT_TRUE(surface.texture);
  EXPECT_EQ(felt.work().shapes, 1U);
  EXPECT_TRUE(felt.remarks(world).empty());
  rough.touch.texture = "velvet";
  edit(world, felt, world::ChangeMaterial{wood, rough});
  ASSERT_EQ(felt.remarks(world).size(), 1U);
  EXPECT_NE(felt.remarks(world)[0].find("velvet"), std::string::npos);
}

TEST(HapticRepresentation, HasTheEffectsOfItsObjectsWhereTheyAre) {
  World world;
  IdSource ids;
  const auto effect = [](const char* text, bool on = true) {
    return std::make_shared<const world::Fixture>(world::ForceEffect{text, on});
  };
  const auto group = add_object(world, ids, "group", nullptr);
  const auto pull = add_object(world, ids, "pull", nullptr, group, at(2.0, 0.0, 0.0));
  HapticRepresentation felt;
  felt.show(world);
  EXPECT_TRUE(felt.effects().empty());
  edit(world, felt, world::ChangeFixture{pull, effect("point:0,0,0")});
  ASSERT_EQ(felt.effects().size(), 1U);
  EXPECT_EQ(felt.effects()[0].text, "point:0,0,0");
  EXPECT_EQ(felt.effects()[0].world_from_effect.translation(), Vector3(2.0, 0.0, 0.0));
  edit(world, felt, world::PlaceObject{group, at(0.0, 1.0, 0.0)});
  EXPECT_EQ(felt.effects()[0].world_from_effect.translation(), Vector3(2.0, 1.0, 0.0));
  edit(world, felt, world::ChangeFixture{pull, effect("point:0,0,0", false)});
  EXPECT_TRUE(felt.effects().empty()) << "switched off";
  EXPECT_TRUE(felt.remarks(world).empty());
  edit(world, felt, world::ChangeFixture{pull, effect("pull:0,0,0")});
  EXPECT_TRUE(felt.effects().empty());
  ASSERT_EQ(felt.remarks(world).size(), 1U);
  EXPECT_NE(felt.remarks(world)[0].find("\"pull\" is an effect that is not felt"), std::string::npos);
  edit(world, felt, world::ChangeFixture{pull, effect("viscous:1")});
  EXPECT_EQ(felt.effects().size(), 1U);
  edit(world, felt, delete_subtree(world, group));
  EXPECT_TRUE(felt.effects().empty());
}

/// The orthogonal matrix nearest to this one, by Higham's iteration.
base::Matrix3 nearest_turn(base::Matrix3 matrix) {
  for (int i = 0; i < 100; ++i) matrix = 0.5 * (matrix + matrix.inverse().transpose()).eval();
  return matrix;
}

Affine3 random_stretch(base::Random& random, int i) {
  Affine3 place = Affine3::Identity();
  if (i % 3 > 0) place.rotate(Eigen::AngleAxisd(random.uniform(0.0, 3.0), random.direction()));
  Vector3 scale(random.uniform(0.3, 3.0), random.uniform(0.3, 3.0), random.uniform(0.3, 3.0));
  if (i % 2 == 0) scale = Vector3::Constant(scale.x());
  for (int axis = 0; axis < 3; ++axis)
    if (random.uniform(0.0, 1.0) < 0.4) scale[axis] = -scale[axis];
  place.scale(scale);
  place.translation() = 0.05 * random.direction();
  return place;
}

// A group that is stretched, turned and mirrored, and in it an effect that is turned and mirrored: it keeps
// its numbers, and turns and mirrors as the nearest orthogonal matrix does.
TEST(HapticRepresentation, EffectsBelowStretchedAndMirroredGroupsKeepTheirNumbers) {
  base::Random random(17);
  int mirrored = 0;
  for (int i = 0; i < 60; ++i) {
    World world;
    IdSource ids;
    const Affine3 outer = random_stretch(random, i), inner = random_stretch(random, i / 3);
    const auto group = add_object(world, ids, "group", nullptr, {}, outer);
    const auto model = add_object(world, ids, "effect", nullptr, group, inner);
    const std::string texts[] = {"point:0.01,0.02,-0.01,100,0", "line:0.01,0,0,1,2,3,100,0",
                                 "constant:0.1,0.2,0.3", "recess:0.01,0,0,1,0.2,0,0.001,0.3,1",
                                 "field:x,0,10*y*z"};
    const std::string& text = texts[i % 5];
    applied(world,
            world::ChangeFixture{model, std::make_shared<const world::Fixture>(world::ForceEffect{text})});
    HapticRepresentation felt;
    felt.show(world);
    ASSERT_EQ(felt.effects().size(), 1U);
    haptics::EffectFeed feed;
    feed.publish(felt.effects());
    feed.follow(1e-3);
    const Affine3 place = outer * inner;
    const base::Matrix3 turn = nearest_turn(place.linear());
    if (turn.determinant() < 0.0) ++mirrored;
    const auto alone = haptics::make_effect(text).value();
    for (int k = 0; k < 20; ++k) {
      haptics::EffectInput input;
      input.position = input.scp = place.translation() + random.uniform(0.0, 0.1) * random.direction();
      input.velocity = 0.1 * random.direction();
      haptics::EffectInput own = input;
      own.position = own.scp = turn.transpose() * (input.position - place.translation());
      own.velocity = turn.transpose() * input.velocity;
      const Vector3 expected = turn * alone->force(own);
      EXPECT_LT((feed.force(input, 0.0) - expected).norm(), 1e-9) << text << "\n" << place.matrix();
    }
  }
  EXPECT_GT(mirrored, 10);
}

TEST(HapticRepresentation, LeavesOutEffectsThatCannotBePlacedOrAreTooMany) {
  World world;
  IdSource ids;
  world::ObjectId lost = add_object(world, ids, "lost", nullptr);
  for (int i = 0; i < 4; ++i)
    lost = add_object(world, ids, "farther", nullptr, lost, Affine3(Eigen::Scaling(1e100)));
  const auto child = add_object(world, ids, "far", nullptr, lost, at(1.0, 0.0, 0.0));
  const auto push = std::make_shared<const world::Fixture>(world::ForceEffect{"constant:0,0,1", true});
  HapticRepresentation felt;
  felt.show(world);
  edit(world, felt, world::ChangeFixture{child, push});
  EXPECT_TRUE(felt.effects().empty());
  ASSERT_EQ(felt.remarks(world).size(), 1U);
  EXPECT_NE(felt.remarks(world)[0].find("its place is not finite"), std::string::npos);
  for (int i = 0; i < 300; ++i)
    edit(world, felt, world::ChangeFixture{add_object(world, ids, "push", nullptr), push});
  felt.show(world);
  EXPECT_EQ(felt.effects().size(), 256U);
  EXPECT_NE(felt.remarks(world).back().find("Of 301 effects only the first 256"), std::string::npos);
}

TEST(HapticRepresentation, TellsWhatCannotBeTouched) {
  World world;
  IdSource ids;
  const auto empty =
      add_object(world, ids, "nothing", std::make_shared<world::MeshGeometry>(geometry::TriangleMesh{}));
  duplicated(world, ids, empty, world::Duplicate::CloneObject);
  add_object(world, ids, "floor", std::make_shared<world::PrimitiveGeometry>(geometry::Plane{}), {},
             Affine3(Eigen::Scaling(1.0, 2.0, 3.0)));
  HapticRepresentation felt;
  felt.show(world);
  EXPECT_EQ(felt.scene()->objects().size(), 1U);
  EXPECT_EQ(felt.remarks(world),
            std::vector<std::string>{"\"nothing\" (and 1 more) is empty: there is nothing to touch."});
  EXPECT_FALSE(felt.haptic_id(empty));
}

TEST(HapticRepresentation, IsFeltWhereTheObjectsAre) {
  World world;
  IdSource ids;
  const auto sphere = [](double radius) {
    return std::make_shared<world::PrimitiveGeometry>(geometry::Sphere{radius});
  };
  // An ellipsoid of half axes 0.02, 0.03, 0.05 m; a box that is sheared; a mirrored cone; a mesh.
  add_object(world, ids, "egg", sphere(0.01), {}, at(1, 0, 0) * Affine3(Eigen::Scaling(2.0, 3.0, 5.0)));
  Affine3 sheared = at(2, 0, 0);
  sheared.linear()(0, 2) = 0.5;
  add_object(world, ids, "slanted", box(0.1), {}, sheared);
  add_object(world, ids, "funnel",
             std::make_shared<world::PrimitiveGeometry>(geometry::Cone{0.05, 0.01, 0.1}), {},
             at(3, 0, 0) * Affine3(Eigen::Scaling(1.0, 1.0, -1.0)));
  const auto block = std::make_shared<world::MeshGeometry>(
      geometry::tessellate(geometry::Primitive(geometry::Box{Vector3::Constant(0.01)}), 1e-3));
  add_object(world, ids, "block", block, {}, at(4, 0, 0) * Affine3(Eigen::Scaling(-2.0, 1.0, 4.0)));
  HapticRepresentation felt;
  felt.show(world);
  const haptics::HapticScene& scene = *felt.scene();
  const double gap = 1e-8;
  EXPECT_NEAR(pressed(scene, {1, 0, 0.1}, {1, 0, 0.045}).scp.z(), 0.05, gap);
  EXPECT_NEAR(pressed(scene, {1, 0.1, 0}, {1, 0.028, 0}).scp.y(), 0.03, gap);
  const Vector3 off_axis = pressed(scene, {1.01, 0.01, 0.1}, {1.01, 0.01, 0.03}).scp - Vector3(1, 0, 0);
  EXPECT_NEAR(off_axis.cwiseQuotient(Vector3(0.02, 0.03, 0.05)).norm(), 1.0, 1e-6);
  const Vector3 side = pressed(scene, {2.2, 0, 0.02}, {2.05, 0, 0.02}).scp;
  EXPECT_NEAR(side.x() - 2.0 - 0.5 * side.z(), 0.05, gap);  // the face x = 0.05 of the box, sheared
  EXPECT_NEAR(pressed(scene, {3.03, 0, 0.1}, {3.03, 0, 0.045}).scp.z(), 0.05, gap);  // its wide end is on top
  EXPECT_NEAR(pressed(scene, {4, 0, 0.1}, {4, 0, 0.03}).scp.z(), 0.04, gap);
  EXPECT_NEAR(pressed(scene, {3.9, 0, 0}, {3.985, 0, 0}).scp.x(), 3.98, gap);
}

/// The scene as the world has it, however it came about.
void expect_up_to_date(const World& world, const HapticRepresentation& felt, world::SceneId scene) {
  HapticRepresentation fresh;
  fresh.show(world, scene);
  ASSERT_EQ(felt.scene()->objects().size(), fresh.scene()->objects().size());
  for (const haptics::HapticObject& it : fresh.scene()->objects()) {
    const world::ObjectId id = fresh.object(it.id).value();
    ASSERT_TRUE(felt.haptic_id(id));
    const haptics::HapticObject& same = object(felt, id);
    EXPECT_EQ(same.world_from_object.matrix(), it.world_from_object.matrix());
    EXPECT_EQ(same.shape->bounds().min(), it.shape->bounds().min());
    EXPECT_EQ(same.shape->bounds().max(), it.shape->bounds().max());
    EXPECT_EQ(same.surface.sides, it.surface.sides);
  }
}

TEST(HapticRepresentation, FollowsRandomEdits) {
  for (std::uint64_t seed = 0; seed < (kSanitizerShare > 1 ? 4 : 20) && !testing::Test::HasFatalFailure();
       ++seed) {
    World world;
    world::RandomEdits edits(seed);
    HapticRepresentation whole, part;
    world::SceneId scene;
    for (int i = 0; i < 300; ++i) {
      const world::Edit edit = edits.next(world);
      const auto inverse = apply(world, edit);
      if (!inverse) continue;
      if (!scene && !world.scenes().empty()) {
        scene = world.scenes().begin()->first;
        part.show(world, scene);
      }
      whole.follow(world, world::changes_of(edit));
      if (scene) part.follow(world, world::changes_of(*inverse));
      if (i % 10 != 0) continue;
      expect_up_to_date(world, whole, {});
      if (scene) expect_up_to_date(world, part, scene);
    }
  }
}

}  // namespace
}  // namespace icome::session
