#include "drawing/svg/svg_writer.h"

#include <gtest/gtest.h>

#include "base/random.h"
#include "drawing/svg/svg_reader.h"

namespace icome::drawing {
namespace {

Drawing with_stroke(const Stroke& stroke) {
  Drawing drawing;
  drawing.layers.push_back({drawing.next_layer_id(), "ink", true, false, {}});
  drawing.layers[0].strokes.push_back(std::make_shared<const Stroke>(stroke));
  return drawing;
}

Stroke plain_stroke(double width) {
  Stroke stroke;
  stroke.curve = {{CubicBezier::line({0.01, 0.02}, {0.03, 0.02})}, {{0.0, width, 1.0, width}}, false};
  return stroke;
}

float random_channel(base::Random& random) { return float(random.uniform()); }
Colour random_colour(base::Random& random) {
  return {random_channel(random), random_channel(random), random_channel(random)};
}

Curve random_written_curve(base::Random& random) {
  const auto point = [&] { return Vector2(random.uniform(-0.1, 0.4), random.uniform(-0.1, 0.3)); };
  Curve curve;
  const std::size_t count = 1 + random.index(4);
  Vector2 at = point();
  for (std::size_t i = 0; i < count; ++i) {
    curve.segments.push_back({{at, point(), point(), point()}});
    at = curve.segments.back().points[3];
  }
  curve.closed = random.index(3) == 0;
  if (curve.closed) curve.segments.back().points[3] = curve.segments.front().points[0];
  if (random.index(6) == 0) return curve;  // only its fill is seen
  const double cut = random.uniform(0.1, double(count) - 0.1);
  const double width = random.uniform(0.0, 0.005);
  curve.widths = {{0.0, random.uniform(0.0, 0.005), cut, width}, {cut, width, double(count), 1e-300}};
  return curve;
}

Drawing random_drawing(std::uint64_t seed) {
  base::Random random(seed);
  Drawing drawing;
  drawing.size = {random.uniform(0.05, 1.0), random.uniform(0.05, 1.0)};
  const char* names[] = {"", "ink & <paint>", "\"quoted\"\n\ttwice", "b\u00fcste"};
  for (std::size_t i = random.index(4); i-- > 0;) {
    Layer layer{
        drawing.next_layer_id(), names[random.index(4)], random.index(2) == 0, random.index(2) == 0, {}};
    for (std::size_t k = random.index(5); k-- > 0;) {
      Stroke stroke{drawing.next_stroke_id(),
                    random_written_curve(random),
                    random_colour(random),
                    random.uniform(),
                    {},
                    random.index(2) ? CurveEnds::Round : CurveEnds::Flat};
      if (random.index(2)) stroke.fill = random_colour(random);
      layer.strokes.push_back(std::make_shared<const Stroke>(stroke));
    }
    drawing.layers.push_back(layer);
  }
  return drawing;
}

void expect_equal_but_for_ids(const Drawing& read, const Drawing& drawn) {
  EXPECT_EQ(read.size, drawn.size);
  ASSERT_EQ(read.layers.size(), drawn.layers.size());
  for (std::size_t i = 0; i < drawn.layers.size(); ++i) {
    const Layer& a = read.layers[i];
    const Layer& b = drawn.layers[i];
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.visible, b.visible);
    EXPECT_EQ(a.locked, b.locked);
    ASSERT_EQ(a.strokes.size(), b.strokes.size());
    for (std::size_t k = 0; k < b.strokes.size(); ++k) {
      Stroke same = *a.strokes[k];
      same.id = b.strokes[k]->id;
      EXPECT_EQ(same, *b.strokes[k]) << "layer " << i << ", stroke " << k;
    }
  }
}

TEST(SvgText, ComesBackAsItWas) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Drawing drawn = random_drawing(seed);
    for (const SvgLines lines : {SvgLines::Outlines, SvgLines::CentreLines}) {
      const auto read = read_svg_text(svg_text(drawn, lines), "drawn.svg");
      ASSERT_TRUE(read) << read.error().message;
      EXPECT_TRUE(read->notes.empty()) << read->notes.front();
      expect_equal_but_for_ids(read->drawing, drawn);
      if (HasFailure()) FAIL() << "seed " << seed;
    }
  }
}

