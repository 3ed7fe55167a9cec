#include "interaction/operations/arguments.h"

#include <gtest/gtest.h>

#include "interaction/command_samples.h"
#include "world/sample_world.h"

namespace icome::interaction {
namespace {

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> kAll = {
      {.name = "shape", .kind = ParameterKind::Choice, .fallback = "box", .choices = {"box", "ball"}},
      {.name = "size", .kind = ParameterKind::Vector, .least = 0.0, .only_for = {"box"}},
      {.name = "radius",
       .kind = ParameterKind::Number,
       .required = true,
       .least = 0.0,
       .most = 2.0,
       .only_for = {"ball"}},
      {.name = "count", .kind = ParameterKind::Count, .fallback = 3, .least = 1},
      {.name = "name", .kind = ParameterKind::Text},
      {.name = "cells", .kind = ParameterKind::Texts},
      {.name = "open", .kind = ParameterKind::Flag, .fallback = false},
      {.name = "vertices", .kind = ParameterKind::Counts, .least = 0},
      {.name = "weights", .kind = ParameterKind::Numbers},
      {.name = "outline", .kind = ParameterKind::Points, .components = 2},
      {.name = "path", .kind = ParameterKind::Points},
      {.name = "colour", .kind = ParameterKind::Colour},
      {.name = "object", .kind = ParameterKind::Object},
      {.name = "objects", .kind = ParameterKind::Objects},
      {.name = "steps", .kind = ParameterKind::Records, .fields = {{.name = "angle", .required = true}}}};
  return kAll;
}

/// "#7", as people name the object of that number.
std::string numbered_name(world::ObjectId id) { return std::string(1, '#').append(std::to_string(id.value)); }

class ArgumentsTest : public ::testing::Test {
 protected:
  std::string error(std::string_view text) {
    const Value said = json(text);
    const auto arguments = Arguments::check(parameters(), *said.fields(), world_);
    return arguments ? "" : arguments.error().message;
  }

  world::World world_;
  world::IdSource ids_;
};

TEST_F(ArgumentsTest, TakeTextsAloneOrInAList) {
  const Value several = json(R"({"cells": ["arm", "hand"]})"), one = json(R"({"cells": "arm"})");
  EXPECT_EQ(Arguments::check(parameters(), *several.fields(), world_)->texts("cells"),
            (std::vector<std::string>{"arm", "hand"}));
  EXPECT_EQ(Arguments::check(parameters(), *one.fields(), world_)->texts("cells"),
            std::vector<std::string>{"arm"});
  EXPECT_EQ(error(R"({"cells": []})"), "'cells' must be a text, or a list of texts");
  EXPECT_EQ(error(R"({"cells": ["arm", 3]})"), "'cells' must be a text, or a list of texts");
}

TEST_F(ArgumentsTest, AreWhatIsSaidOrWhatThereIsToFallBackTo) {
  const world::ObjectId leg = world::add_object(world_, ids_, "leg", world::box(1.0));
  const Value said = json(R"({"size": [1, 2, 3], "name": "n", "vertices": [4, 5e9], "weights": [0.5],
      "outline": [[1, 2], [3, 4]], "path": [[1, 2, 3]], "colour": "red", "object": "leg", "objects": ["leg", "#2", "leg"],
      "steps": [{"angle": 7}, {"angle": 8}]})");
  const auto arguments = Arguments::check(parameters(), *said.fields(), world_);
  ASSERT_TRUE(arguments) << arguments.error().message;
  EXPECT_EQ(arguments->text("shape"), "box");
  EXPECT_EQ(arguments->vector("size"), Vector3(1, 2, 3));
  EXPECT_FALSE(arguments->has("radius"));
  EXPECT_EQ(arguments->count("count"), 3);
  EXPECT_EQ(arguments->text("name"), "n");
  EXPECT_FALSE(arguments->flag("open"));
  EXPECT_EQ(arguments->counts("vertices"), (std::vector<std::uint32_t>{4, 0xffffffff})) << "names no vertex";
  EXPECT_EQ(arguments->numbers("weights"), std::vector{0.5});
  EXPECT_EQ(arguments->points2("outline"), (std::vector<Vector2>{{1, 2}, {3, 4}}));
  EXPECT_EQ(arguments->points3("path"), (std::vector<Vector3>{{1, 2, 3}}));
  EXPECT_EQ(arguments->colour("colour"), (world::Colour{1, 0, 0}));
  EXPECT_EQ(arguments->object("object"), leg);
  EXPECT_EQ(arguments->objects("objects"), std::vector{leg}) << "each once";
  const auto steps = arguments->records("steps");
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_EQ(steps[1].number("angle"), 8.0);
}

