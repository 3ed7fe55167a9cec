#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>

#include "sketch/script/sketch_tool.h"

namespace icome::sketch {
namespace {

constexpr double kOneMm = 0.001;

/// A page with one layer ("Layer 1", number 1), on which lines of a script were done.
class Page {
 public:
  explicit Page(std::initializer_list<const char*> lines = {}) : runner_(empty_page()) {
    for (const char* line : lines) EXPECT_EQ(error_of(line), "") << line;
  }

  /// The error of a line; empty where it was done.
  std::string error_of(const char* line) {
    const auto done = runner_.perform(*interaction::value_from_json(line));
    if (done) note_ = *done;
    return done ? "" : done.error().message;
  }

  const std::string& note() const { return note_; }
  const Drawing& drawing() const { return runner_.drawing(); }
  const Selection& selection() const { return runner_.selection(); }
  const Stroke& stroke(std::uint64_t number) const { return *drawing().find(StrokeId{number}); }
  /// A place along a stroke, mm.
  Vector2 at(std::uint64_t number, double place) const { return stroke(number).curve.at(place) / kOneMm; }

 private:
  static Drawing empty_page() {
    Drawing drawing;
    drawing.layers.push_back({.id = drawing.next_layer_id(), .name = "Layer 1", .strokes = {}});
    return drawing;
  }

