#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "interaction/operations/shapes/shape_operations.h"
#include "interaction/shape_samples.h"

namespace icome::interaction {
namespace {

using base::Affine3;

/// The stairs of figure 2.11: a square with the look of wood becomes a step, whose copy is placed by hand
/// about a point; the rest follows.
void build_stairs(OperationRunner& runner, const std::string& how) {
  performed(runner, R"({"op": "create", "shape": "square", "name": "tread", "at": [0.6, 0, 0],
                        "turn": [-90, 0, 0], "material": "wood"})");
  performed(runner, R"({"op": "extrude", "profile": "tread", "name": "stair",
                        "steps": [{"move": [0, 0, 0.04]}]})");
  performed(runner, R"({"op": "delete", "objects": "tread"})");
  performed(runner, R"({"op": "repeat", "object": "stair", "count": 11, "pivot": [0, 0, 0],
                        "move": [0, 0.18, 0], "turn": [0, 30, 0], "into": "stairs", "how": ")" +
                        how + "\"}");
}

OperationRunner workshop() {
  world::World world;
  EXPECT_TRUE(apply(world, world::CreateMaterial{world::MaterialId{99}, {.name = "wood"}}));
  return OperationRunner(std::move(world));
}

TEST(RepeatOperation, BuildsStairs) {
  OperationRunner runner = workshop();
  build_stairs(runner, "clone");
  const world::World& world = runner.world();
  const world::PhysicalObject& first = object_named(runner, "stairs/stair");
  const auto& stairs = object_named(runner, "stairs").children;
  ASSERT_EQ(stairs.size(), 12U);
  for (std::size_t i = 0; i < stairs.size(); ++i) {
    const world::PhysicalObject& stair = *world.find(stairs[i]);
    EXPECT_EQ(stair.name, i == 0 ? "stair" : "stair " + std::to_string(i + 1));
    EXPECT_EQ(stair.geometry, first.geometry);
    EXPECT_EQ(stair.material.value, 99U);
    const double angle = double(i) * std::numbers::pi / 6;
    const Vector3 middle(0.6 * std::cos(angle), 0.18 * double(i), -0.6 * std::sin(angle));
    EXPECT_LT((world_from_object(world, stairs[i]).translation() - middle).norm(), 1e-14) << i;
    const Affine3 turned = Eigen::AngleAxisd(angle, Vector3::UnitY()) * first.parent_from_object;
    EXPECT_LT((stair.parent_from_object.linear() - turned.linear()).norm(), 1e-14) << i;
  }
  EXPECT_EQ(world.find(first.geometry)->users, 12U);
}

TEST(RepeatOperation, CopiesHaveShapesOfTheirOwn) {
  OperationRunner runner = workshop();
  build_stairs(runner, "copy");
  EXPECT_EQ(runner.world().geometries().size(), 12U);
  performed(runner, R"({"op": "reshape", "object": "stair 5", "steps": [{"move": [0, 0, 0.5]}]})");
  EXPECT_NE(shape_named(runner, "stair 5")->hash(), shape_named(runner, "stair 6")->hash());
}

TEST(RepeatOperation, TurnsAndScalesAboutThePivot) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "box", "name": "a", "at": [4, 0, 0]})");
  performed(runner, R"({"op": "repeat", "object": "a", "count": 3, "factor": 0.5, "pivot": [2, 0, 0]})");
  EXPECT_EQ(Vector3(object_named(runner, "a 2").parent_from_object.translation()), Vector3(3, 0, 0));
  EXPECT_EQ(Vector3(object_named(runner, "a 4").parent_from_object.translation()), Vector3(2.25, 0, 0));
  EXPECT_EQ(object_named(runner, "a 4").parent_from_object.linear(), 0.125 * base::Matrix3::Identity());
  // About its own origin, where nothing is said.
  performed(runner, R"({"op": "create", "shape": "box", "name": "b", "at": [4, 0, 0]})");
  performed(runner, R"({"op": "repeat", "object": "b", "count": 1, "turn": [0, 90, 0], "move": [0, 1, 0]})");
  EXPECT_EQ(Vector3(object_named(runner, "b 2").parent_from_object.translation()), Vector3(4, 1, 0));
}

