#include "cutout/calibration/table_colours.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "cutout/drawn_table.h"
#include "own_folder.h"

namespace icome::cutout {
namespace {

constexpr DrawnColour kPaleRed{115, 120, 190};  // which the usual limits take for skin
constexpr DrawnColour kPaleBlue{150, 112, 92};

TableView table_view() { return TableView::whole_frame(640, 480, 640, 480); }

Frame shown_frame(const DrawnColour& table, const DrawnColour& paper, std::uint64_t seed) {
  DrawnTable drawn(table_view(), table);
  drawn.triangle(drawn_triangles(1).triangles[0], {{300, 220}, 0.7}, paper);
  return drawn.frame(4.0, seed);
}

void expect_colour(const std::array<double, 3>& bgr, const DrawnColour& colour) {
  // Noise and the mixed edge brighten dark channels a little.
  EXPECT_NEAR(bgr[0], colour.blue, 3.0);
  EXPECT_NEAR(bgr[1], colour.green, 3.0);
  EXPECT_NEAR(bgr[2], colour.red, 3.0);
}

TEST(TableColours, AreMeasuredWhereTheyAreShown) {
  struct Case {
    DrawnColour table, paper;
  };
  const Case cases[] = {{kTableRed, kPaperBlue}, {kPaleRed, kPaleBlue}, {{25, 20, 90}, {95, 45, 25}}};
  for (const Case& it : cases) {
    const auto colours = measure_colours(shown_frame(it.table, it.paper, 3).view(), table_view());
    ASSERT_TRUE(colours) << colours.error().message;
    expect_colour(colours->table_bgr, it.table);
    expect_colour(colours->triangle_bgr, it.paper);
    EXPECT_EQ(mean_of({*colours, *colours}), *colours);
  }
}

TEST(TableColours, SayWhyTheyCannotBeMeasured) {
  const auto empty = measure_colours(DrawnTable(table_view()).frame(4.0, 1).view(), table_view());
  ASSERT_FALSE(empty);
  EXPECT_NE(empty.error().message.find("nothing on it is bluer"), std::string::npos) << empty.error().message;
  const auto grey = measure_colours(shown_frame({100, 100, 100}, {180, 100, 60}, 1).view(), table_view());
  ASSERT_FALSE(grey);
  EXPECT_NE(grey.error().message.find("cannot be told apart"), std::string::npos) << grey.error().message;
  EXPECT_FALSE(measure_colours(shown_frame(kTableRed, kPaperBlue, 1).view(),
                               TableView::whole_frame(320, 240, 640, 480)));
}

/// Counts the sightings of eight pale triangles by a tracker with that view in a few frames.
std::size_t found_with(const TableView& view, bool follows) {
  const KnownTriangles known = drawn_triangles(8);
  base::Random random(9);
  const auto tracker = make_pose_tracker(known, view, follows);
  std::size_t found = 0;
  for (int number = 0; number < 3; ++number) {
    DrawnTable drawn(table_view(), kPaleRed);
    const auto poses = scattered(known, table_view(), random);
    for (std::size_t i = 0; i < poses.size(); ++i) drawn.triangle(known.triangles[i], poses[i], kPaleBlue);
    const auto seen = tracker->see(drawn.frame(3.0, std::uint64_t(number)).view(), 10.0 * number);
    for (const Sighting& it : *seen)
      found += (it.pose.centroid - poses[it.triangle].centroid).norm() < 1.0 ? 1U : 0U;
  }
  return found;
}

TEST(TableColours, LetTheTrackerFindPaleTriangles) {
  TableView shown = table_view();
  shown.set_colours(measure_colours(shown_frame(kPaleRed, kPaleBlue, 3).view(), table_view()).value());
  for (const bool follows : {false, true}) {
    EXPECT_LT(found_with(table_view(), follows), 6U);
    EXPECT_GE(found_with(shown, follows), 23U);
  }
}

TEST(TableColours, AreKeptWithTheView) {
  const auto folder = own_folder("colours");
  std::filesystem::create_directories(folder);
  const auto file = folder / "view.toml";
  TableView view = table_view();
  view.set_colours(TableColours{{40.25, 35.1, 190.0 / 3.0 + 100.0}, {180, 80.125, 40}});
  ASSERT_TRUE(write_table_view(view, file));
  const auto read = read_table_view(file);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->colours(), view.colours());
  const std::string plain =
      "frame_width = 640\nframe_height = 480\ntable_width_mm = 640\ntable_height_mm = 480\n"
      "pixels_from_mm = [1, 0, 0, 0, 1, 0, 0, 0, 1]\n[colours]\n";
  const auto fault = [&](const std::string& colours) -> std::string {
    std::ofstream(file) << plain << colours;
    const auto bad = read_table_view(file);
    return bad ? "" : bad.error().message;
  };
  EXPECT_NE(fault("table_rgb = [1, 2]\ntriangle_rgb = [40, 80, 180]\n").find("view.toml:7"),
            std::string::npos);
  EXPECT_NE(fault("table_rgb = [190, 35, 40]\n").find("triangle_rgb"), std::string::npos);
  EXPECT_NE(fault("table_rgb = [90, 85, 80]\ntriangle_rgb = [40, 80, 180]\n").find("must be red"),
            std::string::npos);
  EXPECT_EQ(fault("table_rgb = [190, 35, 40]\ntriangle_rgb = [40, 80, 180]\n"), "");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace icome::cutout
