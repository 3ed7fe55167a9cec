#include "drawing/svg/svg_reader.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "drawing/svg/svg_names.h"

namespace icome::drawing {
namespace {

/// An SVG of 100 x 100 mm whose units are mm.
std::string svg_of(const std::string& inside) {
  return "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' "
         "xmlns:inkscape='http://www.inkscape.org/namespaces/inkscape' "
         "xmlns:icome='https://icome.org/sketch' "
         "width='100mm' height='100mm' viewBox='0 0 100 100'>\n" +
         inside + "</svg>\n";
}

DrawingRead drawn(const std::string& inside) {
  auto read = read_svg_text(svg_of(inside), "a.svg");
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(*read) : DrawingRead{};
}

std::string svg_error(const std::string& text) {
  const auto read = read_svg_text(text, "a.svg");
  return read ? "" : read.error().message;
}

/// The only stroke of a drawing.
Stroke only_stroke(const std::string& inside) {
  const DrawingRead read = drawn(inside);
  EXPECT_EQ(read.drawing.stroke_count(), 1U);
  return read.drawing.stroke_count() == 1 ? *read.drawing.layers[0].strokes[0] : Stroke{};
}

TEST(SvgReader, TakesUnitsFromWidthAndViewBox) {
  const auto pixels = read_svg_text("<svg width='96' height='2in'><path d='M0 0H96'/></svg>", "a.svg");
  ASSERT_TRUE(pixels) << pixels.error().message;
  EXPECT_TRUE(pixels->drawing.size.isApprox(Vector2(0.0254, 0.0508)));
  const DrawingRead read = drawn("<path d='M0 0L10 20' stroke='red' stroke-width='2'/>");
  EXPECT_TRUE(read.drawing.size.isApprox(Vector2(0.1, 0.1)));
  const Stroke& stroke = *read.drawing.layers.at(0).strokes.at(0);
  EXPECT_TRUE(stroke.curve.segments[0].points[3].isApprox(Vector2(0.01, 0.02)));
  ASSERT_EQ(stroke.curve.widths.size(), 1U);
  EXPECT_NEAR(stroke.curve.widths[0].to_width, 0.002, 1e-15);
  EXPECT_FALSE(stroke.fill) << "a straight line encloses nothing";
  EXPECT_EQ(stroke.ends, CurveEnds::Flat) << "butt is the default of SVG";
}

TEST(SvgReader, FitsTheViewBoxIntoThePaper) {
  const auto read = read_svg_text(
      "<svg width='200mm' height='100mm' viewBox='0 0 10 10'><path stroke='red' d='M0 0L10 10'/></svg>",
      "a.svg");
  ASSERT_TRUE(read) << read.error().message;
  const CubicBezier& line = read->drawing.layers.at(0).strokes.at(0)->curve.segments[0];
  EXPECT_TRUE(line.points[0].isApprox(Vector2(0.05, 0.0))) << "xMidYMid: 100 mm wide in the middle of 200 mm";
  EXPECT_TRUE(line.points[3].isApprox(Vector2(0.15, 0.1)));
}

TEST(SvgReader, HasTheDefaultLook) {
  const Stroke stroke = only_stroke("<rect x='1' y='1' width='2' height='2'/>");
  EXPECT_TRUE(stroke.curve.widths.empty()) << "no stroke";
  EXPECT_EQ(stroke.fill, (Colour{0.0F, 0.0F, 0.0F}));
  EXPECT_TRUE(stroke.curve.closed);
  EXPECT_EQ(stroke.curve.segments.size(), 4U);
}

TEST(SvgReader, DrawsShapes) {
  const auto bounds = [](const char* shape) { return only_stroke(shape).curve.bounds(); };
  const auto is_box = [](const Bounds2& box, double x0, double y0, double x1, double y1) {
    return (1e3 * box.min() - Vector2(x0, y0)).norm() < 1e-3 &&
           (1e3 * box.max() - Vector2(x1, y1)).norm() < 1e-3;
  };
  EXPECT_TRUE(is_box(bounds("<circle cx='5' cy='6' r='2'/>"), 3, 4, 7, 8));
  EXPECT_TRUE(is_box(bounds("<ellipse cx='5' cy='6' rx='2' ry='1'/>"), 3, 5, 7, 7));
  EXPECT_TRUE(is_box(bounds("<rect x='1' y='2' width='50%' height='4' rx='1'/>"), 1, 2, 51, 6));
  EXPECT_TRUE(is_box(bounds("<polygon points='0,0 4,0 4,3'/>"), 0, 0, 4, 3));
  EXPECT_TRUE(is_box(bounds("<polyline points='0 0-4 0 4 3'/>"), -4, 0, 4, 3));
  EXPECT_TRUE(is_box(bounds("<line x1='1' y1='1' x2='2' y2='3' stroke='#00f'/>"), 1, 1, 2, 3));
}

TEST(SvgReader, InheritsAndOverridesLooks) {
  const Stroke stroke = only_stroke(
      "<g fill='none' stroke='currentColor' color='#0f0' opacity='0.5'><g "
      "style='stroke-width:4;stroke-linecap: "
      "round'><path d='M0 0C1 1 2 1 3 0' stroke-width='9' "
      "style='stroke-opacity:0.5;stroke-width:3'/></g></g>");
  EXPECT_EQ(stroke.colour, (Colour{0.0F, 1.0F, 0.0F}));
  EXPECT_EQ(stroke.opacity, 0.25) << "half of the group's half";
  EXPECT_NEAR(stroke.curve.widest(), 0.003, 1e-15) << "the style attribute wins over the presentation one";
  EXPECT_EQ(stroke.ends, CurveEnds::Round);
  EXPECT_FALSE(stroke.fill);
}

TEST(SvgReader, KnowsColours) {
  const auto colour = [](const std::string& value) {
    return only_stroke("<path d='M0 0H9' stroke='" + value + "'/>").colour;
  };
  EXPECT_EQ(colour("RebeccaPurple"), (Colour{0.4F, 0.2F, 0.6F}));
  EXPECT_EQ(colour("mud"), (Colour{0.0F, 0.0F, 0.0F})) << "no name of CSS: told and black";
  EXPECT_EQ(colour("yellowgreen"), (Colour{154.0F / 255.0F, 205.0F / 255.0F, 50.0F / 255.0F}));
  EXPECT_EQ(colour("#F80"), (Colour{1.0F, 136.0F / 255.0F, 0.0F}));
  EXPECT_EQ(colour("rgb(255, 50%,0)"), (Colour{1.0F, 0.5F, 0.0F}));
  EXPECT_EQ(colour("rgb(100% 50% 0% / 30%)"), (Colour{1.0F, 0.5F, 0.0F}));
  EXPECT_EQ(colour("HSL(0,100%,50%)"), (Colour{1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(colour("hsl(120deg 100% 25%)"), (Colour{0.0F, 0.5F, 0.0F})) << "green, as the name has it";
  EXPECT_EQ(colour("hsla(-0.5turn, 100%, 50%, 0.5)"), (Colour{0.0F, 1.0F, 1.0F})) << "half around is cyan";
  EXPECT_EQ(colour("hsl(77, 0%, 75%)"), (Colour{0.75F, 0.75F, 0.75F})) << "without saturation it is grey";
  EXPECT_EQ(colour("hsl(60 100% 50%"), (Colour{0.0F, 0.0F, 0.0F})) << "the bracket is missing";
  EXPECT_EQ(colour("url(#g) blue"), (Colour{0.0F, 0.0F, 1.0F}));
}

TEST(SvgReader, AppliesNestedTransforms) {
  const Stroke stroke = only_stroke(
      "<g transform='translate(10,20) scale(2)'><line transform='rotate(90 5 0)' x2='10' stroke='red'/></g>");
  EXPECT_TRUE(stroke.curve.segments[0].points[0].isApprox(Vector2(0.020, 0.010))) << "0,0 about 5,0: 5,-5";
  EXPECT_NEAR(stroke.curve.widest(), 0.002, 1e-15);
}

TEST(SvgReader, MakesLayersOfGroupsAndKeepsTheOrder) {
  const DrawingRead read = drawn(
      "<path d='M0 0H1V1'/><g id='a' inkscape:groupmode='layer' inkscape:label='Ink' style='display:none'>"
      "<path d='M0 0H1V1'/></g><path d='M0 0H1V1'/><g id='b'><path d='M0 0H1V1'/></g><g/>");
  ASSERT_EQ(read.drawing.layers.size(), 4U);
  EXPECT_EQ(read.drawing.layers[0].name, "Layer 1");
  EXPECT_EQ(read.drawing.layers[1].name, "Ink");
  EXPECT_FALSE(read.drawing.layers[1].visible);
  EXPECT_EQ(read.drawing.layers[1].strokes.size(), 1U) << "a hidden layer keeps its strokes";
  EXPECT_EQ(read.drawing.layers[2].name, "Layer 2") << "above the layer Ink, so not in Layer 1";
  EXPECT_EQ(read.drawing.layers[3].name, "b");
}

TEST(SvgReader, TellsWhatItSkipsByLine) {
  const DrawingRead read =
      drawn("<text>a</text>\n<text>b</text>\n<image/><path d='M0 0H1V1ZM2 2H3V3Z' filter='url(#f)'/>");
  const std::vector<std::string> expected = {"a.svg:2: <text> is skipped (2 times, last in line 3)",
                                             "a.svg:4: <image> is skipped", "a.svg:4: filter is skipped"};
  EXPECT_EQ(read.notes, expected);
  EXPECT_EQ(read.drawing.stroke_count(), 2U);
}

TEST(SvgReader, SplitsUnequalOpacities) {
  const DrawingRead read = drawn("<path d='M0 0H1V1Z' stroke='red' fill='blue' fill-opacity='0.5'/>");
  ASSERT_EQ(read.drawing.stroke_count(), 2U) << "a stroke has one opacity";
  const auto& strokes = read.drawing.layers[0].strokes;
  EXPECT_EQ(strokes[0]->opacity, 0.5);
  EXPECT_TRUE(strokes[0]->curve.widths.empty());
  EXPECT_FALSE(strokes[1]->fill);
}

TEST(SvgReader, FollowsUse) {
  const Stroke stroke = only_stroke(
      "<defs><symbol id='s' viewBox='0 0 1 1'><path id='p' d='M0 0H1V1' fill='red'/></symbol></defs>"
      "<use xlink:href='#s' x='10' y='20' width='30' height='30'/>");
  EXPECT_TRUE(stroke.curve.bounds().max().isApprox(Vector2(0.04, 0.05)));
  EXPECT_EQ(drawn("<path id='a' d='M0 0H1V1'/><use href='#a' x='5'/>").drawing.stroke_count(), 2U);
}

TEST(SvgReader, EndsUseOfItself) {
  const DrawingRead own = drawn("<g id='a'>\n<path d='M0 0H1V1'/><use href='#a'/></g>");
  EXPECT_EQ(own.notes, std::vector<std::string>{"a.svg:3: <use> that shows itself, or lies more than 32 deep "
                                                "in others, is skipped"});
  EXPECT_EQ(own.drawing.stroke_count(), 1U);
  const DrawingRead pair = drawn(
      "<defs><g id='a'><path d='M0 0H1V1'/><use href='#b'/></g><g id='b'><use href='#a'/></g></defs>"
      "<use href='#a'/>");
  EXPECT_EQ(pair.drawing.stroke_count(), 1U) << "where a is shown by b it is not shown again";
  std::string doubling = "<path id='a0' d='M0 0H1V1'/>";
  for (int i = 1; i < 30; ++i)
    doubling += "<g id='a" + std::to_string(i) + "'><use href='#a" + std::to_string(i - 1) +
                "'/><use href='#a" + std::to_string(i - 1) + "'/></g>\n";
  EXPECT_NE(svg_error(svg_of(doubling)).find("elements or 128 MiB are to be drawn"), std::string::npos);
}

TEST(SvgReader, RefusesWhatIsNoSvg) {
  EXPECT_EQ(svg_error("<svg>\n<path d='M0 0L1 1").substr(0, 30), "a.svg:2: it is no sound XML (E");
  EXPECT_EQ(svg_error("<html/>"), "a.svg:1: it is no SVG, which begins with <svg>, but <html>");
}

/// The note on something faulty that stands before a sound path: that one must be drawn all the same.
std::string skipped_note(const std::string& faulty) {
  const DrawingRead read = drawn(faulty + "<path id='sound' d='M0 0H50V50Z'/>");
  EXPECT_EQ(read.drawing.stroke_count(), 1U) << faulty;
  EXPECT_EQ(read.notes.size(), 1U) << faulty;
  return read.notes.empty() ? "" : read.notes[0];
}

TEST(SvgReader, SkipsFaultyElementsAndGoesOn) {
  EXPECT_EQ(skipped_note("\n<path d='M0 0LNaN 1'/>"),
            "a.svg:3: 'NaN' stands in the path data where a number of 'L' is expected");
  EXPECT_EQ(skipped_note("<path d='M0 0L1e200 1V1'/>"),
            "a.svg:2: a line that reaches farther than 10000 m from the paper's corner is skipped");
  EXPECT_EQ(skipped_note("<g transform='scale(1e300) scale(1e300)'/>"),
            "a.svg:2: the transform has numbers that are too large: it is left out");
  EXPECT_EQ(
      skipped_note("<g transform='scale(1e200)'><g transform='scale(1e200)'><path d='M0 0H9'/></g></g>"),
      "a.svg:2: an element whose transforms have numbers that are too large is skipped");
  EXPECT_EQ(skipped_note("<circle cx='5' cy='5' r='-2'/>"), "a.svg:2: r of <circle> is negative");
  EXPECT_EQ(skipped_note("<rect width='1' height='two'/>"), "a.svg:2: height='two' of <rect> is no length");
  EXPECT_EQ(skipped_note("<polygon points='x'/>"), "a.svg:2: 'x' in the points is no pair of numbers");
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "<g>";
  for (int i = 0; i < 100000; ++i) deep += "</g>";
  EXPECT_EQ(skipped_note(deep), "a.svg:2: what lies more than 200 elements deep is skipped");
}

TEST(SvgReader, LeavesOutFaultyAttributes) {
  const DrawingRead turned = drawn("<path transform='turn(3)' d='M0 0H10V10'/>");
  EXPECT_EQ(turned.notes, std::vector<std::string>{
                              "a.svg:2: 'turn(3)' in the transform is no matrix, translate, scale, rotate, "
                              "skewX or skewY with its numbers: it is left out"});
  EXPECT_TRUE(turned.drawing.bounds().max().isApprox(Vector2(0.01, 0.01)));
  EXPECT_TRUE(only_stroke("<rect width='10' height='10' rx='-1'/>").curve.segments.size() == 4)
      << "a radius below 0 is none";
  EXPECT_EQ(only_stroke("<polyline points='0,0 10,0 10,10 20'/>").curve.segments.size(), 2U)
      << "a coordinate without a partner is no corner";
  const auto read =
      read_svg_text("<svg width='0' height='many' viewBox='0 0 0 1'><path d='M0 0H96V96'/></svg>", "a.svg");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->notes,
            (std::vector<std::string>{
                "a.svg:1: the height 'many' is no length in a unit of SVG above 0 and up to 10000 m, and is "
                "left out",
                "a.svg:1: the viewBox '0 0 0 1' is not four numbers, the last two above 0: it is left out",
                "a.svg:1: the width '0' is no length in a unit of SVG above 0 and up to 10000 m, and is left "
                "out"}));
  EXPECT_EQ(read->drawing.size, Drawing().size);
  EXPECT_TRUE(read->drawing.bounds().max().isApprox(Vector2(0.0254, 0.0254)));
}

TEST(SvgReader, DrawsDotsWithRoundEndsOnly) {
  const Stroke dot = only_stroke("<path d='M15 5z' stroke='red' stroke-width='4' stroke-linecap='round'/>");
  EXPECT_TRUE(dot.curve.at(0.0).isApprox(Vector2(0.015, 0.005)));
  EXPECT_NEAR(dot.curve.width_at(0.5), 0.004, 1e-12);
  EXPECT_EQ(drawn("<path d='M15 5z' stroke='red'/><path d='M1 1z'/>").drawing.stroke_count(), 0U);
  EXPECT_EQ(only_stroke("<path d='M1 1L9 1V9zz' stroke='red' stroke-linecap='round'/>").curve.segments.size(),
            3U);
}

TEST(SvgReader, KeepsWidthsThatDoNotScale) {
  const Stroke fixed = only_stroke(
      "<g transform='scale(7)'><path d='M0 0H1' stroke='red' stroke-width='2' "
      "vector-effect='non-scaling-stroke'/></g>");
  EXPECT_NEAR(fixed.curve.width_at(0.5), 2.0 * 0.0254 / 96.0, 1e-12) << "2 px as a browser shows them";
  const Stroke inner =
      only_stroke("<g vector-effect='non-scaling-stroke'><path d='M0 0H1' stroke='red'/></g>");
  EXPECT_NEAR(inner.curve.width_at(0.5), 0.001, 1e-12) << "it is not inherited";
}

TEST(SvgReader, TellsOfTranslucentGroups) {
  const std::string two = "<path d='M0 0H9' stroke='red'/><path d='M0 1H9' stroke='red'/>";
  EXPECT_EQ(drawn("<g opacity='0.5'>" + two + "</g>").notes.size(), 1U);
  EXPECT_TRUE(drawn("<g opacity='0.5'><path d='M0 0H9' stroke='red'/></g>").notes.empty());
  EXPECT_TRUE(drawn("<g>" + two + "</g>").notes.empty());
}

// Files that the project wrote.

constexpr const char* kOwnPath =
    "<path d='M0 0H1V1' icome:curve='M1,2 C3,4 5,6 0.1,8 C1,1 2,2 1,2' icome:widths='0,1,0.5,2.5 "
    "0.5,2.5,2,0.1' "
    "icome:closed='true' icome:colour='0.1,0.2,0.3' icome:fill='#ff0000' icome:ends='flat' "
    "icome:opacity='0.7'";

TEST(SvgReader, ReadsItsOwnStrokes) {
  const Stroke stroke = only_stroke(std::string(kOwnPath) + "/>");
  ASSERT_EQ(stroke.curve.segments.size(), 2U);
  EXPECT_EQ(stroke.curve.segments[0].points[3], Vector2(0.1e-3, 8e-3)) << "to the bit";
  ASSERT_EQ(stroke.curve.widths.size(), 2U);
  EXPECT_EQ(stroke.curve.widths[1], (WidthSegment{0.5, 2.5e-3, 2.0, 0.1e-3}));
  EXPECT_TRUE(stroke.curve.closed);
  EXPECT_EQ(stroke.colour, (Colour{0.1F, 0.2F, 0.3F}));
  EXPECT_EQ(stroke.fill, (Colour{1.0F, 0.0F, 0.0F}));
  EXPECT_EQ(stroke.ends, CurveEnds::Flat);
  EXPECT_EQ(stroke.opacity, 0.7);
}

TEST(SvgReader, FollowsWhatOtherProgramsDidToItsStrokes) {
  const Stroke moved = only_stroke("<g transform='translate(10,0)'>" + std::string(kOwnPath) + "/></g>");
  EXPECT_TRUE(moved.curve.segments[0].points[0].isApprox(Vector2(0.011, 0.002)));
  const std::string mark = drawn_mark("M0 0H1V1");
  const Stroke same =
      only_stroke(std::string(kOwnPath) + " fill='red' opacity='0.7' icome:drawn='" + mark + "'/>");
  EXPECT_EQ(same.opacity, 0.7);
  const Stroke redrawn = only_stroke(std::string(kOwnPath) + " icome:drawn='0'/>");
  EXPECT_TRUE(redrawn.curve.segments[0].points[0].isApprox(Vector2(0.0, 0.0))) << "d counts";
}

TEST(SvgReader, ReadsItsOwnLayersAndPaper) {
  const auto read = read_svg_text(
      "<svg xmlns='http://www.w3.org/2000/svg' xmlns:i='https://icome.org/sketch' i:size='297,210.5'>"
      "<g id='x' i:layer='' i:locked='true' display='none'/><path i:shown='only' d='M0 0H1V1'/></svg>",
      "a.svg");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->drawing.size, Vector2(0.297, 0.2105));
  ASSERT_EQ(read->drawing.layers.size(), 1U) << "an empty layer of ours is one, a path for show is none";
  EXPECT_EQ(read->drawing.layers[0].name, "");
  EXPECT_TRUE(read->drawing.layers[0].locked);
  EXPECT_FALSE(read->drawing.layers[0].visible);
}

TEST(SvgReader, TakesWhatIsDrawnWhereItsOwnDataAreFaulty) {
  const auto fault = [](const std::string& attributes) {
    const DrawingRead read = drawn("<path d='M0 0H10V10' " + attributes + "/>");
    EXPECT_EQ(read.drawing.stroke_count(), 1U);
    EXPECT_TRUE(read.drawing.bounds().max().isApprox(Vector2(0.01, 0.01))) << "d counts";
    return read.notes.size() == 1 ? read.notes[0] : "";
  };
  const std::string instead = ": what the path draws is taken";
  EXPECT_EQ(fault("icome:curve='M1,2 C3,4 5,x'"), "a.svg:2: icome:curve: 'x' is no number" + instead);
  EXPECT_EQ(fault("icome:curve='M1,2 C3,4 5'"), "a.svg:2: icome:curve: a number is missing" + instead);
  EXPECT_EQ(fault("icome:curve='M1,2'"), "a.svg:2: icome:curve has no segment" + instead);
  EXPECT_EQ(fault("icome:curve='M1,2 C3,4 5,6 7,8' icome:widths='0,1,2,1'"),
            "a.svg:2: icome:widths end at 2, but the curve at 1" + instead);
  EXPECT_EQ(fault("icome:curve='M1,2 C3,4 5,6 7,8' icome:closed='true'"),
            "a.svg:2: icome:closed is true, but the end of icome:curve is not its start" + instead);
}

}  // namespace
}  // namespace icome::drawing