  SketchRunner runner_;
  std::string note_;
};

constexpr const char* kLine = R"({"op": "draw", "way": [[10, 10], [50, 10]]})";   // stroke 2
constexpr const char* kOther = R"({"op": "draw", "way": [[10, 30], [50, 30]]})";  // stroke 3
constexpr const char* kSelectFirst = R"({"op": "touch", "way": [[30, 10]], "within": 1})";

void expect_near(const Vector2& place, double x, double y) {
  EXPECT_NEAR(place.x(), x, 1e-6);
  EXPECT_NEAR(place.y(), y, 1e-6);
}

TEST(SketchTools, KnowEveryColourOfCssByName) {
  const Page page({kLine, R"({"op": "colour", "stroke": 2, "colour": "Gold"})"});
  EXPECT_EQ(page.stroke(2).colour, (Colour{1.0F, 215.0F / 255.0F, 0.0F}));
}

TEST(SketchTools, DrawMakesAStrokeWithItsWidthsAndLook) {
  const Page page(
      {R"({"op": "draw", "way": [[10, 10], [50, 10]], "pressures": [0, 1], "thinnest": 1, "widest": 3,
                       "colour": "#ff0000", "opacity": 0.5, "ends": "flat"})"});
  const Stroke& stroke = page.stroke(2);
  EXPECT_NEAR(stroke.curve.width_at(0.0), 1.0 * kOneMm, 0.06 * kOneMm);
  EXPECT_NEAR(stroke.curve.width_at(stroke.curve.end()), 3.0 * kOneMm, 0.06 * kOneMm);
  EXPECT_EQ(stroke.colour, (Colour{1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(stroke.opacity, 0.5);
  EXPECT_EQ(stroke.ends, CurveEnds::Flat);
}

// An arc of 350 degrees whose ends nearly meet, closed: its seam is as smooth as the rest.
TEST(SketchTools, AClosedStrokeHasNoKinkAtItsSeam) {
  std::string way;
  for (int i = 0; i <= 350; i += 2) {
    const double angle = i * M_PI / 180.0;
    way += (i > 0 ? ", [" : "[") + std::to_string(50 + 20 * std::cos(angle)) + ", " +
           std::to_string(50 + 20 * std::sin(angle)) + "]";
  }
  const Page page({(R"({"op": "draw", "closed": true, "widest": 4, "way": [)" + way + "]}").c_str()});
  const auto& segments = page.stroke(2).curve.segments;
  EXPECT_EQ(segments.front().points[0], segments.back().points[3]);
  EXPECT_GT(segments.front().start_direction().dot(segments.back().end_direction()), 1.0 - 1e-9);
}

TEST(SketchTools, PullTakesAPlaceWithIt) {
  Page page({kLine, kOther, R"({"op": "pull", "at": [30, 10], "to": [30, 15]})"});
  expect_near(page.at(2, 0.5), 30.0, 15.0);
  expect_near(page.at(3, 0.5), 30.0, 30.0);
}

// A number says which stroke, and the place where on it.
TEST(SketchTools, AStrokeIsNamedByNumberByPlaceOrByBoth) {
  Page page({kLine, kOther});
  EXPECT_EQ(page.error_of(R"({"op": "pull", "stroke": 3, "at": [30, 10], "to": [30, 35]})"), "");
  expect_near(page.at(3, 0.5), 30.0, 35.0);
  EXPECT_EQ(page.error_of(R"({"op": "pull", "to": [30, 15]})"), "pull: give 'stroke', 'at' or both");
  EXPECT_EQ(page.error_of(R"({"op": "pull", "at": [30, 100], "to": [30, 15]})"),
            "pull: no stroke that may be changed is within 20 mm of 'at'");
}

TEST(SketchTools, SelectionsAreMovedTurnedScaledAndMirrored) {
  const char* const about = R"({"op": "deselect"})";
  expect_near(Page({kLine, kSelectFirst, R"({"op": "move", "by": [1, 2]})", about}).at(2, 0.0), 11.0, 12.0);
  // Counter-clockwise as it is seen: the right end goes up.
  expect_near(Page({kLine, kSelectFirst, R"({"op": "rotate", "degrees": 90, "about": [10, 10]})"}).at(2, 1.0),
              10.0, -30.0);
  expect_near(Page({kLine, kSelectFirst, R"({"op": "scale", "factor": 2, "about": [10, 10]})"}).at(2, 1.0),
              90.0, 10.0);
  expect_near(Page({kLine, kSelectFirst, R"({"op": "flip"})"}).at(2, 0.0), 50.0, 10.0);
  expect_near(Page({kLine, kSelectFirst, R"({"op": "align", "grid": 4})"}).at(2, 0.0), 12.0, 12.0);
}

// The line has four control points, of which two lie left of x = 30.
TEST(SketchTools, LassoAndRectangleSelectControlPoints) {
  Page page({kLine, R"({"op": "lasso", "way": [[0, 0], [30, 0], [30, 20], [0, 20]]})"});
  EXPECT_EQ(page.selection().at(StrokeId{2}), (std::vector<bool>{true, true, false, false}));
  EXPECT_EQ(page.error_of(R"({"op": "rectangle", "from": [60, 0], "to": [30, 20]})"), "");
  EXPECT_EQ(page.selection().at(StrokeId{2}), (std::vector<bool>{false, false, true, true}));
}

TEST(SketchTools, SplitJoinCloseAndConnect) {
  const Page split({kLine, R"({"op": "split", "at": [30, 10]})"});
  expect_near(split.at(3, 1.0), 30.0, 10.0);
  expect_near(split.at(4, 0.0), 30.0, 10.0);
  const Page joined({kLine, kOther, R"({"op": "join", "strokes": [2, 3]})"});
  EXPECT_EQ(joined.drawing().stroke_count(), 1U);
  const Page closed({kLine, R"({"op": "close", "stroke": 2})"});
  EXPECT_TRUE(closed.stroke(2).curve.closed);
  const Page connected(
      {kLine, R"({"op": "draw", "way": [[51, 10], [60, 20]]})", R"({"op": "connect", "within": 2})"});
  EXPECT_EQ(connected.at(2, 1.0), connected.at(3, 0.0));
}

TEST(SketchTools, LooksOfStrokes) {
  const Page page({kLine, R"({"op": "colour", "stroke": 2, "colour": "#00ff00"})",
                   R"({"op": "fill", "stroke": 2, "colour": "#0000ff"})",
                   R"({"op": "opacity", "stroke": 2, "opacity": 0.25})",
                   R"({"op": "ends", "stroke": 2, "ends": "flat"})"});
  EXPECT_EQ(page.stroke(2).colour, (Colour{0.0F, 1.0F, 0.0F}));
  EXPECT_EQ(page.stroke(2).fill, (Colour{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(page.stroke(2).opacity, 0.25);
  EXPECT_EQ(page.stroke(2).ends, CurveEnds::Flat);
}

TEST(SketchTools, CopyDeleteEraseAndWidth) {
  Page page({kLine, R"({"op": "copy", "stroke": 2, "by": [0, 20]})"});
  expect_near(page.at(3, 0.0), 10.0, 30.0);
  EXPECT_EQ(page.error_of(R"({"op": "width", "stroke": 3, "at": [30, 30], "factor": 3, "reach": 5})"), "");
  EXPECT_NEAR(page.stroke(3).curve.width_at(0.5), 3.0 * kOneMm, 1e-9);
  EXPECT_EQ(page.error_of(R"({"op": "delete", "stroke": 2})"), "");
  EXPECT_EQ(page.error_of(R"({"op": "erase", "way": [[30, 20], [30, 40]], "radius": 2})"), "");
  ASSERT_EQ(page.drawing().stroke_count(), 2U);
  expect_near(page.drawing().layers[0].strokes[0]->curve.at(0.0) / kOneMm, 10.0, 30.0);
}

TEST(SketchTools, Layers) {
  Page page({kLine, R"({"op": "add-layer", "name": "Ink"})", kOther});
  ASSERT_EQ(page.drawing().layers.size(), 2U);
  EXPECT_EQ(page.drawing().layers[1].strokes.size(), 1U);
  EXPECT_EQ(page.error_of(R"({"op": "move-layer", "layer": "Ink", "place": 7})"),
            "move-layer: 'place' must be 1 to 2, the number of layers, not 7");
  EXPECT_EQ(page.error_of(R"({"op": "move-layer", "layer": "Ink", "place": 1})"), "");
  EXPECT_EQ(page.drawing().layers[0].name, "Ink");
  EXPECT_EQ(page.error_of(R"({"op": "to-layer", "layer": "Ink", "stroke": 2})"), "");
  EXPECT_EQ(page.drawing().layers[0].strokes.size(), 2U);
  EXPECT_EQ(page.error_of(R"({"op": "change-layer", "layer": "Ink", "visible": false})"), "");
  // The layer that strokes go to is hidden now.
  EXPECT_EQ(page.error_of(kLine), "draw: layer \"Ink\" is hidden; choose another one");
  EXPECT_EQ(page.error_of(R"({"op": "choose-layer", "layer": "Layer 1"})"), "");
  EXPECT_EQ(page.error_of(kLine), "");
  EXPECT_EQ(page.error_of(R"({"op": "delete-layer", "layer": "Ink"})"), "");
  EXPECT_EQ(page.drawing().layers.size(), 1U);
}

TEST(SketchTools, PaperAndUndo) {
  Page page({R"({"op": "paper", "width": 100, "height": 50})"});
  EXPECT_EQ(page.drawing().size, Vector2(0.1, 0.05));
  EXPECT_EQ(page.error_of(R"({"op": "undo"})"), "");
  EXPECT_EQ(page.drawing().size, Vector2(0.297, 0.21));
  EXPECT_EQ(page.error_of(R"({"op": "undo"})"), "undo: there is nothing to undo");
  EXPECT_EQ(page.error_of(R"({"op": "redo"})"), "");
}

}  // namespace
}  // namespace icome::sketch