TEST(RepeatOperation, RepeatsAllBelowAndStaysUnderTheParent) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "group", "name": "room"})");
  performed(runner, R"({"op": "create", "shape": "group", "name": "chair", "parent": "room"})");
  performed(runner, R"({"op": "create", "shape": "box", "name": "seat", "parent": "chair"})");
  const auto made =
      performed(runner, R"({"op": "repeat", "object": "chair", "count": 2, "move": [1, 0, 0]})");
  ASSERT_EQ(made.objects.size(), 2U);
  const auto& chairs = object_named(runner, "room").children;
  ASSERT_EQ(chairs.size(), 3U);
  EXPECT_EQ(chairs[1], made.objects[0]);
  EXPECT_EQ(runner.world().find(chairs[2])->name, "chair 3");
  for (const world::ObjectId chair : chairs)
    EXPECT_EQ(runner.world().find(runner.world().find(chair)->children.at(0))->name, "seat");
}

TEST(RepeatOperation, TheGroupStandsInThePlaceOfTheObject) {
  OperationRunner runner({});
  for (const char* name : {"before", "it", "behind"})
    performed(runner,
              R"({"op": "create", "shape": "box", "at": [1, 2, 3], "name": ")" + std::string(name) + "\"}");
  performed(runner, R"({"op": "repeat", "object": "it", "count": 1, "move": [1, 0, 0], "into": "pair"})");
  ASSERT_EQ(runner.world().roots().size(), 3U);
  EXPECT_EQ(runner.world().find(runner.world().roots()[1])->name, "pair");
  const auto it = named_object(runner.world(), "pair/it");
  EXPECT_EQ(Vector3(world_from_object(runner.world(), *it).translation()), Vector3(1, 2, 3));
  EXPECT_EQ(Vector3(object_named(runner, "pair").parent_from_object.translation()), Vector3(1, 2, 3));
}

TEST(RepeatOperation, IsTakenBackAndDoneAgainTheSame) {
  OperationRunner first = workshop(), second = workshop();
  const std::uint64_t empty = hash(first.world());
  build_stairs(first, "clone");
  build_stairs(second, "clone");
  const std::uint64_t built = hash(first.world());
  EXPECT_EQ(hash(second.world()), built);
  for (int i = 0; i < 4; ++i) performed(first, R"({"op": "undo"})");
  EXPECT_EQ(hash(first.world()), empty);
  for (int i = 0; i < 4; ++i) performed(first, R"({"op": "redo"})");
  EXPECT_EQ(hash(first.world()), built);
}

TEST(RepeatOperation, RefusesWhatLeadsNowhere) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "box", "name": "a"})");
  for (const char* said :
       {R"("count": 0, "move": [1, 0, 0])", R"("count": -1, "move": [1, 0, 0])",
        R"("count": 1.5, "move": [1, 0, 0])", R"("count": 9007199254740992, "move": [1, 0, 0])",
        R"("count": 1e300, "move": [1, 0, 0])", R"("count": 3)", R"("count": 3, "turn": [0, 360, 0])",
        R"("count": 3, "move": [1e300, 0, 0])", R"("count": 3, "scale": [0, 1, 1])",
        R"("count": 3, "scale": [-1, 1, 1])", R"("count": 3, "factor": 2, "scale": [1, 1, 1])",
        R"("count": 100, "factor": 1000000)", R"("count": 100000, "factor": 0.5)",
        R"("count": 3, "move": [1, 0, 0], "into": "")", R"("count": 3, "move": [1, 0, 0], "how": "twin")",
        R"("count": 3, "move": [1, 0, 0], "pivot": [1e300, 0, 0])", R"("move": [1, 0, 0])"}) {
    const std::string command = std::string(R"({"op": "repeat", "object": "a", )") + said + "}";
    EXPECT_EQ(refusal(runner, command).find("repeat: "), 0U) << said;
  }
  // Together with all that is below.
  performed(runner, R"({"op": "create", "shape": "box", "name": "b", "parent": "a"})");
  EXPECT_EQ(refusal(runner, R"({"op": "repeat", "object": "a", "count": 50001, "move": [1, 0, 0]})"),
            "repeat: 50001 copies of 2 objects each are too many; ask for 50000 at most");
}

}  // namespace
}  // namespace icome::interaction
