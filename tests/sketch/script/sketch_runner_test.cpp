#include <gtest/gtest.h>

#include <random>

#include "sketch/script/sketch_tool.h"

namespace icome::sketch {
namespace {

using interaction::Parameter;
using interaction::ParameterKind;
using interaction::Value;

#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
constexpr int kRandomEdits = 600;
#else
constexpr int kRandomEdits = 10'000;
#endif

std::string said(SketchRunner& runner, const char* line) {
  const auto done = runner.perform(*interaction::value_from_json(line));
  return done ? *done : "error: " + done.error().message;
}

/// Random values for the parameters of a tool; mostly of a kind that it takes.
class RandomCommands {
 public:
  explicit RandomCommands(unsigned seed) : random_(seed) {}

  Value next(std::uint64_t next_id) {
    const auto& tools = sketch_tools();
    const auto& about = tools[below(tools.size())].about;
    Value::Fields fields = {{"op", about.name}};
    const bool by_number = below(2) == 0;
    for (const Parameter& parameter : about.parameters) {
      if (parameter.name == (by_number ? "at" : "stroke")) continue;
      const bool given = parameter.required || parameter.name == "stroke" || below(2) == 0;
      if (given) fields.emplace_back(parameter.name, value(parameter, next_id));
    }
    return fields;
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }
  Value coordinate() { return std::uniform_real_distribution<double>(-20.0, 200.0)(random_); }

  Value value(const Parameter& parameter, std::uint64_t next_id) {
    switch (parameter.kind) {
      case ParameterKind::Flag:
        return below(2) == 0;
      case ParameterKind::Count:
        return 1 + int(below(next_id));
      case ParameterKind::Counts:
        return Value::List{1 + int(below(next_id)), 1 + int(below(next_id))};
      case ParameterKind::Numbers:
        return Value::List{coordinate(), coordinate()};
      case ParameterKind::Points: {
        Value::List way;
        for (std::size_t i = 0; i < 2 + below(5); ++i)
          way.emplace_back(Value::List{coordinate(), coordinate()});
        return way;
      }
      case ParameterKind::Choice:
        return parameter.choices[below(parameter.choices.size())];
      case ParameterKind::Colour:
        return "#3050a0";
      case ParameterKind::Text:
        return below(3) == 0 ? "other" : "Layer 1";
      default:
        return 0.2 + 2.0 * double(below(10));
    }
  }

  std::mt19937 random_;
};

// Undo is an edit's inverse and nothing else, so any sequence must lead back, and forth again.
TEST(SketchRunner, UndoOfRandomEditsGivesTheFirstDrawingAndRedoTheLast) {
  SketchRunner runner{Drawing()};
  said(runner, R"({"op": "add-layer"})");
  said(runner, R"({"op": "undo"})");
  const std::uint64_t first = hash_of(runner.drawing());
  RandomCommands commands(1);
  std::uint64_t next_id = runner.drawing().next_id;
  int good = 0;
  for (int i = 0; i < kRandomEdits; ++i) {
    if (runner.drawing().stroke_count() > 40) {  // copies of copies would fill the memory
      said(runner, R"({"op": "select-all"})");
      said(runner, R"({"op": "delete"})");
    }
    const std::uint64_t before = hash_of(runner.drawing());
    const bool done = bool(runner.perform(commands.next(std::min<std::uint64_t>(next_id, 60))));
    good += done ? 1 : 0;
    ASSERT_TRUE(done || hash_of(runner.drawing()) == before) << i;
    ASSERT_GE(runner.drawing().next_id, next_id);  // ids are never given twice
    next_id = runner.drawing().next_id;
  }
  EXPECT_GT(good, kRandomEdits / 4);
  while (said(runner, R"({"op": "redo"})").empty()) {
  }
  const std::uint64_t last = hash_of(runner.drawing());
  while (said(runner, R"({"op": "undo"})").empty()) {
  }
  EXPECT_EQ(hash_of(runner.drawing()), first);
  while (said(runner, R"({"op": "redo"})").empty()) {
  }
  EXPECT_EQ(hash_of(runner.drawing()), last);
}

TEST(SketchRunner, SaysWhatIsWrong) {
  SketchRunner runner{Drawing()};
  EXPECT_EQ(said(runner, R"({"op": "draw", "way": [[0, 0], [50, 0]]})"), "stroke 2");
  const auto complains = [&](const char* line, const char* of) {
    EXPECT_NE(said(runner, line).find(of), std::string::npos) << said(runner, line);
  };
  complains(R"({"op": "eraze"})", "'erase'");
  complains(R"({"op": "erase"})", "way");
  complains(R"({"op": "erase", "way": [[1, 1]], "radios": 3})", "radios");
  complains(R"({"op": "erase", "way": [[1, 1]], "radius": -3})", "radius");
  complains(R"({"op": "move", "by": [1, 1]})", "nothing is selected");
  complains(R"({"op": "split"})", "at");
  complains(R"({"op": "draw", "way": [[0, 0], [200000, 0]], "error": 0.001})",
            "too long for an error of 0.001 mm");
  complains(R"({"op": "split", "stroke": 2})", "error");  // it crashed: a stroke alone tells no place
  said(runner, R"({"op": "change-layer", "layer": "Layer 1", "locked": true})");
  complains(R"({"op": "colour", "stroke": 2, "colour": "red"})", "locked");
}

// The selection names control points by number, and closing a stroke adds some.
TEST(SketchRunner, SelectingAgainAlsoTakesStrokesThatChangedSince) {
  SketchRunner runner{Drawing()};
  said(runner, R"({"op": "draw", "way": [[0, 0], [50, 0], [50, 50]]})");
  said(runner, R"({"op": "select-all"})");
  said(runner, R"({"op": "close", "within": 1})");
  said(runner, R"({"op": "select-all", "add": true})");
  EXPECT_EQ(said(runner, R"({"op": "move", "by": [10, 0]})"), "");
  EXPECT_NEAR(runner.drawing().layers[0].strokes[0]->curve.at(0.0).x(), 0.01, 1e-12);
}

}  // namespace
}  // namespace icome::sketch
