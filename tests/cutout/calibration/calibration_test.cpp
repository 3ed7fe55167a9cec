#include "cutout/calibration/calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "cutout/calibration/frame_quality.h"
#include "cutout/calibration/learning.h"
#include "cutout/calibration/sheet.h"
#include "cutout/synth/motion.h"
#include "cutout/synth/synthetic_table.h"
#include "own_folder.h"

namespace icome::cutout {
namespace {

SyntheticOptions table_of(int triangles) {
  SyntheticOptions options;
  options.known = usual_triangles(triangles);
  options.moving = false;
  options.frames = 14;
  return options;
}

/// The greatest distance, in pixels, of what two views make of places all over the table.
double apart_in_pixels(const TableView& one, const TableView& other) {
  double worst = 0;
  for (double x = 20; x < 630; x += 60)
    for (double y = 20; y < 470; y += 50)
      worst = std::max(worst, (one.to_pixel({x, y}) - other.to_pixel({x, y})).norm());
  return worst;
}

// The whole way as a person goes it, against the exact view of the camera that made the pictures.
TEST(Calibration, ByAChessboardFindsLensAndTable) {
  const SyntheticOptions options = table_of(1);
  const SyntheticTable table(options);
  Calibration calibration({});
  for (int i = 0; i < options.frames; ++i) calibration.take(table.make_board(i).frame);
  EXPECT_GE(calibration.sights(), 8U);
  const auto found = calibration.finish();
  ASSERT_TRUE(found) << found.error().message;
  const TableView truth = table.view();
  EXPECT_LT(found->lens_error, 0.3);
  EXPECT_NEAR(found->view.table_width(), 640, 2.0);
  EXPECT_NEAR(found->view.table_height(), 480, 2.0);
  EXPECT_NEAR(found->view.camera_height() / truth.camera_height(), 1.0, 0.01);
  EXPECT_LT(apart_in_pixels(found->view, truth), 1.0);
}

TEST(Calibration, ByCornersAloneSaysWhatItLeavesOut) {
  const SyntheticTable table(table_of(0));
  CalibrationSettings settings;
  settings.table = base::Vector2(640, 480);
  Calibration calibration(settings);
  calibration.take(table.make_empty(0).frame);
  const auto found = calibration.finish();
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_FALSE(found->notes.empty());
  EXPECT_NE(found->notes[0].find("neither the lens nor the thickness"), std::string::npos);
  // The corners are right; in between the lens bends by some pixels.
  EXPECT_LT(apart_in_pixels(found->view, table.view()), 8.0);
}

TEST(Calibration, RefusesTooFewSightsAndNoTable) {
  const SyntheticOptions options = table_of(1);
  const SyntheticTable table(options);
  Calibration few({});
  few.take(table.make_board(0).frame);
  const auto too_few = few.finish();
  ASSERT_FALSE(too_few);
  EXPECT_NE(too_few.error().message.find("needs 4 or more"), std::string::npos) << too_few.error().message;
  Calibration nothing({});
  EXPECT_FALSE(nothing.finish());
  Frame grey;
  grey.width = grey.height = 100;
  grey.bgr.assign(30000, 90);
  nothing.take(grey);
  const auto no_table = nothing.finish();
  ASSERT_FALSE(no_table);
  EXPECT_NE(no_table.error().message.find("no red table is seen"), std::string::npos);
}

TEST(TableCorners, AreFoundBesideHandsAndTriangles) {
  SyntheticOptions options = table_of(6);
  options.hands = true;
  const SyntheticTable table(options);
  const TableView view = table.view();
  const SyntheticTable bare(table_of(0));
  const auto alone = find_table_corners(bare.make_empty(0).frame.view(), &view.lens());
  ASSERT_TRUE(alone) << alone.error().message;
  for (int number = 0; number < 4; ++number) {
    const auto corners = find_table_corners(table.make(number).frame.view(), &view.lens());
    ASSERT_TRUE(corners) << corners.error().message;
    for (std::size_t i = 0; i < 4; ++i)
      EXPECT_LT(((*corners)[i] - (*alone)[i]).norm(), 0.5) << number << " " << i;
  }
}

TEST(ViewFile, KeepsTheViewToTheLastBit) {
  const auto folder = own_folder("view");
  std::filesystem::create_directories(folder);
  const TableView view = SyntheticTable(table_of(1)).view();
  ASSERT_TRUE(write_table_view(view, folder / "view.toml"));
  const auto read = read_table_view(folder / "view.toml");
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->to_pixel({123.25, 321.5}), view.to_pixel({123.25, 321.5}));
  EXPECT_EQ(read->wall_at({10, 20}), view.wall_at({10, 20}));
  EXPECT_EQ(read->table_width(), view.table_width());
  std::ofstream(folder / "bad.toml") << "frame_width = 640\nframe_height = 480\ntable_width_mm = 640\n"
                                        "table_height_mm = 480\npixels_from_mm = [1, 2]\n";
  const auto bad = read_table_view(folder / "bad.toml");
  ASSERT_FALSE(bad);
  EXPECT_NE(bad.error().message.find("bad.toml:5:18: pixels_from_mm must be nine numbers"), std::string::npos)
      << bad.error().message;
  EXPECT_FALSE(read_table_view(folder / "absent.toml"));
  std::filesystem::remove_all(folder);
}

struct Wrong {
  const char* words;
  double light, blur, exposure;
};
class FrameQualities : public testing::TestWithParam<Wrong> {};

TEST_P(FrameQualities, AreToldInWords) {
  SyntheticOptions options = table_of(8);
  options.light = GetParam().light;
  options.blur = GetParam().blur;
  const auto complaints = complaints_of(quality_of(SyntheticTable(options).make(0).frame.view()));
  const std::string wanted = GetParam().words;
  if (wanted.empty()) {
    EXPECT_TRUE(complaints.empty()) << complaints.front();
    return;
  }
  ASSERT_FALSE(complaints.empty()) << wanted;
  EXPECT_EQ(complaints.front().substr(0, wanted.size()), wanted);
}
INSTANTIATE_TEST_SUITE_P(All, FrameQualities,
                         testing::Values(Wrong{"", 1, 0.7, 0}, Wrong{"", 0.5, 1.0, 0},
                                         Wrong{"too dark", 0.05, 0.7, 0}, Wrong{"overexposed", 6, 0.7, 0},
                                         Wrong{"out of focus", 1, 4, 0}));

TEST(FrameQualities, TableThatIsNotRed) {
  Frame frame;
  frame.width = 64;
  frame.height = 48;
  for (int i = 0; i < 64 * 48; ++i) frame.bgr.insert(frame.bgr.end(), {140, 150, 145});
  const auto complaints = complaints_of(quality_of(frame.view()));
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0].rfind("the table is not red", 0), 0U);
}

