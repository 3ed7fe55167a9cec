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

}  // namespace
}  // namespace icome::drawing