TEST_F(ArgumentsTest, OfAnotherKindAreRefused) {
  EXPECT_EQ(error(R"({"shape": "cube"})"), "'shape' must be one of box, ball");
  EXPECT_EQ(error(R"({"shape": 3})"), "'shape' must be one of box, ball");
  EXPECT_EQ(error(R"({"size": [1, 2]})"), "'size' must be three numbers, such as [0, 0.1, 0]");
  EXPECT_EQ(error(R"({"size": [1, 2, "3"]})"), "'size' must be three numbers, such as [0, 0.1, 0]");
  EXPECT_EQ(error(R"({"count": 1.5})"), "'count' must be a whole number");
  EXPECT_EQ(error(R"({"count": 1e17})"), "'count' must be a whole number");
  EXPECT_EQ(error(R"({"open": 1})"), "'open' must be true or false");
  EXPECT_EQ(error(R"({"name": null})"), "'name' must be a text");
  EXPECT_EQ(error(R"({"outline": [[1, 2, 3]]})"), "'outline' must be a list of points of 2 numbers each");
  EXPECT_EQ(error(R"({"colour": "redd"})"), "there is no colour 'redd'; did you mean 'red'?");
  EXPECT_EQ(
      error(R"({"colour": [0.5, 0, 1.5]})"),
      "'colour' must be red, green and blue, each between 0 and 1, such as [1, 0.5, 0], or a text such as "
      "\"#ff8000\" or \"red\"");
  EXPECT_EQ(error(R"({"objects": []})"), "'objects' must be the name of an object, or a list of such names");
  EXPECT_EQ(error(R"({"steps": [3]})"), "'steps' must be a list of {named values}");
}

TEST_F(ArgumentsTest, OutOfRangeAreRefused) {
  EXPECT_EQ(error(R"({"size": [1, -2, 3]})"), "'size' must be 0 or more, not -2");
  EXPECT_EQ(error(R"({"count": 0})"), "'count' must be 1 or more, not 0");
  EXPECT_EQ(error(R"({"shape": "ball", "radius": 2.5})"), "'radius' must be between 0 and 2, not 2.5");
  EXPECT_EQ(error(R"({"vertices": [-1]})"), "'vertices' must be 0 or more, not -1");
}

TEST_F(ArgumentsTest, ThatNobodyKnowsOrThatAreMissingAreRefused) {
  EXPECT_EQ(error(R"({"nme": "a"})"), "there is no 'nme'; did you mean 'name'?");
  EXPECT_EQ(error(R"({"radius": 1})"), "'radius' is nothing that 'box' has; it is for ball");
  EXPECT_EQ(error(R"({"shape": "ball"})"), "'radius' is missing: ");
  EXPECT_EQ(error(R"({"steps": [{"angle": 1}, {"angel": 1}]})"),
            "'steps', number 2: there is no 'angel'; did you mean 'angle'?");
}

TEST_F(ArgumentsTest, NameObjectsThatAreThereAndAlone) {
  const auto table = world::add_object(world_, ids_, "table", nullptr);
  const auto first = world::add_object(world_, ids_, "leg", world::box(1.0), table);
  const auto chair = world::add_object(world_, ids_, "chair", nullptr);
  const auto second = world::add_object(world_, ids_, "leg", world::box(1.0), chair);
  const auto odd = world::add_object(world_, ids_, "a/b", nullptr, chair);
  EXPECT_EQ(named_object(world_, "table").value(), table);
  EXPECT_EQ(named_object(world_, "table/leg").value(), first);
  EXPECT_EQ(named_object(world_, "chair/leg").value(), second);
  EXPECT_EQ(named_object(world_, "a/b").value(), odd);
  EXPECT_EQ(named_object(world_, "chair/a/b").value(), odd);
  EXPECT_EQ(named_object(world_, numbered_name(second)).value(), second);
  EXPECT_EQ(error(R"({"object": "leg"})"),
            "there are 2 objects named 'leg': 'table/leg' (" + numbered_name(first) + "), 'chair/leg' (" +
                numbered_name(second) + "); name one by its path or its number");
  EXPECT_EQ(error(R"({"object": "tabel"})"), "there is no object named 'tabel'; did you mean 'table'?");
  for (const char* name : {"", "/", "/table", "leg/", "table/table", "#", "#x", "#0", "#999"})
    EXPECT_FALSE(named_object(world_, name)) << name;
}

}  // namespace
}  // namespace icome::interaction
