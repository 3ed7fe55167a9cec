#include "animation/picture/stage_picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "animation/picture/small_project.h"
#include "own_folder.h"

namespace icome::animation {
namespace {

constexpr std::uint32_t kRed = 0xffff0000U, kGreen = 0xff00ff00U, kBlue = 0xff0000ffU, kPaper = 0xffffffffU;
constexpr double kQuarterTurn = std::numbers::pi / 2;

/// Four squares: red and green above, blue and clear below.
Pixels quarters(int side) {
  Pixels pixels(side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      pixels.row(y)[x] = y < side / 2 ? (x < side / 2 ? kRed : kGreen) : (x < side / 2 ? kBlue : 0U);
  return pixels;
}

class StagePicture : public testing::Test {
 protected:
  StagePicture() {
    folder_.write_png("quarters.png", quarters(20));
    folder_.write_png("red.png", plain_pixels(20, 20, kRed));
    folder_.write_png("blue.png", plain_pixels(20, 20, kBlue));
  }
  Pixels frame(const FrameOptions& options = {}) {
    return draw_frame(project_, states_by_keys(project_, 0), pictures_, options);
  }
  std::uint32_t pixel(int x, int y, const FrameOptions& options = {}) { return frame(options).row(y)[x]; }
  CellState& rest(std::size_t cell) { return project_.layers[0].cells[cell].rest; }

  TestFolder folder_{own_folder("stage")};
  CellPictures pictures_{folder_.path()};
  Project project_ = small_project(100, 60);
};

TEST_F(StagePicture, PutsThePivotAtThePlace) {
  add_cell(project_, "quarters.png", {10, 10}, {50, 30});
  const Pixels drawn = frame();
  EXPECT_EQ(drawn.row(21)[41], kRed);
  EXPECT_EQ(drawn.row(21)[58], kGreen);
  EXPECT_EQ(drawn.row(38)[41], kBlue);
  EXPECT_EQ(drawn.row(38)[58], kPaper);
  EXPECT_EQ(drawn.row(19)[41], kPaper);
  EXPECT_EQ(drawn.row(40)[41], kPaper);
}

TEST_F(StagePicture, TurnsCounterClockwiseAsSeen) {
  add_cell(project_, "quarters.png", {10, 10}, {50, 30});
  rest(0).angle = kQuarterTurn;
  // The upper right goes to the upper left, the upper left to the lower left.
  const Pixels drawn = frame();
  EXPECT_EQ(drawn.row(24)[44], kGreen);
  EXPECT_EQ(drawn.row(35)[44], kRed);
  EXPECT_EQ(drawn.row(35)[55], kBlue);
  EXPECT_EQ(drawn.row(24)[55], kPaper);
}

TEST_F(StagePicture, LaysFrontLayersLastAndLeavesOutHiddenOnes) {
  add_cell(project_, "red.png", {10, 10}, {50, 30});
  project_.layers.push_back(project_.layers[0]);
  project_.layers[1].id = LayerId{project_.next_id++};
  Cell& front = project_.layers[1].cells[0];
  front.id = CellId{project_.next_id++};
  front.pictures = {"blue.png"};
  EXPECT_EQ(pixel(50, 30), kBlue);
  front.rest.opacity = 0.5;
  EXPECT_EQ(pixel(50, 30), 0xff7f0080U);
  project_.layers[1].visible = false;
  EXPECT_EQ(pixel(50, 30), kRed);
}

TEST_F(StagePicture, ShowsTheSwappedPictureOrNone) {
  add_cell(project_, "red.png", {10, 10}, {50, 30}).pictures.push_back("blue.png");
  rest(0).picture = 1;
  EXPECT_EQ(pixel(50, 30), kBlue);
  for (const int none : {-1, 2}) {
    rest(0).picture = none;
    EXPECT_EQ(pixel(50, 30), kPaper);
  }
}

TEST_F(StagePicture, CameraShowsItsPlaceInTheMiddleZoomedAndTurned) {
  add_cell(project_, "quarters.png", {10, 10}, {30, 20});
  project_.camera.rest.place = {30, 20};
  project_.camera.rest.scale = 2;
  Pixels drawn = frame();
  EXPECT_EQ(drawn.row(12)[32], kRed);  // 2 x 9 px left of and above the middle (50, 30)
  EXPECT_EQ(drawn.row(12)[67], kGreen);
  EXPECT_EQ(drawn.row(8)[32], kPaper);
  // A camera that is turned as a cell is shows it upright.
  project_.camera.rest.angle = kQuarterTurn;
  rest(0).angle = kQuarterTurn;
  drawn = frame();
  EXPECT_EQ(drawn.row(14)[34], kRed);
  EXPECT_EQ(drawn.row(14)[65], kGreen);
  FrameOptions stage;
  stage.through_camera = false;
  EXPECT_EQ(pixel(25, 25, stage), kRed);
}

TEST_F(StagePicture, FitsThePictureThatIsAskedFor) {
  add_cell(project_, "red.png", {10, 10}, {50, 30});
  Pixels tall(50, 100);
  draw_frame(project_, states_by_keys(project_, 0), pictures_, {}, tall);
  EXPECT_EQ(tall.row(50)[25], kRed);
  EXPECT_EQ(tall.row(46)[21], kRed);
  EXPECT_EQ(tall.row(43)[25], kPaper);
}

TEST_F(StagePicture, IsClearWithoutBackground) {
  project_.stage.background = {0.0F, 1.0F, 0.0F};
  add_cell(project_, "red.png", {10, 10}, {50, 30});
  rest(0).opacity = 0.5;
  FrameOptions clear;
  clear.backdrop = Backdrop::None;
  EXPECT_EQ(pixel(0, 0, clear), 0U);
  EXPECT_EQ(pixel(50, 30, clear), 0x80800000U);
  EXPECT_EQ(pixel(0, 0), kGreen);
  FrameOptions page;
  page.backdrop = Backdrop::Stage;
  page.picture_from_stage = Affine2(Eigen::Translation2d(10, 10));
  EXPECT_EQ(pixel(9, 30, page), 0U);
  EXPECT_EQ(pixel(10, 30, page), kGreen);
}

TEST_F(StagePicture, DrawsOnionSkinsFaintlyBelowAndAsOnePicture) {
  add_cell(project_, "red.png", {10, 10}, {50, 30});
  add_cell(project_, "red.png", {10, 10}, {52, 30});
  FrameOptions options;
  OnionSkin before;
  before.states = states_by_keys(project_, 0);
  for (auto& [id, state] : before.states) state.place.x() -= 30;
  before.look = {0.25, {{0.0F, 0.0F, 1.0F}, 1.0}};
  options.onion = {before};
  const Pixels drawn = frame(options);
  EXPECT_EQ(drawn.row(30)[50], kRed);
  EXPECT_EQ(drawn.row(30)[25], 0xffbfbfffU);  // where two cells of the skin lie on each other
  EXPECT_EQ(drawn.row(30)[11], 0xffbfbfffU);  // where one lies alone
}

TEST_F(StagePicture, MissingPicturesAreCrossedFrames) {
  add_cell(project_, "gone.png", {64, 64}, {50, 30});
  const Pixels drawn = frame();
  EXPECT_NE(drawn.row(30)[50], kPaper);
  const auto outline = outline_of(project_.layers[0].cells[0], rest(0), pictures_);
  ASSERT_TRUE(outline);
  EXPECT_EQ((*outline)[2], Vector2(114, 94));  // the pivot is in its middle
  EXPECT_EQ(cell_at(project_, states_by_keys(project_, 0), pictures_, {10, 10}),
            project_.layers[0].cells[0].id);
}

TEST_F(StagePicture, MissingPicturesAreAsLargeAsOthersOfTheirCell) {
  add_cell(project_, "gone.png", {0, 0}, {50, 30}).pictures.push_back("red.png");
  const auto outline = outline_of(project_.layers[0].cells[0], rest(0), pictures_);
  ASSERT_TRUE(outline);
  EXPECT_EQ((*outline)[2], Vector2(70, 50));
  const Pixels drawn = frame();
  EXPECT_NE(drawn.row(31)[51], kPaper);
  EXPECT_EQ(drawn.row(51)[51], kPaper);
}

TEST_F(StagePicture, DrawsNothingOfNonsense) {
  add_cell(project_, "red.png", {10, 10}, {50, 30});
  const Pixels empty = plain_pixels(100, 60, kPaper);
  for (const double value : {std::nan(""), HUGE_VAL, -HUGE_VAL, 1e300}) {
    rest(0) = {};
    rest(0).place.x() = value;
    EXPECT_EQ(frame().words, empty.words);
    rest(0) = {};
    rest(0).place = {50, 30};
    rest(0).angle = value;
    frame();
    rest(0).angle = 0;
    rest(0).scale = value;
    frame();
  }
  EXPECT_FALSE(cell_at(project_, {}, pictures_, {50, 30}));
}

TEST_F(StagePicture, FindsTheTopmostCellThatIsNotClear) {
  add_cell(project_, "red.png", {10, 10}, {50, 30});
  add_cell(project_, "quarters.png", {10, 10}, {50, 30});
  const CellId red = project_.layers[0].cells[0].id, top = project_.layers[0].cells[1].id;
  const auto at = [&](double x, double y) {
    return cell_at(project_, states_by_keys(project_, 0), pictures_, {x, y});
  };
  EXPECT_EQ(at(45, 25), top);
  EXPECT_EQ(at(55, 35), red);  // the clear quarter
  EXPECT_EQ(at(39.9, 30), std::nullopt);
  rest(1).angle = kQuarterTurn;
  EXPECT_EQ(at(55, 35), top);
  EXPECT_EQ(at(55, 25), red);
  rest(1).opacity = 0.05;
  EXPECT_EQ(at(55, 35), red);
  project_.layers[0].locked = true;
  EXPECT_EQ(at(55, 35), std::nullopt);
  EXPECT_EQ(cell_at(project_, states_by_keys(project_, 0), pictures_, {55, 35}, LockedCells::Take), red);
  project_.layers[0].visible = false;
  EXPECT_EQ(cell_at(project_, states_by_keys(project_, 0), pictures_, {55, 35}, LockedCells::Take),
            std::nullopt);
}

TEST_F(StagePicture, OutlinesAreTheCornersOnTheStage) {
  add_cell(project_, "red.png", {0, 0}, {50, 30});
  rest(0).angle = kQuarterTurn;
  rest(0).scale = 2;
  const auto outline = outline_of(project_.layers[0].cells[0], rest(0), pictures_);
  ASSERT_TRUE(outline);
  const std::array<Vector2, 4> expected = {Vector2(50, 30), Vector2(50, -10), Vector2(90, -10),
                                           Vector2(90, 30)};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(((*outline)[i] - expected[i]).norm(), 1e-9);
  rest(0).picture = -1;
  EXPECT_FALSE(outline_of(project_.layers[0].cells[0], rest(0), pictures_));
}

TEST_F(StagePicture, ShrinksFinePatternsToTheirMean) {
  Pixels checks(512, 512);
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 512; ++x) checks.row(y)[x] = (x + y) % 2 == 0 ? 0xff000000U : kPaper;
  folder_.write_png("checks.png", checks);
  add_cell(project_, "checks.png", {256, 256}, {50, 30});
  for (const double scale : {0.08, 0.1, 0.19, 0.3, 0.49}) {
    rest(0).scale = scale;
    for (const double angle : {0.0, 0.3}) {
      rest(0).angle = angle;
      const Pixels drawn = frame();
      for (int y = 25; y < 35; ++y)
        for (int x = 45; x < 55; ++x)
          EXPECT_NEAR(int(drawn.row(y)[x] & 0xffU), 128, 12) << scale << ' ' << angle;
    }
  }
}

}  // namespace
}  // namespace icome::animation
