#include "interaction/operations/placement.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "interaction/shape_samples.h"

namespace icome::interaction {
namespace {

using base::Matrix3;

constexpr double kRadiansPerDegree = 0.017453292519943295;

/// A world with objects of these names, side by side.
world::World world_with_objects(const std::vector<std::string>& names) {
  world::World world;
  world::IdSource ids;
  for (const std::string& name : names) {
    const auto done = apply(world, create_last(world, ids.next<world::ObjectId>(), {.name = name}));
    EXPECT_TRUE(done);
  }
  return world;
}

TEST(Placement, QuarterTurnsAreExact) {
  Matrix3 quarter;
  quarter << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  EXPECT_EQ(turn_of({0, 90, 0}), quarter);
  EXPECT_EQ(turn_of({0, -90, 0}), quarter.transpose());
  EXPECT_EQ(turn_of({0, 180, 0}), quarter * quarter);
  EXPECT_EQ(turn_of({0, 450, 0}), quarter);
  EXPECT_EQ(turn_of({0, 0, 0}), Matrix3::Identity());
  EXPECT_EQ(turn_of({0, 0, 360}), Matrix3::Identity());
}

TEST(Placement, TurnsAboutAnyAxisAsEigenDoes) {
  base::Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vector3 axis = random.direction();
    const double degrees = random.uniform(0.0, 720.0);
    const Matrix3 expected = Eigen::AngleAxisd(degrees * kRadiansPerDegree, axis).toRotationMatrix();
    EXPECT_LT((turn_of(degrees * axis) - expected).norm(), 1e-13) << degrees << " about " << axis.transpose();
  }
}

TEST(Placement, ScalesThenTurnsThenMoves) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "group", "name": "room", "at": [5, 0, 0]})");
  performed(runner, R"({"op": "create", "shape": "box", "name": "seat", "parent": "room",
                        "at": [1, 2, 3], "turn": [0, 0, 90], "scale": [2, 3, 4]})");
  const world::PhysicalObject& seat = object_named(runner, "room/seat");
  // (1, 1, 1) is scaled to (2, 3, 4), turned to (-3, 2, 4), and moved.
  EXPECT_EQ(Vector3(seat.parent_from_object * Vector3(1, 1, 1)), Vector3(-2, 4, 7));
  performed(runner, R"({"op": "create", "shape": "box", "name": "back", "factor": 2.5})");
  EXPECT_EQ(object_named(runner, "back").parent_from_object.linear(), 2.5 * Matrix3::Identity());
}

TEST(Placement, GivesMaterialsByNameAndByNumber) {
  world::World world;
  for (const auto& [number, name] : {std::pair(7U, "wood"), {8U, "skin"}, {9U, "skin"}}) {
    const auto done = apply(world, world::CreateMaterial{world::MaterialId{number}, {.name = name}});
    ASSERT_TRUE(done);
  }
  OperationRunner runner(world);
  performed(runner, R"({"op": "create", "shape": "box", "name": "a", "material": "wood"})");
  performed(runner, R"({"op": "create", "shape": "box", "name": "b", "material": "#9"})");
  EXPECT_EQ(object_named(runner, "a").material.value, 7U);
  EXPECT_EQ(object_named(runner, "b").material.value, 9U);
  EXPECT_EQ(refusal(runner, R"({"op": "create", "shape": "box", "material": "skin"})"),
            "create: there are 2 materials named 'skin'; name one by its number, such as '#8'");
  EXPECT_EQ(refusal(runner, R"({"op": "create", "shape": "box", "material": "wod"})"),
            "create: there is no material named 'wod'; did you mean 'wood'?");
}

TEST(Placement, CountsNamesOn) {
  const world::World world = world_with_objects({"stair", "stair 3", "leg 9", "box 02", "7"});
  EXPECT_EQ(unused_name(world, "seat"), "seat");
  EXPECT_EQ(unused_names(world, "stair", 3), (std::vector<std::string>{"stair 2", "stair 4", "stair 5"}));
  EXPECT_EQ(unused_names(world, "leg 9", 2), (std::vector<std::string>{"leg 10", "leg 11"}));
  EXPECT_EQ(unused_names(world, "box", 2), (std::vector<std::string>{"box", "box 2"}));
  EXPECT_EQ(unused_name(world, "box 02"), "box 02 2");
  EXPECT_EQ(unused_name(world, "7"), "7 2");
  EXPECT_TRUE(unused_names(world, "stair", 0).empty());
  EXPECT_EQ(unused_names(world, "stair 3", 2), (std::vector<std::string>{"stair 4", "stair 5"}));
}

TEST(Placement, CountsPastNumbersThatAreNoCount) {
  const world::World world =
      world_with_objects({"a 999999999", "a 1000000000", "a 99999999999999999999999", "a 2 b", "a", "a 02"});
  EXPECT_EQ(unused_name(world, "a 999999999"), "a 1000000001");
  EXPECT_EQ(unused_names(world, "a", 2), (std::vector<std::string>{"a 2", "a 3"}));
}

TEST(Placement, TakesMaterialsOfTheLibraryAndMakesThemOnce) {
  OperationRunner runner({});
  const std::uint64_t empty = hash(runner.world());
  performed(runner, R"({"op": "create", "shape": "box", "name": "a", "material": "wood"})");
  performed(runner, R"({"op": "extrude", "points": [[0, 0], [1, 0], [0, 1]], "steps": [{"move": [0, 0, 1]}],
                        "name": "b", "material": "wood"})");
  ASSERT_EQ(runner.world().materials().size(), 1U);
  EXPECT_EQ(runner.world().find(object_named(runner, "a").material)->touch.texture, "grooves");
  EXPECT_EQ(object_named(runner, "a").material, object_named(runner, "b").material);
  EXPECT_NE(refusal(runner, R"({"op": "create", "shape": "box", "name": "", "material": "ice"})"), "");
  performed(runner, R"({"op": "undo"})");
  performed(runner, R"({"op": "undo"})");
  EXPECT_EQ(hash(runner.world()), empty);
}

TEST(Placement, RefusesWhatIsNoPlace) {
  OperationRunner runner({});
  performed(runner, R"({"op": "create", "shape": "box", "name": "seat"})");
  for (const char* said :
       {R"("at": [1e300, 0, 0])", R"("at": [0, 0])", R"("at": "here")", R"("turn": [0, 1e300, 0])",
        R"("turn": 90)", R"("scale": [0, 1, 1])", R"("scale": [-1, 1, 1])", R"("scale": 2)", R"("factor": 0)",
        R"("factor": 1e300)", R"("factor": 2, "scale": [1, 1, 1])", R"("name": "")", R"("name": "a\nb")",
        R"("name": 3)", R"("parent": "nobody")", R"("parent": 3)", R"("material": "gold")",
        R"("size": [1, 1, 1], "colour": "red")"}) {
    const std::string command = std::string(R"({"op": "create", "shape": "box", )") + said + "}";
    EXPECT_EQ(refusal(runner, command).find("create: "), 0U) << command;
  }
  const std::string endless(1001, 'a');
  EXPECT_NE(refusal(runner, R"({"op": "create", "shape": "box", "name": ")" + endless + "\"}").find("1001"),
            std::string::npos);
}

}  // namespace
}  // namespace icome::interaction
