#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cutout/drawn_table.h"
#include "cutout/tracker/edges/crossings.h"
#include "cutout/tracker/edges/oriented_lines.h"
#include "cutout/tracker/edges/rectifier.h"

namespace icome::cutout {
namespace {

using base::Vector2;

TableView bent_view() {
  const Lens lens{600, 610, 315, 245, -0.2, 0.05, 0.001, -0.001, 0.01};
  base::Matrix3 pixels_from_mm;
  pixels_from_mm << 0.9, 0.05, 30, -0.02, 0.8, 45, 1e-5, -2e-4, 1;
  return TableView::seen_by(lens, pixels_from_mm, 640, 480, 600, 480).value();
}

TEST(TableViewGeometry, GoesThereAndBack) {
  const TableView views[] = {
      TableView::whole_frame(640, 480, 800, 600), bent_view(),
      TableView::by_corners({Vector2(50, 40), Vector2(600, 60), Vector2(630, 470), Vector2(10, 440)}, 640,
                            480, 600, 400)
          .value()};
  base::Random random(1);
  for (const TableView& view : views)
    for (int i = 0; i < 200; ++i) {
      const Vector2 pixel(random.uniform(0, 640), random.uniform(0, 480));
      EXPECT_LT((view.to_pixel(view.to_table(pixel)) - pixel).norm(), 1e-6);
    }
}

TEST(TableViewGeometry, PutsTheCornersWhereTheyAre) {
  const std::array<Vector2, 4> corners = {Vector2(50, 40), Vector2(600, 60), Vector2(630, 470),
                                          Vector2(10, 440)};
  const TableView view = TableView::by_corners(corners, 640, 480, 600, 400).value();
  const std::array<Vector2, 4> mm = {Vector2(0, 0), Vector2(600, 0), Vector2(600, 400), Vector2(0, 400)};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT((view.to_pixel(mm[i]) - corners[i]).norm(), 1e-9);
  // Diagonals cross where diagonals cross: what a homography keeps.
  const Vector2 a = corners[2] - corners[0], b = corners[3] - corners[1], c = corners[1] - corners[0];
  const double t = (c.x() * b.y() - c.y() * b.x()) / (a.x() * b.y() - a.y() * b.x());
  EXPECT_LT((view.to_pixel({300, 200}) - (corners[0] + t * a)).norm(), 1e-9);
  const TableView whole = TableView::whole_frame(640, 480, 320, 240);
  EXPECT_LT((whole.to_table({-0.5, -0.5}) - Vector2(0, 0)).norm(), 1e-12);
  EXPECT_LT((whole.to_table({639.5, 479.5}) - Vector2(320, 240)).norm(), 1e-12);
}

TEST(TableViewGeometry, RefusesCornersThatMakeNoQuadrangle) {
  const Vector2 a(50, 40), b(600, 60), c(630, 470), d(10, 440);
  EXPECT_FALSE(TableView::by_corners({a, d, c, b}, 640, 480, 600, 400).has_value());  // the other way round
  EXPECT_FALSE(TableView::by_corners({a, b, d, c}, 640, 480, 600, 400).has_value());  // crossed
  EXPECT_FALSE(TableView::by_corners({a, a, c, d}, 640, 480, 600, 400).has_value());
  EXPECT_FALSE(TableView::seen_by({}, base::Matrix3::Zero(), 640, 480, 600, 400).has_value());
}

TEST(Rectifier, IsWhatTheViewIs) {
  const TableView view = bent_view();
  const Rectifier rectifier(view);
  base::Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const Vector2 pixel(random.uniform(0, 639), random.uniform(0, 479));
    EXPECT_LT((rectifier.to_table(pixel.x(), pixel.y()) - view.to_table(pixel)).norm(), 0.03);
  }
  // A square millimetre seen by an independent way: the area of its corners in the frame.
  const Vector2 at(300, 240);
  const Vector2 right = view.to_pixel(at + Vector2(0.5, 0)) - view.to_pixel(at - Vector2(0.5, 0));
  const Vector2 down = view.to_pixel(at + Vector2(0, 0.5)) - view.to_pixel(at - Vector2(0, 0.5));
  EXPECT_NEAR(rectifier.mm_per_pixel(at), 1 / std::sqrt(right.x() * down.y() - right.y() * down.x()), 0.01);
}

TEST(ColourClasses, TellTheTableTheTrianglesAndHandsApart) {
  const ColourClasses colours;
  const auto class_of = [&](int blue, int green, int red) {
    const std::uint8_t bgr[3] = {std::uint8_t(blue), std::uint8_t(green), std::uint8_t(red)};
    return colours.of(bgr);
  };
  for (const double light : {1.0, 0.7, 0.45, 0.3}) {
    const auto lit = [&](int blue, int green, int red) {
      return class_of(int(light * blue), int(light * green), int(light * red));
    };
    EXPECT_EQ(lit(40, 35, 190), ColourClass::Red) << light;
    EXPECT_EQ(lit(180, 80, 40), ColourClass::Blue) << light;
    EXPECT_EQ(lit(130, 160, 215), ColourClass::Skin) << light;
    EXPECT_EQ(lit(60, 85, 140), ColourClass::Skin) << light;
    EXPECT_EQ(lit(200, 205, 210), ColourClass::Other) << light;
  }
  EXPECT_EQ(class_of(8, 5, 12), ColourClass::Other);
}

TEST(ColourClasses, AdaptToATableThatIsPaler) {
  ColourClasses colours;
  const double table[3] = {130, 120, 190}, triangle[3] = {170, 120, 100};
  const std::uint8_t pale[3] = {130, 120, 190};
  EXPECT_NE(colours.of(pale), ColourClass::Red);
  ASSERT_TRUE(colours.adapt(table, triangle));
  EXPECT_EQ(colours.of(pale), ColourClass::Red);
  EXPECT_EQ(colours.threshold(), 5);
  // A grey table could not be told from anything.
  const double grey[3] = {100, 100, 110};
  EXPECT_FALSE(colours.adapt(grey, triangle));
  EXPECT_EQ(colours.of(pale), ColourClass::Red);
}

TEST(Crossings, LieOnTheCircleWithNormalsInwards) {
  const TableView view = TableView::whole_frame(640, 480, 640, 480);
  const Vector2 centre(300.3, 220.8);
  const double radius = 90;
  DrawnTable table(view);
  table.disc(centre, radius, kPaperBlue);
  const Frame frame = table.frame(3, 1);
  std::vector<EdgePoint> points;
  Crossings().find(frame.view(), ColourClasses(), Rectifier(view), Claims(640, 480), points);
  ASSERT_GT(points.size(), 450U);  // 4 sqrt(2) r, but for the 45 degrees where it is either
  double mean_turn = 0, worst = 0;
  std::array<double, 8> radial{};  // by eighths of the circle
  std::array<int, 8> counts{};
  for (const EdgePoint& point : points) {
    const Vector2 out = point.place - centre;
    const double off = out.norm() - radius;
    worst = std::max(worst, std::abs(off));
    mean_turn += std::acos(std::clamp(-out.normalized().dot(point.normal), -1.0, 1.0));
    const double angle = std::atan2(out.y(), out.x()) + std::numbers::pi;
    const std::size_t eighth = std::min(std::size_t(angle / (std::numbers::pi / 4)), std::size_t(7));
    radial[eighth] += off;
    ++counts[eighth];
    EXPECT_NEAR(
        std::remainder(std::atan2(point.normal.y(), point.normal.x()) - point.angle, 2 * std::numbers::pi), 0,
        1e-12);
  }
  EXPECT_LT(worst, 0.5);
  EXPECT_LT(mean_turn / double(points.size()), 0.06);
  for (std::size_t i = 0; i < 8; ++i) EXPECT_LT(std::abs(radial[i] / counts[i]), 0.12) << i;
}

TEST(Crossings, SkipWhatIsClaimed) {
  const TableView view = TableView::whole_frame(320, 240, 320, 240);
  DrawnTable table(view);
  table.disc({160, 120}, 50, kPaperBlue);
  const Frame frame = table.frame(2, 1);
  Claims claims(320, 240);
  for (int y = 0; y < 240; y += 2)
    for (int x = 0; x < 160; x += 2) claims.take({double(x), double(y)});
  std::vector<EdgePoint> points;
  Crossings().find(frame.view(), ColourClasses(), Rectifier(view), claims, points);
  ASSERT_GT(points.size(), 100U);
  for (const EdgePoint& point : points) EXPECT_GT(point.place.x(), 159);
}

TEST(Crossings, LeaveOutBlueBesideSkinAndStayWithinTheirBound) {
  const TableView view = TableView::whole_frame(640, 480, 640, 480);
  DrawnTable table(view, kHandSkin);
  table.disc({300, 220}, 90, kPaperBlue);
  std::vector<EdgePoint> points;
  Crossings crossings;
  crossings.find(table.frame(2, 1).view(), ColourClasses(), Rectifier(view), Claims(640, 480), points);
  EXPECT_TRUE(points.empty());
  // Stripes 8 pixels apart have more edges than are kept.
  const TableView wide = TableView::whole_frame(1000, 1000, 1000, 1000);
  Frame stripes;
  stripes.width = stripes.height = 1000;
  stripes.bgr.assign(3'000'000, 30);
  for (std::size_t i = 0; i < 1'000'000; ++i) stripes.bgr[3 * i + (i % 1000 / 8 % 2 ? 0 : 2)] = 200;
  crossings.find(stripes.view(), ColourClasses(), Rectifier(wide), Claims(1000, 1000), points);
  EXPECT_LE(points.size(), Crossings::kMost);
  EXPECT_GT(points.size(), Crossings::kMost / 2);
}

TEST(OrientedLines, FindsThePiecesOfAnEdgeAndTheirSides) {
  // Made points: an edge in two pieces, one that runs back beside it, and scatter.
  base::Random random(6);
  for (int round = 0; round < 10; ++round) {
    const double angle = random.uniform(0, 2 * std::numbers::pi), offset = random.uniform(-100, 100);
    const Vector2 normal(std::cos(angle), std::sin(angle)), along(normal.y(), -normal.x());
    std::vector<EdgePoint> points;
    const auto add = [&](const Vector2& place, double turn) {
      EdgePoint point;
      point.place = place;
      point.angle = std::fmod(turn + 4 * std::numbers::pi, 2 * std::numbers::pi);
      point.normal = {std::cos(turn), std::sin(turn)};
      points.push_back(point);
    };
    const auto off = [&] { return random.uniform(-0.2, 0.2); };
    for (int i = 0; i < 40; ++i) add((offset + off()) * normal + i * along, angle + 0.3 * off());
    for (int i = 70; i < 100; ++i) add((offset + off()) * normal + i * along, angle + 0.3 * off());
    for (int i = 0; i < 100; ++i)
      add((offset - 6 + off()) * normal + i * along, angle + std::numbers::pi + 0.3 * off());
    for (int i = 0; i < 60; ++i)
      add({random.uniform(-200, 200), random.uniform(-200, 200)}, random.uniform(0, 2 * std::numbers::pi));
    std::vector<EdgeSegment> segments;
    OrientedLines().find(points, 1, segments);
    ASSERT_GE(segments.size(), 3U);
    EXPECT_NEAR(segments[0].offset, 6 - offset, 0.3);  // the one that runs back is the longest
    EXPECT_NEAR(segments[0].length(), 99, 3);
    int pieces = 0;
    for (const EdgeSegment& segment : segments) {
      if (segment.normal.dot(normal) < 0.99 || segment.points < 20) continue;
      ++pieces;
      EXPECT_NEAR(segment.offset, offset, 2.5);  // at the foot of the normal, far from the points
      EXPECT_NEAR(normal.dot(segment.middle()), offset, 0.2);
      const bool first = along.dot(segment.middle()) < 55;
      EXPECT_NEAR(along.dot(segment.middle()), first ? 19.5 : 84.5, 2);
      EXPECT_NEAR(segment.length(), first ? 39 : 29, 3);
    }
    EXPECT_EQ(pieces, 2);
  }
}

}  // namespace
}  // namespace icome::cutout
