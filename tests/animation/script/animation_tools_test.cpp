#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

#include "animation/files/project_text.h"
#include "animation/script/animation_tool.h"
#include "base/random.h"

namespace icome::animation {
namespace {

using interaction::Value;

/// A disk with pictures of 100 x 60 px, one that is larger, and a folder of three.
ProjectDisk small_disk() {
  return {[](const std::string& file) -> base::Result<Vector2> {
            if (file == "torn/2.png") return base::fail("torn/2.png: is torn");
            if (file == "gone.png") return base::fail("gone.png: no such file");
            return file == "big.png" ? Vector2(400, 300) : Vector2(100, 60);
          },
          [](const std::string& folder) -> base::Result<std::vector<std::string>> {
            if (folder == "empty") return std::vector<std::string>();
            return std::vector<std::string>{folder + "/1.png", folder + "/2.png", folder + "/10.png"};
          },
          [](const Sound& sound) -> base::Result<void> {
            if (sound.file == "gone.wav") return base::fail("gone.wav: no such file");
            return {};
          }};
}

class AnimationToolsTest : public ::testing::Test {
 protected:
  std::string note(const std::string& line) {
    const auto done = runner_.perform(*interaction::value_from_json(line));
    EXPECT_TRUE(done) << line << ": " << done.error().message;
    return done.value_or("");
  }
  std::string refusal(const std::string& line) {
    const Project before = project();
    const auto done = runner_.perform(*interaction::value_from_json(line));
    EXPECT_EQ(project(), before);
    return done ? "" : done.error().message;
  }
  const Project& project() const { return runner_.project(); }
  CellState state(const char* cell, double frame) const { return state_at(*project().find(cell), frame); }
  const Track& track(const char* cell, Channel channel) const {
    return project().find(cell)->tracks[std::size_t(channel)];
  }

