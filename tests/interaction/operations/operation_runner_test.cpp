#include "interaction/operations/operation_runner.h"

#include <gtest/gtest.h>

#include <set>

#include "interaction/command_samples.h"

namespace icome::interaction {
namespace {

TEST(OperationRunner, PerformsUndoesAndRedoes) {
  OperationRunner runner({});
  const std::uint64_t empty = hash(runner.world());
  const auto made = performed(runner, R"({"op": "create", "shape": "box", "name": "seat"})");
  ASSERT_EQ(made.objects.size(), 1U);
  EXPECT_EQ(runner.world().find(made.objects[0])->name, "seat");
  EXPECT_EQ(runner.history().undo_name(), "Create");
  const std::uint64_t with_seat = hash(runner.world());
  performed(runner, R"({"op": "delete", "objects": "seat"})");
  performed(runner, R"({"op": "undo"})");
  EXPECT_EQ(hash(runner.world()), with_seat);
  performed(runner, R"({"op": "undo"})");
  EXPECT_EQ(hash(runner.world()), empty);
  EXPECT_EQ(refusal(runner, R"({"op": "undo"})"), "undo: There is nothing to undo.");
  performed(runner, R"({"op": "redo"})");
  EXPECT_EQ(hash(runner.world()), with_seat);
}

TEST(OperationRunner, RefusesWhatIsNoOperation) {
  OperationRunner runner({});
  for (const char* command : {"3", "[]", "{}", R"({"op": 3})", R"({"shape": "box"})"})
    EXPECT_NE(refusal(runner, command).find("this is no operation"), std::string::npos) << command;
  EXPECT_EQ(refusal(runner, R"({"op": "creat"})"), "there is no operation 'creat'; did you mean 'create'?");
  EXPECT_EQ(refusal(runner, R"({"op": "undo", "steps": 2})"), "undo takes no parameters");
  EXPECT_EQ(refusal(runner, R"({"op": "delete"})"), "delete: 'objects' is missing: what goes");
  EXPECT_FALSE(runner.history().can_undo());
}

TEST(OperationRunner, GuessesNoNameThatHasNothingOfWhatWasSaid) {
  OperationRunner runner({});
  for (const char* name : {"a", "b", "ab"})
    performed(runner, json_from_value(Value::Fields{{"op", "create"}, {"shape", "box"}, {"name", name}}));
  EXPECT_EQ(refusal(runner, R"({"op": "delete", "objects": "x"})"),
            "delete: there is no object named 'x'; there are a, ab, b");
  EXPECT_EQ(refusal(runner, R"({"op": "delete", "objects": "ax"})"),
            "delete: there is no object named 'ax'; did you mean 'a'?");
}

TEST(OperationRunner, FindsEachOfManyObjects) {
  OperationRunner runner({});
  for (const char* command : {R"({"op": "create", "shape": "group", "name": "table"})",
                              R"({"op": "create", "shape": "box", "name": "leg", "parent": "table"})",
                              R"({"op": "create", "shape": "box", "name": "leg"})",
                              R"({"op": "create", "shape": "box", "name": "top"})"})
    performed(runner, command);
  const auto done =
      performed(runner, R"({"op": "move", "objects": ["top", "table/leg", "#7", "top"], "by": [1, 0, 0]})");
  EXPECT_EQ(done.objects.size(), 2U) << "each once; top is number 7";
  const auto twice = refusal(runner, R"({"op": "move", "objects": ["top", "leg"], "by": [1, 0, 0]})");
  EXPECT_NE(twice.find("there are 2 objects named 'leg': 'table/leg' (#3), 'leg' (#5)"), std::string::npos);
  EXPECT_NE(refusal(runner, R"({"op": "move", "objects": ["top", "lag"], "by": [1, 0, 0]})"), "");
  EXPECT_NE(refusal(runner, R"({"op": "move", "objects": ["top", 4], "by": [1, 0, 0]})"), "");
}

TEST(OperationRunner, GoesOnWithTheNumbersOfTheDesign) {
  OperationRunner first({});
  performed(first, R"({"op": "create", "shape": "box", "name": "a"})");
  OperationRunner second(first.world());
  performed(second, R"({"op": "create", "shape": "box", "name": "b"})");
  EXPECT_EQ(second.world().objects().size(), 2U);
}

/// What is checked of every parameter, also of those in records.
void check_parameter(const Parameter& parameter, const std::string& of) {
  const std::string where = of + "." + parameter.name;
  EXPECT_FALSE(parameter.name.empty()) << where;
  EXPECT_FALSE(parameter.meaning.empty()) << where;
  EXPECT_NE(parameter.meaning.back(), '.') << where << ": a phrase, no sentence";
  EXPECT_EQ(parameter.kind == ParameterKind::Choice, !parameter.choices.empty()) << where;
  EXPECT_EQ(parameter.kind == ParameterKind::Records, !parameter.fields.empty()) << where;
  EXPECT_FALSE(parameter.required && !parameter.fallback.is_null()) << where;
  if (parameter.kind == ParameterKind::Counts) {
    EXPECT_GE(parameter.least, 0.0) << where;
  }
  if (!parameter.fallback.is_null()) {
    // Whatever is fallen back to could have been said.
    Parameter alone = parameter;
    alone.only_for.clear();
    const std::vector<Parameter> only = {alone};
    const auto good = Arguments::check(only, {{parameter.name, parameter.fallback}}, {});
    EXPECT_TRUE(good) << where << ": " << good.error().message;
  }
  for (const Parameter& inner : parameter.fields) check_parameter(inner, where);
}

TEST(Operations, AreDescribedWhole) {
  std::set<std::string> names;
  for (const Operation& operation : operations()) {
    EXPECT_TRUE(names.insert(operation.name).second) << operation.name << " is there twice";
    EXPECT_FALSE(operation.title.empty()) << operation.name;
    EXPECT_FALSE(operation.group.empty()) << operation.name;
    EXPECT_EQ(operation.summary.empty() ? ' ' : operation.summary.back(), '.') << operation.name;
    std::set<std::string> parameters;
    for (const Parameter& parameter : operation.parameters) {
      EXPECT_TRUE(parameters.insert(parameter.name).second) << operation.name << "." << parameter.name;
      EXPECT_NE(parameter.name, "op") << operation.name;
      check_parameter(parameter, operation.name);
      for (const std::string& choice : parameter.only_for) {
        const auto& choices = operation.parameters.front().choices;
        EXPECT_TRUE(std::ranges::find(choices, choice) != choices.end())
            << operation.name << "." << parameter.name << ": " << choice;
      }
    }
    EXPECT_EQ(help_of(operation).find(operation.name), 0U);
    EXPECT_EQ(find_operation(operation.name).value(), &operation);
  }
}

}  // namespace
}  // namespace icome::interaction