TEST(SvgText, IsInMillimetres) {
  const std::string text = svg_text(with_stroke(plain_stroke(0.002)), SvgLines::CentreLines);
  EXPECT_NE(text.find("width=\"297mm\" height=\"210mm\" viewBox=\"0 0 297 210\""), std::string::npos) << text;
  EXPECT_NE(text.find("stroke-width=\"2\""), std::string::npos) << text;
  EXPECT_NE(text.find("d=\"M10,20 C16.66667,20 23.33333,20 30,20\""), std::string::npos) << text;
}

TEST(SvgText, OutlinesAreFilledByTheNonZeroRule) {
  Stroke stroke = plain_stroke(0.002);
  stroke.ends = CurveEnds::Flat;
  stroke.colour = {1.0F, 0.0F, 0.0F};
  const std::string text = svg_text(with_stroke(stroke), SvgLines::Outlines);
  EXPECT_NE(text.find("d=\"M10,21 L30,21 L30,19 L10,19 L10,21 Z\""), std::string::npos) << text;
  EXPECT_NE(text.find("fill=\"#ff0000\" fill-rule=\"nonzero\""), std::string::npos) << text;
}

TEST(SvgText, LineAndFillAreTranslucentTogether) {
  Stroke stroke = plain_stroke(0.002);
  stroke.fill = Colour{0.0F, 1.0F, 0.0F};
  stroke.opacity = 0.5;
  const std::string text = svg_text(with_stroke(stroke), SvgLines::Outlines);
  const std::size_t group = text.find("<g opacity=\"0.5\">");
  ASSERT_NE(group, std::string::npos) << text;
  EXPECT_EQ(text.find(" opacity=", group + 5), std::string::npos) << text;
}

TEST(SvgText, LayersAreLayersInInkscapeToo) {
  Drawing drawing = with_stroke(plain_stroke(0.001));
  drawing.layers[0].name = "a<b";
  drawing.layers[0].visible = false;
  const std::string text = svg_text(drawing, SvgLines::Outlines);
  EXPECT_NE(text.find("inkscape:groupmode=\"layer\" inkscape:label=\"a&lt;b\""), std::string::npos) << text;
  EXPECT_NE(text.find("display=\"none\""), std::string::npos) << text;
}

// Changes that another program may make to a file of the project.

/// The text of a drawing with one part in the place of another, read again.
DrawingRead read_changed(const Drawing& drawing, SvgLines lines, const std::string& part,
                         const std::string& other) {
  std::string text = svg_text(drawing, lines);
  const std::size_t place = text.find(part);
  EXPECT_NE(place, std::string::npos) << part << " in " << text;
  if (place != std::string::npos) text.replace(place, part.size(), other);
  auto read = read_svg_text(text, "changed.svg");
  EXPECT_TRUE(read) << read.error().message;
  return read ? std::move(*read) : DrawingRead{};
}

Stroke stroke_changed(const Stroke& stroke, SvgLines lines, const std::string& part, const std::string& other,
                      const std::string& change) {
  const DrawingRead read = read_changed(with_stroke(stroke), lines, part, other);
  EXPECT_EQ(read.notes.size(), 1U);
  if (read.notes.size() == 1) {
    EXPECT_NE(read.notes[0].find("changed " + change + " of"), std::string::npos) << read.notes[0];
  }
  return read.drawing.stroke_count() == 1 ? *read.drawing.layers[0].strokes[0] : Stroke{};
}