// A triangle that runs, with the shutter open for 30 ms: its edges across the way are blurred, those along it
// not.
TEST(FrameQualities, BlurByMotion) {
  Frame frame;
  frame.width = 320;
  frame.height = 240;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x) {
      const double across = std::clamp((x - 100) / 14.0, 0.0, 1.0) * std::clamp((220 - x) / 14.0, 0.0, 1.0);
      const double down = std::clamp(y - 60.0, 0.0, 1.0) * std::clamp(180.0 - y, 0.0, 1.0);
      const double blue = across * down;
      frame.bgr.push_back(static_cast<std::uint8_t>(40 + 130 * blue));
      frame.bgr.push_back(50);
      frame.bgr.push_back(static_cast<std::uint8_t>(180 - 150 * blue));
    }
  const auto complaints = complaints_of(quality_of(frame.view()));
  ASSERT_EQ(complaints.size(), 1U);
  EXPECT_EQ(complaints[0].rfind("blurred by motion", 0), 0U) << complaints[0];
}

TEST(Learning, MeasuresATriangleThatIsShown) {
  for (std::size_t which = 0; which < 6; ++which) {
    SyntheticOptions options = table_of(6);
    options.known.triangles = {options.known.triangles[which]};
    const SyntheticTable table(options);
    std::vector<LearntTriangle> measured;
    for (int number = 0; number < 5; ++number) {
      const auto learnt = learn_triangle(table.make(number).frame.view(), table.view());
      ASSERT_TRUE(learnt) << which << " " << number << ": " << learnt.error().message;
      measured.push_back(*learnt);
    }
    const LearntTriangle middle = middle_of(measured);
    EXPECT_NEAR(middle.base_angle, options.known.triangles[0].base_angle, 0.6 * std::numbers::pi / 180)
        << which;
    EXPECT_NEAR(middle.height / options.known.triangles[0].height, 1.0, 0.015) << which;
  }
  const SyntheticTable empty(table_of(0));
  const auto none = learn_triangle(empty.make_empty(0).frame.view(), empty.view());
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no blue triangle"), std::string::npos);
}

TEST(Sheet, HasAChessboardAndAPageOfTriangles) {
  const Sheet sheet = make_sheet({}, usual_triangles(6));
  EXPECT_EQ(sheet.pdf.substr(0, 5), "%PDF-");
  EXPECT_GE(sheet.pages, 2);
  EXPECT_TRUE(sheet.notes.empty());
  EXPECT_EQ(sheet.pdf, make_sheet({}, usual_triangles(6)).pdf);
  const Sheet large = make_sheet({}, {{{"giant", 0.8, 400, ""}}});
  ASSERT_EQ(large.notes.size(), 1U);
  EXPECT_EQ(large.pages, 1);
}

}  // namespace
}  // namespace icome::cutout
