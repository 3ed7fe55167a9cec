#include "charts/canvas.h"

#include <gtest/gtest.h>

#include <limits>

namespace icome::charts {
namespace {

using base::Vector2;

int dark_pixels(const Image& image) {
  int found = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4) found += image.rgba[i] < 128;
  return found;
}

TEST(Canvas, StillDrawsAfterABrokenText) {
  Canvas canvas(200, 60, 1.0);
  canvas.text({5, 30}, "\xff\xfe", {});
  canvas.fill({100, 10, 20, 20}, {0, 0, 0});
  EXPECT_GE(dark_pixels(canvas.snapshot()), 400);
}

TEST(Canvas, DrawsTheSamePictureAtTwiceTheScale) {
  const auto ink = [](double scale) {
    Canvas canvas(static_cast<int>(200 * scale), static_cast<int>(60 * scale), scale);
    canvas.text({5, 40}, "Surface contact", {22.0, {}, true});
    return dark_pixels(canvas.snapshot());
  };
  EXPECT_GT(ink(1.0), 300);
  EXPECT_NEAR(ink(2.0), 4 * ink(1.0), 0.15 * 4 * ink(1.0));
}

TEST(Canvas, SurvivesLinesThatLeaveThePageByFar) {
  Canvas canvas(100, 100, 1.0);
  const Vector2 line[] = {{-1e300, 50}, {1e300, 50}};
  canvas.line(line, {{0, 0, 0}, 4.0, {}});
  EXPECT_EQ(canvas.snapshot().pixel(50, 50)[0], 0);
}

TEST(Canvas, WritesWhatWasDrawnAsSvg) {
  Canvas canvas = Canvas::of_lines(200, 100);
  EXPECT_EQ(canvas.width(), 200);
  EXPECT_EQ(canvas.height(), 100);
  canvas.fill({10, 20, 30, 40}, {1, 0, 0});
  canvas.text({10, 90}, "time (s)", {});
  const std::string svg = canvas.svg();
  EXPECT_TRUE(svg.starts_with("<?xml")) << svg.substr(0, 60);
  EXPECT_NE(svg.find("viewBox=\"0 0 200 100\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_NE(svg.find("width=\"200px\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_NE(svg.find("fill:rgb(100%,0%,0%)"), std::string::npos);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  EXPECT_EQ(svg.find("font-family"), std::string::npos);
}

/// A square as a loop of straight cubics; clockwise on the page or, if `back`, the other way round.
CubicLoop square(double from, double to, bool back) {
  CubicLoop loop{{{from, from}}};
  const Vector2 corners[] = {{to, from}, {to, to}, {from, to}};
  for (int i = 0; i < 3; ++i) {
    const Vector2 corner = corners[back ? 2 - i : i];
    const Vector2 last = loop.points.back();
    loop.points.insert(loop.points.end(), {last, corner, corner});
  }
  return loop;
}

TEST(Canvas, FillsWhatALoopWindsAroundAndCutsHolesByLoopsTheOtherWayRound) {
  const auto middle = [](bool back) {
    Canvas canvas(100, 100, 1.0);
    const CubicLoop loops[] = {square(10, 90, false), square(30, 70, back)};
    canvas.fill_path(loops, {0, 0, 0});
    EXPECT_EQ(canvas.snapshot().pixel(20, 20)[0], 0);
    EXPECT_EQ(canvas.snapshot().pixel(95, 50)[0], 255);
    return int(canvas.snapshot().pixel(50, 50)[0]);
  };
  EXPECT_EQ(middle(false), 0);
  EXPECT_EQ(middle(true), 255);
}

TEST(Canvas, ThingsInAGroupDoNotShowThroughEachOther) {
  Canvas canvas(30, 10, 1.0);
  canvas.begin_group({0, 0, 20, 10});
  canvas.fill({0, 0, 10, 10}, {1, 0, 0});
  canvas.fill({5, 0, 25, 10}, {0, 0, 1});
  canvas.end_group(0.5);
  const Image image = canvas.snapshot();
  EXPECT_EQ(image.pixel(7, 5)[0], image.pixel(15, 5)[0]);  // no red below the blue
  EXPECT_NEAR(image.pixel(7, 5)[0], 128, 1);
  EXPECT_EQ(image.pixel(25, 5)[0], 255);  // outside the area
}

TEST(Canvas, AClearPageKeepsItsColoursWhereLittleIsDrawn) {
  Canvas canvas = Canvas::clear(20, 10, 1.0);
  canvas.fill({0, 0, 10, 10}, {1.0, 0.5, 0.0, 0.25});
  const Image image = canvas.snapshot();
  EXPECT_EQ(image.pixel(15, 5)[3], 0);
  EXPECT_NEAR(image.pixel(5, 5)[3], 64, 1);
  EXPECT_NEAR(image.pixel(5, 5)[0], 255, 2);
  EXPECT_NEAR(image.pixel(5, 5)[1], 128, 3);
}

TEST(Canvas, WritesTheSamePdfTwice) {
  const auto file = [] {
    Canvas canvas = Canvas::of_pdf(144, 72);
    const CubicLoop loops[] = {square(10, 60, false)};
    canvas.fill_path(loops, {0, 0, 1});
    return canvas.pdf();
  };
  EXPECT_TRUE(file().starts_with("%PDF-"));
  EXPECT_NE(file().find("/MediaBox [ 0 0 144 72 ]"), std::string::npos) << file();
  EXPECT_NE(file().find("20000101"), std::string::npos);
  EXPECT_EQ(file(), file());
}

TEST(Fitted, CutsLongTextWithAnEllipsis) {
  const Canvas canvas(100, 100, 1.0);
  const TextStyle style;
  EXPECT_EQ(fitted(canvas, "short", style, 200.0), "short");
  const std::string cut = fitted(canvas, "a very long name that goes on and on", style, 100.0);
  EXPECT_TRUE(cut.ends_with("\u2026"));
  EXPECT_LE(canvas.text_width(cut, style), 100.0);
}

}  // namespace
}  // namespace icome::charts
