#include "sketch/files/picture.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace icome::sketch {
namespace {

/// A stroke from 20 to 80 mm at y = 30 mm on paper of 100 x 60 mm.
Drawing pictured(const Stroke& look, double width) {
  Drawing drawing;
  drawing.size = {0.1, 0.06};
  Stroke stroke = look;
  stroke.curve.segments = {CubicBezier::line({0.02, 0.03}, {0.08, 0.03})};
  stroke.curve.widths = {{0.0, width, 1.0, width}};
  drawing.layers.push_back({drawing.next_layer_id(), "", true, false, {}});
  drawing.layers[0].strokes.push_back(std::make_shared<const Stroke>(stroke));
  return drawing;
}

PictureOptions pixels_along(int longer_side) {
  PictureOptions options;
  options.longer_side = longer_side;
  return options;
}

PictureOptions pixels_a_mm(double pixels) {
  PictureOptions options;
  options.pixels_per_mm = pixels;
  return options;
}

charts::Image drawn(const Drawing& drawing, const PictureOptions& options) {
  const auto image = draw(drawing, options);
  EXPECT_TRUE(image) << image.error().message;
  return image.value_or(charts::Image{});
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(DrawPicture, ShowsThePaperWhereEverythingLiesOnIt) {
  const charts::Image image = drawn(pictured({}, 0.01), pixels_along(200));
  EXPECT_EQ(image.width, 200);
  EXPECT_EQ(image.height, 120);
  EXPECT_EQ(image.pixel(100, 60)[0], 0);
  EXPECT_EQ(image.pixel(100, 52)[0], 0);    // 4 mm above the middle of a line of 10 mm
  EXPECT_EQ(image.pixel(100, 47)[0], 255);  // 6.25 mm above it
  EXPECT_EQ(image.pixel(100, 47)[3], 255);
}

TEST(DrawPicture, ShowsTheDrawingWhereItLeavesThePaper) {
  Drawing drawing = pictured({}, 0.01);
  drawing.size = {0.05, 0.05};
  const charts::Image image = drawn(drawing, pixels_a_mm(1.0));
  EXPECT_EQ(image.width, 80);  // 60 mm, round ends of 5 and margins of 5 mm
  EXPECT_EQ(image.height, 20);
}

TEST(DrawPicture, IsClearWithoutABackground) {
  PictureOptions clear = pixels_along(200);
  clear.background.reset();
  const charts::Image image = drawn(pictured({}, 0.01), clear);
  EXPECT_EQ(image.pixel(5, 5)[3], 0);
  EXPECT_EQ(image.pixel(100, 60)[3], 255);
}

TEST(DrawPicture, LeavesOutHiddenLayers) {
  Drawing drawing = pictured({}, 0.01);
  drawing.layers[0].visible = false;
  EXPECT_EQ(drawn(drawing, pixels_along(200)).pixel(100, 60)[0], 255);
}

TEST(DrawPicture, FillDoesNotShowThroughItsTranslucentLine) {
  Stroke look;
  look.colour = {0.0F, 0.0F, 1.0F};
  look.fill = Colour{1.0F, 0.0F, 0.0F};
  look.opacity = 0.5;
  Drawing drawing = pictured(look, 0.01);
  Stroke triangle = *drawing.layers[0].strokes[0];
  triangle.curve.segments[0].points = {Vector2(0.02, 0.02), {0.04, 0.06}, {0.06, 0.06}, {0.08, 0.02}};
  drawing.layers[0].strokes[0] = std::make_shared<const Stroke>(triangle);
  const charts::Image image = drawn(drawing, pixels_along(200));
  EXPECT_NEAR(image.pixel(100, 70)[0], 255, 1);  // red below it
  EXPECT_NEAR(image.pixel(100, 70)[1], 128, 1);
  EXPECT_NEAR(image.pixel(100, 98)[0], 128, 1);  // only blue where the line lies on its fill
  EXPECT_NEAR(image.pixel(100, 98)[2], 255, 1);
}

TEST(DrawPicture, RefusesPicturesWithoutPixelsOrWithTooMany) {
  for (const int side : {0, -5, kLongestPictureSide + 1})
    EXPECT_FALSE(draw(pictured({}, 0.01), pixels_along(side)));
  EXPECT_FALSE(draw(pictured({}, 0.01), pixels_a_mm(1e9)));
  Drawing point = pictured({}, 0.0);
  point.size = {0.0, 0.0};
  point.layers.clear();
  EXPECT_FALSE(draw(point, pixels_along(100)));
}

TEST(WritePicture, TakesTheKindFromTheEnding) {
  const Drawing drawing = pictured({}, 0.01);
  const auto folder = std::filesystem::temp_directory_path();
  for (const auto& [ending, start] : {std::pair{".png", "\x89PNG"}, {".pdf", "%PDF"}, {".SVG", "<?xml"}}) {
    const auto path = folder / ("picture-" + std::to_string(getpid()) + ending);
    const auto written = write_picture(drawing, {}, path);
    EXPECT_TRUE(written) << written.error().message;
    EXPECT_TRUE(bytes_of(path).starts_with(start)) << path;
    std::filesystem::remove(path);
  }
  const auto other = write_picture(drawing, {}, folder / "picture.jpg");
  ASSERT_FALSE(other);
  EXPECT_TRUE(other.error().message.ends_with("ends in .png, .pdf or .svg")) << other.error().message;
}

TEST(WritePicture, PdfIsAsLargeAsThePaper) {
  const auto path = std::filesystem::temp_directory_path() / ("paper-" + std::to_string(getpid()) + ".pdf");
  ASSERT_TRUE(write_picture(pictured({}, 0.01), {}, path));
  EXPECT_NE(bytes_of(path).find("/MediaBox [ 0 0 283.46"), std::string::npos);  // 100 mm in points
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace icome::sketch