/// Red, green within, half opaque, from 1 mm to 3 mm wide.
Stroke filled_stroke() {
  Stroke stroke = plain_stroke(0.002);
  stroke.curve.widths = {{0.0, 0.001, 1.0, 0.003}};
  stroke.colour = {1.0F, 0.0F, 0.0F};
  stroke.fill = Colour{0.0F, 1.0F, 0.0F};
  stroke.opacity = 0.5;
  return stroke;
}

TEST(SvgOfOthers, RepaintsOutlines) {
  const Stroke line = stroke_changed(filled_stroke(), SvgLines::Outlines, "fill=\"#ff0000\"",
                                     "style=\"fill:#0000ff\"", "the colour");
  EXPECT_EQ(line.colour, (Colour{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(line.fill, filled_stroke().fill);
  EXPECT_EQ(line.curve, filled_stroke().curve) << "and no more";
  const Stroke area =
      stroke_changed(filled_stroke(), SvgLines::Outlines, "fill=\"#00ff00\"", "fill=\"#0000ff\"", "the fill");
  EXPECT_EQ(area.fill, (Colour{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(area.colour, filled_stroke().colour);
  const Stroke clear = stroke_changed(filled_stroke(), SvgLines::Outlines, "opacity=\"0.5\"",
                                      "opacity=\"0.25\"", "the opacity");
  EXPECT_EQ(clear.opacity, 0.25);
}

TEST(SvgOfOthers, RepaintsCentreLines) {
  const auto changed = [](const char* part, const char* other, const char* change) {
    return stroke_changed(filled_stroke(), SvgLines::CentreLines, part, other, change);
  };
  EXPECT_EQ(changed("stroke=\"#ff0000\"", "stroke=\"blue\"", "the colour").colour,
            (Colour{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(changed("fill=\"#00ff00\"", "fill=\"none\"", "the fill").fill, std::nullopt);
  EXPECT_EQ(changed("linecap=\"round\"", "linecap=\"butt\"", "the ends").ends, CurveEnds::Flat);
  const Stroke wide = changed("stroke-width=\"2\"", "stroke-width=\"4\"", "the width");
  ASSERT_EQ(wide.curve.widths.size(), 1U);
  EXPECT_DOUBLE_EQ(wide.curve.widths[0].from_width, 0.002);
  EXPECT_DOUBLE_EQ(wide.curve.widths[0].to_width, 0.006);
}

TEST(SvgOfOthers, TakeTheFillOut) {
  const std::string text = svg_text(with_stroke(filled_stroke()), SvgLines::Outlines);
  const std::size_t begin = text.find("<path"), end = text.find("/>", begin) + 2;
  const DrawingRead read =
      read_changed(with_stroke(filled_stroke()), SvgLines::Outlines, text.substr(begin, end - begin), "");
  ASSERT_EQ(read.drawing.stroke_count(), 1U);
  EXPECT_EQ(read.drawing.layers[0].strokes[0]->fill, std::nullopt);
  EXPECT_EQ(read.drawing.layers[0].strokes[0]->colour, filled_stroke().colour);
}

TEST(SvgOfOthers, RenameUnlockAndShowLayers) {
  Drawing drawing = with_stroke(plain_stroke(0.002));
  drawing.layers[0].locked = true;
  drawing.layers[0].visible = false;
  const auto layer = [&](const char* part, const char* other) {
    return read_changed(drawing, SvgLines::Outlines, part, other).drawing.layers.at(0);
  };
  EXPECT_EQ(layer("inkscape:label=\"ink\"", "inkscape:label=\"sky\"").name, "sky");
  EXPECT_FALSE(layer(" sodipodi:insensitive=\"true\"", "").locked);
  EXPECT_TRUE(layer(" display=\"none\"", "").visible);
  const Layer same = layer("<svg", "<svg");
  EXPECT_EQ(same.name, "ink");
  EXPECT_TRUE(same.locked);
  EXPECT_FALSE(same.visible);
}

TEST(SvgOfOthers, ChangeThePaper) {
  const Drawing drawing = with_stroke(plain_stroke(0.002));
  const Vector2 start = drawing.layers[0].strokes[0]->curve.at(0.0);
  const DrawingRead larger =
      read_changed(drawing, SvgLines::Outlines, "width=\"297mm\" height=\"210mm\" viewBox=\"0 0 297 210\"",
                   "width=\"420mm\" height=\"297mm\" viewBox=\"-10 -20 420 297\"");
  EXPECT_TRUE(larger.drawing.size.isApprox(Vector2(0.420, 0.297)));
  const Curve& moved = larger.drawing.layers.at(0).strokes.at(0)->curve;
  EXPECT_TRUE(moved.at(0.0).isApprox(start + Vector2(0.010, 0.020), 1e-12));
  EXPECT_NEAR(moved.widths.at(0).to_width, 0.002, 1e-12);
  const DrawingRead stripped = read_changed(drawing, SvgLines::Outlines, "width=\"297mm\" height=\"210mm\"",
                                            "width=\"100%\" height=\"100%\"");
  EXPECT_EQ(stripped.drawing.size, drawing.size) << "nothing says that it was changed";
  EXPECT_EQ(stripped.drawing.layers.at(0).strokes.at(0)->curve.at(0.0), start);
}

TEST(SvgOfOthers, ChangeMoreOfAFillThanItsColour) {
  const Drawing drawing = with_stroke(filled_stroke());
  const struct {
    const char *part, *other;
    std::size_t strokes;
  } changes[] = {{"fill=\"#00ff00\"", "fill=\"#00ff00\" fill-opacity=\"0.2\"", 2},
                 {"fill=\"#00ff00\"", "fill=\"#00ff00\" transform=\"translate(1,2)\"", 2},
                 {"fill=\"#00ff00\"", "fill=\"#00ff00\" display=\"none\"", 1},
                 {"only\" d=\"M10,20", "only\" d=\"M10,90", 2}};
  for (const auto& change : changes) {
    // A straight line has no area: the fill is bent first, by which it was drawn anew as well.
    Stroke bent = filled_stroke();
    bent.curve.segments[0].points[1].y() = 0.05;
    const DrawingRead read = read_changed(with_stroke(bent), SvgLines::Outlines, change.part, change.other);
    EXPECT_EQ(read.drawing.stroke_count(), change.strokes) << change.other;
    ASSERT_FALSE(read.drawing.layers.empty());
    const Stroke& line = *read.drawing.layers[0].strokes.back();
    EXPECT_EQ(line.fill, std::nullopt) << change.other;
    EXPECT_EQ(line.curve, bent.curve);
    EXPECT_FALSE(read.notes.empty());
  }
}

TEST(SvgOfOthers, TakeTheLineOfAFilledStrokeAway) {
  Stroke bent = filled_stroke();
  bent.curve.segments[0].points[1].y() = 0.05;
  const std::string text = svg_text(with_stroke(bent), SvgLines::Outlines);
  const std::size_t begin = text.find("<path", text.find("<path") + 1), end = text.find("/>", begin) + 2;
  const DrawingRead read =
      read_changed(with_stroke(bent), SvgLines::Outlines, text.substr(begin, end - begin), "");
  ASSERT_EQ(read.drawing.stroke_count(), 1U);
  EXPECT_EQ(read.drawing.layers[0].strokes[0]->fill, (Colour{0.0F, 1.0F, 0.0F}));
  EXPECT_EQ(read.notes.size(), 1U);
}

TEST(SvgOfOthers, WriteTheSamePathInAnotherWay) {
  const auto expect_unchanged = [](const Stroke& stroke, SvgLines lines, const char* path,
                                   const char* other) {
    const DrawingRead read = read_changed(with_stroke(stroke), lines, path, other);
    ASSERT_EQ(read.drawing.stroke_count(), 1U);
    EXPECT_TRUE(read.notes.empty()) << read.notes.front();
    EXPECT_EQ(read.drawing.layers[0].strokes[0]->curve, stroke.curve);
    EXPECT_EQ(read.drawing.layers[0].strokes[0]->fill, stroke.fill);
  };
  const char* const line = "d=\"M10,20 C16.66667,20 23.33333,20 30,20\"";
  const char* const outline = "d=\"M10,21 L30,21 L30,19 L10,19 L10,21 Z\"";
  Stroke flat = plain_stroke(0.002);
  flat.ends = CurveEnds::Flat;
  expect_unchanged(flat, SvgLines::CentreLines, line, "d=\"m 10 20 c 6.667 0 13.333 0 20 0\"");
  expect_unchanged(flat, SvgLines::Outlines, outline, "d=\"M10 21H30V19H10z\"");
  expect_unchanged(filled_stroke(), SvgLines::Outlines, line, "d=\"M10 20H30\"");
  const DrawingRead longer =
      read_changed(with_stroke(flat), SvgLines::Outlines, outline, "d=\"M10 21H31V19H10z\"");
  EXPECT_EQ(longer.notes.size(), 1U);
}

TEST(SvgOfOthers, LoseTheCurveOrItsClosing) {
  Stroke ring = plain_stroke(0.002);
  ring.curve.segments[0] = {
      {Vector2(0.01, 0.02), Vector2(0.05, 0.02), Vector2(0.01, 0.06), Vector2(0.01, 0.02)}};
  ring.curve.closed = true;
  for (const char* other : {"", "icome:closed=\"maybe\""}) {
    const DrawingRead read =
        read_changed(with_stroke(ring), SvgLines::CentreLines, "icome:closed=\"true\"", other);
    ASSERT_EQ(read.drawing.stroke_count(), 1U);
    EXPECT_EQ(read.drawing.layers[0].strokes[0]->curve, ring.curve);
  }
  const DrawingRead lost =
      read_changed(with_stroke(ring), SvgLines::CentreLines, "icome:curve=", "icome:carve=");
  ASSERT_EQ(lost.notes.size(), 1U);
  EXPECT_NE(lost.notes[0].find("icome:curve of a stroke of ICOME is missing: what the path draws is taken"),
            std::string::npos)
      << lost.notes[0];
}

TEST(SvgOfOthers, LeaveTheViewBoxOut) {
  const DrawingRead read =
      read_changed(with_stroke(plain_stroke(0.002)), SvgLines::Outlines, " viewBox=\"0 0 297 210\"", "");
  EXPECT_EQ(read.notes.size(), 1U) << "96 units are an inch then";
  EXPECT_NEAR(read.drawing.layers.at(0).strokes.at(0)->curve.at(0.0).x(), 0.010 * 25.4 / 96.0, 1e-9);
  EXPECT_EQ(read.drawing.size, Vector2(0.297, 0.210));
}

TEST(SvgOfOthers, EmptyWidthsLeaveWhatIsDrawn) {
  for (const SvgLines lines : {SvgLines::Outlines, SvgLines::CentreLines}) {
    const DrawingRead read = read_changed(with_stroke(plain_stroke(0.002)), lines, "icome:widths=\"0,2,1,2\"",
                                          "icome:widths=\"\"");
    ASSERT_EQ(read.notes.size(), 1U);
    EXPECT_NE(read.notes[0].find("icome:widths is empty, but the path draws a line: what the path draws is"),
              std::string::npos)
        << read.notes[0];
    EXPECT_NEAR(read.drawing.bounds().sizes().y(), 0.002, 1e-6);
  }
}

TEST(SvgOfOthers, TakeAllPaintAway) {
  const DrawingRead read = read_changed(with_stroke(plain_stroke(0.002)), SvgLines::CentreLines,
                                        "stroke=\"#000000\"", "stroke=\"none\"");
  EXPECT_EQ(read.drawing.stroke_count(), 0U);
  ASSERT_EQ(read.notes.size(), 1U);
  EXPECT_NE(read.notes[0].find("without line and fill is skipped"), std::string::npos) << read.notes[0];
}

}  // namespace
}  // namespace icome::drawing