  AnimationRunner runner_{Project(), small_disk()};
};

TEST_F(AnimationToolsTest, MakeACellInTheMiddleOfAStage) {
  note(R"({"op": "stage", "width": 640, "height": 480, "rate": 12, "length": 48, "background": "#204060"})");
  note(R"({"op": "add-cell", "pictures": "art/boat.png"})");
  EXPECT_EQ(project().camera.rest.place, Vector2(320, 240));
  ASSERT_EQ(project().layers.size(), 1U);
  EXPECT_EQ(project().layers[0].name, "layer 1");
  EXPECT_EQ(state("boat", 0).place, Vector2(320, 240));
  EXPECT_EQ(project().find("boat")->pivot, Vector2(50, 30));
  note(R"({"op": "add-cell", "pictures": ["art/boat.png"]})");
  EXPECT_NE(project().find("boat 2"), nullptr);
}

TEST_F(AnimationToolsTest, SetKeysByName) {
  note(R"({"op": "add-cell", "pictures": "boat.png"})");
  note(R"({"op": "key", "cell": "boat", "frame": 0, "x": 100, "angle": 0})");
  note(R"({"op": "key", "cell": "boat", "frame": 10, "x": 200, "angle": 90, "ease": "eased"})");
  EXPECT_DOUBLE_EQ(state("boat", 5).place.x(), 150);
  EXPECT_NEAR(state("boat", 10).angle, 1.5707963267948966, 1e-12);
  note(R"({"op": "key", "cell": "boat", "frame": 5})");
  EXPECT_EQ(track("boat", Channel::Opacity), (Track{{5, 1}}));
  note(R"({"op": "ease", "cells": "boat", "ease": "hold", "channels": "x"})");
  EXPECT_DOUBLE_EQ(state("boat", 9.5).place.x(), 150);
  note(R"({"op": "unkey", "cells": "boat", "from": 5, "to": 5})");
  EXPECT_TRUE(track("boat", Channel::Opacity).empty());
  EXPECT_EQ(refusal(R"({"op": "unkey", "cells": "boat", "from": 5, "to": 6})"),
            "unkey: there is no key in these frames");
  note(R"({"op": "key", "cell": "camera", "frame": 0})");
  EXPECT_TRUE(project().camera.tracks[std::size_t(Channel::Opacity)].empty());
}

TEST_F(AnimationToolsTest, ImportAFolderAsOneCellOrAsMany) {
  note(R"({"op": "import", "folder": "walk", "each": 2, "frame": 4})");
  EXPECT_EQ(project().find("walk")->pictures,
            (std::vector<std::string>{"walk/1.png", "walk/2.png", "walk/10.png"}));
  EXPECT_EQ(track("walk", Channel::Picture),
            (Track{{4, 0, Ease::Hold}, {6, 1, Ease::Hold}, {8, 2, Ease::Hold}}));
  note(R"({"op": "import", "folder": "parts", "as": "cells"})");
  EXPECT_EQ(project().cell_count(), 4U);
  EXPECT_EQ(refusal(R"({"op": "import", "folder": "empty"})"),
            "import: empty: there is no picture (.png, .jpg, .svg)");
  EXPECT_NE(refusal(R"({"op": "import", "folder": "torn"})").find("torn/2.png"), std::string::npos);
  EXPECT_EQ(note(R"({"op": "import", "folder": "torn", "skip": true})"), "left out: torn/2.png: is torn");
  EXPECT_EQ(project().find("torn")->pictures, (std::vector<std::string>{"torn/1.png", "torn/10.png"}));
}

TEST_F(AnimationToolsTest, SwapPictures) {
  note(R"({"op": "add-cell", "name": "mouth", "pictures": ["a.png", "o.png", "m.png"]})");
  note(R"({"op": "expose", "cell": "mouth", "frame": 3, "pictures": [2, 0, -1], "each": 2})");
  const std::vector<int> shown = {2, 2, 2, 2, 2, 0, 0, -1, -1};
  for (std::size_t frame = 0; frame < shown.size(); ++frame)
    EXPECT_EQ(state("mouth", double(frame)).picture, shown[frame]) << frame;
  note(R"({"op": "delete-picture", "cell": "mouth", "number": 0})");
  EXPECT_EQ(state("mouth", 3).picture, 1);
  EXPECT_EQ(state("mouth", 5).picture, -1);
  EXPECT_EQ(refusal(R"({"op": "key", "cell": "mouth", "frame": 0, "picture": 2})"),
            "key: at frame 0, a picture is a whole number from 0 to 1 (-1: none), not 2");
  EXPECT_NE(note(R"({"op": "add-picture", "cell": "mouth", "pictures": "big.png"})"), "");
  EXPECT_EQ(refusal(R"({"op": "replace-picture", "cell": "mouth", "number": 0, "picture": "gone.png"})"),
            "replace-picture: gone.png: no such file");
}

TEST_F(AnimationToolsTest, MoveAPivotAndLeaveThePictureWhereItIs) {
  note(R"({"op": "add-cell", "name": "arm", "pictures": "arm.png", "scale": 2, "angle": 30})");
  note(R"({"op": "key", "cell": "arm", "frame": 0, "x": 100, "y": 50, "angle": 20})");
  note(R"({"op": "key", "cell": "arm", "frame": 8, "angle": 200})");
  const Project before = project();
  note(R"({"op": "change-cell", "cell": "arm", "pivot": [10, 55]})");
  for (const double frame : {0.0, 8.0, 20.0}) {
    for (const Vector2& corner : {Vector2(0, 0), Vector2(100, 60)}) {
      const Cell &old = *before.find("arm"), &now = *project().find("arm");
      EXPECT_LT(
          (on_stage(old, state_at(old, frame), corner) - on_stage(now, state_at(now, frame), corner)).norm(),
          1e-9);
    }
  }
}

TEST_F(AnimationToolsTest, MoveCopyAndStretchKeys) {
  note(R"({"op": "add-cell", "name": "a", "pictures": "a.png"})");
  for (const int frame : {0, 4, 8})
    note(fmt::format(R"({{"op": "key", "cell": "a", "frame": {}, "x": {}}})", frame, 10 * frame));
  note(R"({"op": "move-keys", "cells": "a", "from": 4, "to": 4, "by": 4})");
  EXPECT_EQ(track("a", Channel::X), (Track{{0, 0}, {8, 40}}));
  note(R"({"op": "copy-keys", "cells": "a", "from": 0, "to": 8, "at": 20})");
  EXPECT_EQ(track("a", Channel::X), (Track{{0, 0}, {8, 40}, {20, 0}, {28, 40}}));
  note(R"({"op": "stretch-keys", "cells": "a", "from": 20, "factor": 0.5})");
  EXPECT_EQ(track("a", Channel::X), (Track{{0, 0}, {8, 40}, {20, 0}, {24, 40}}));
  EXPECT_EQ(refusal(R"({"op": "move-keys", "cells": "a", "from": 8, "to": 8, "by": -9})"),
            "move-keys: the key of 'a' at frame 8 would come to frame -1");
  runner_.undo();
  EXPECT_EQ(track("a", Channel::X).back(), (Key{28, 40}));
}

TEST_F(AnimationToolsTest, PutFramesInAndTakeThemOutAgain) {
  note(R"({"op": "add-cell", "name": "a", "pictures": "a.png"})");
  for (const int frame : {0, 4, 8})
    note(fmt::format(R"({{"op": "key", "cell": "a", "frame": {}, "x": {}}})", frame, frame));
  note(R"({"op": "mark", "frame": 4, "text": "O"})");
  const Project before = project();
  note(R"({"op": "insert-frames", "frame": 3, "count": 10})");
  EXPECT_EQ(track("a", Channel::X), (Track{{0, 0}, {14, 4}, {18, 8}}));
  EXPECT_EQ(project().marks, (std::vector<Mark>{{14, "O"}}));
  EXPECT_EQ(project().stage.length, 110);
  note(R"({"op": "delete-frames", "frame": 3, "count": 10})");
  EXPECT_EQ(project(), before);
  note(R"({"op": "delete-frames", "frame": 4, "count": 2})");
  EXPECT_EQ(track("a", Channel::X), (Track{{0, 0}, {6, 8}}));
  EXPECT_TRUE(project().marks.empty());
}

TEST_F(AnimationToolsTest, JoinCellsWhereTheyLie) {
  note(R"({"op": "add-cell", "name": "body", "pictures": "a.png", "place": [100, 100], "angle": 40})");
  note(R"({"op": "add-cell", "name": "arm", "pictures": "a.png", "place": [150, 120], "scale": 0.5})");
  note(R"({"op": "join", "parent": "body", "child": "arm", "at": [130, 110], "least": -30, "greatest": 90})");
  const auto& joint = std::get<Joint>(project().constraints.at(0).what);
  for (const auto& [cell, point] : {std::pair("body", joint.on_parent), std::pair("arm", joint.on_child)})
    EXPECT_LT((on_stage(*project().find(cell), state(cell, 0), point) - Vector2(130, 110)).norm(), 1e-9);
  note(R"({"op": "chain", "cells": ["body", "arm"]})");
  note(R"({"op": "limit-distance", "one": "body", "other": "arm", "least": 5, "greatest": 70})");
  note(R"({"op": "axis", "cell": "body", "direction": 45})");
  note(R"({"op": "path", "cell": "arm", "way": [[0, 0], [100, 0]], "turns": true})");
  EXPECT_EQ(project().constraints.size(), 5U);
  note(R"({"op": "free", "cells": ["body", "arm"]})");
  EXPECT_EQ(project().constraints.size(), 2U);
  note(R"({"op": "delete-cell", "cells": ["body", "arm"]})");
  EXPECT_TRUE(project().constraints.empty());
}

TEST_F(AnimationToolsTest, DeleteALayerWithAllThatNamesItsCells) {
  note(R"({"op": "add-layer", "name": "front"})");
  note(R"({"op": "add-cell", "name": "a", "pictures": "a.png"})");
  note(R"({"op": "add-cell", "name": "b", "pictures": "a.png"})");
  note(R"({"op": "join", "parent": "a", "child": "b"})");
  note(R"({"op": "chain", "cells": ["a", "b"]})");
  note(R"({"op": "map", "triangle": "t1", "cell": "a"})");
  note(R"({"op": "map", "triangle": "t2", "mode": "nearest"})");
  EXPECT_EQ(refusal(R"({"op": "map", "triangle": "t3"})"),
            "map: 'cell' is missing: the cell that the triangle moves");
  note(R"({"op": "delete-layer", "layer": "front"})");
  EXPECT_EQ(project().cell_count(), 0U);
  EXPECT_EQ(project().mappings.size(), 1U);
  EXPECT_TRUE(runner_.undo());
  EXPECT_EQ(project().mappings.size(), 2U);
}

TEST_F(AnimationToolsTest, LeaveLockedLayersAlone) {
  note(R"({"op": "add-layer", "name": "front"})");
  note(R"({"op": "add-cell", "name": "a", "pictures": "a.png"})");
  note(R"({"op": "change-layer", "layer": "front", "locked": true})");
  EXPECT_EQ(refusal(R"({"op": "key", "cell": "a", "frame": 0, "x": 1})"),
            "key: 'a' lies on layer 'front', which is locked");
  note(R"({"op": "add-cell", "name": "b", "pictures": "a.png"})");
  EXPECT_EQ(project().layer_of(project().find("b")->id)->name, "layer 2");
}

TEST_F(AnimationToolsTest, TellWhatIsWrong) {
  EXPECT_EQ(refusal(R"({"op": "kee"})"), "there is no tool \"kee\"; did you mean 'key'?");
  EXPECT_EQ(refusal(R"([1])"), R"(a line is an object with a field "op", such as {"op": "key", ...})");
  EXPECT_EQ(refusal(R"({"op": "key", "cell": "boot", "frame": 1})"),
            "key: there is no cell 'boot'; there are camera");
  EXPECT_EQ(refusal(R"({"op": "undo"})"), "undo: there is nothing to undo");
  EXPECT_EQ(refusal(R"({"op": "add-cell", "pictures": "gone.png"})"), "add-cell: gone.png: no such file");
  EXPECT_EQ(refusal(R"({"op": "unmark", "frame": 3})"), "unmark: there is no mark at frame 3");
}

/// Random commands of all tools: each does all or nothing, leaves a project that its own text reads back, and
/// is taken back by one undo.
TEST_F(AnimationToolsTest, WithstandRandomCommands) {
  base::Random random(11);
  const std::vector<std::string> names = {"a", "b", "c", "camera", "layer 1", "front"};
  std::set<std::string> done_tools;
  const auto value_for = [&](const interaction::Parameter& parameter) -> Value {
    using interaction::ParameterKind;
    const auto number = [&] {
      return std::clamp(double(random.index(40)) - 8, parameter.least, parameter.most);
    };
    switch (parameter.kind) {
      case ParameterKind::Flag:
        return random.index(2) == 0;
      case ParameterKind::Text:
        return names[random.index(names.size())];
      case ParameterKind::Texts:
        if (parameter.name == "channels") return Value::List{"x", "angle", "picture"};
        return Value::List{names[random.index(3)], names[random.index(3)]};
      case ParameterKind::Choice:
        return parameter.choices[random.index(parameter.choices.size())];
      case ParameterKind::Colour:
        return "red";
      case ParameterKind::Points:
        return Value::List{Value::List{1, 2}, Value::List{30, 40}};
      case ParameterKind::Numbers:
        return Value::List{number(), number()};
      case ParameterKind::Counts:
        return Value::List{0, 1, -1};
      default:
        return number();
    }
  };
  const std::vector<std::string> start = {R"({"op": "add-cell", "name": "a", "pictures": "a.png"})",
                                          R"({"op": "add-cell", "name": "b", "pictures": "a.png"})",
                                          R"({"op": "join", "parent": "a", "child": "b"})"};
  for (int i = 0; i < 6000; ++i) {
    for (const std::string& line : start)
      if (i % 25 == 0) (void)runner_.perform(*interaction::value_from_json(line));
    const AnimationTool& tool = animation_tools()[random.index(animation_tools().size())];
    Value::Fields fields = {{"op", tool.about.name}};
    for (const interaction::Parameter& parameter : tool.about.parameters)
      if (parameter.required || random.index(3) == 0)
        fields.emplace_back(parameter.name, value_for(parameter));
    const Project before = project();
    if (!runner_.perform(Value(fields))) {
      ASSERT_EQ(project(), before) << interaction::json_from_value(Value(fields));
      continue;
    }
    done_tools.insert(tool.about.name);
    if (i % 20 != 0 || tool.plan == nullptr || project() == before) continue;
    auto read = read_project(project_text(project()), "a");
    ASSERT_TRUE(read) << read.error().message;
    Project after = project();
    ASSERT_TRUE(runner_.undo());
    after.next_id = project().next_id;
    ASSERT_TRUE(runner_.redo());
  }
  for (const AnimationTool& tool : animation_tools())
    EXPECT_TRUE(done_tools.contains(tool.about.name)) << tool.about.name;
}

}  // namespace
}  // namespace icome::animation
