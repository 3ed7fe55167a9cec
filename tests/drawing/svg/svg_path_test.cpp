#include "drawing/svg/svg_path.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace icome::drawing {
namespace {

using base::Vector2;

std::vector<SvgSubpath> path_of(const char* data) {
  SvgShape read = parse_svg_path(data);
  EXPECT_EQ(read.fault, "");
  return std::move(read.subpaths);
}

std::string path_fault(const char* data) { return parse_svg_path(data).fault; }

TEST(SvgPath, ReadsPackedNumbers) {
  const auto path = path_of("M1.5.5-3e2-4L+1,2");
  ASSERT_EQ(path.size(), 1U);
  ASSERT_EQ(path[0].segments.size(), 2U) << "more points behind M are lines";
  EXPECT_EQ(path[0].segments[0].points[0], Vector2(1.5, 0.5));
  EXPECT_EQ(path[0].segments[0].points[3], Vector2(-300.0, -4.0));
}

TEST(SvgPath, ReadsEveryCommandRelativeAsAbsolute) {
  const auto absolute =
      path_of("M10 10L20 10H30V20C30 30 40 30 40 20S50 10 50 20Q55 30 60 20T70 20A5 5 0 0 1 80 20Z");
  const auto relative = path_of("m10 10l10 0h10v10c0 10 10 10 10 0s10-10 10 0q5 10 10 0t10 0a5 5 0 0110 0z");
  ASSERT_EQ(absolute.size(), 1U);
  ASSERT_EQ(relative.size(), 1U);
  ASSERT_EQ(absolute[0].segments.size(), relative[0].segments.size());
  EXPECT_TRUE(absolute[0].closed);
  for (std::size_t i = 0; i < absolute[0].segments.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_TRUE(absolute[0].segments[i].points[k].isApprox(relative[0].segments[i].points[k])) << i;
  EXPECT_EQ(absolute[0].segments[4].points[1], Vector2(40.0, 10.0)) << "S mirrors the control point 40,30";
  const Vector2 quadratic = absolute[0].segments[5].at(0.5);
  EXPECT_TRUE(quadratic.isApprox(Vector2(55.0, 25.0)))
      << "the middle of a quadratic, exactly: (50+2*55+60)/4";
}

TEST(SvgPath, DrawsArcsOnTheirEllipse) {
  const auto path = path_of("M0 0a40 20 30 1 0 10 10");
  ASSERT_EQ(path.size(), 1U);
  const auto& segments = path[0].segments;
  EXPECT_EQ(segments.back().points[3], Vector2(10.0, 10.0));
  // The large arc passes the far side of the ellipse: its centre is the mean of opposite points.
  double least = 1e9, greatest = 0.0;
  const Eigen::Rotation2Dd back(-M_PI / 6.0);
  Vector2 low(1e9, 1e9), high(-1e9, -1e9);
  for (const auto& segment : segments)
    for (double t = 0.0; t <= 1.0; t += 0.001) {
      const Vector2 place = back * segment.at(t);
      low = low.cwiseMin(place);
      high = high.cwiseMax(place);
    }
  const Vector2 centre = low + Vector2(40.0, 20.0);
  for (const auto& segment : segments)
    for (double t = 0.0; t <= 1.0; t += 0.001) {
      const double radius = (back * segment.at(t) - centre).cwiseQuotient(Vector2(40.0, 20.0)).norm();
      least = std::min(least, radius);
      greatest = std::max(greatest, radius);
    }
  EXPECT_NEAR(high.x() - low.x(), 80.0, 0.01);
  EXPECT_NEAR(least, 1.0, 1e-4);
  EXPECT_NEAR(greatest, 1.0, 1e-4);
}

TEST(SvgPath, ScalesRadiiThatAreTooSmall) {
  const auto path = path_of("M0 0A1 1 0 0 1 10 0");
  const Vector2 middle = path[0].segments[path[0].segments.size() / 2].points[0];
  ASSERT_EQ(path[0].segments.size(), 3U);
  EXPECT_NEAR((middle - Vector2(5.0, 0.0)).norm(), 5.0, 1e-12) << "half a circle of radius 5";
  EXPECT_LT(middle.y(), 0.0) << "sweep 1 is clockwise on a page whose y goes down";
}

TEST(SvgPath, BeginsASubpathBehindZ) {
  const auto path = path_of("M1 1h2v2zl5 5M9 9");
  ASSERT_EQ(path.size(), 2U) << "a move without a line is nothing";
  EXPECT_TRUE(path[0].closed);
  EXPECT_EQ(path[0].segments.size(), 3U);
  EXPECT_EQ(path[1].segments[0].points[0], Vector2(1.0, 1.0)) << "it goes on where the closed one began";
}

TEST(SvgPath, TellsFaults) {
  EXPECT_EQ(path_fault("L1 1"), "the path data begins with 'L'; it must begin with M");
  EXPECT_EQ(path_fault("M1 1L2"), "the path data ends where a number of 'L' is expected");
  EXPECT_EQ(path_fault("M1 1LNaN 2"), "'NaN' stands in the path data where a number of 'L' is expected");
  EXPECT_EQ(path_fault("M1 1L1e999 2"), "'1e999' stands in the path data where a number of 'L' is expected");
  EXPECT_EQ(path_fault("M1 1X"), "the path data has no command 'X'");
  EXPECT_EQ(path_fault("M1 1A1 1 0 2 0 1 1"),
            "'2' stands in the path data where a number of 'A' is expected");
}

TEST(SvgPath, DrawsUpToAFault) {
  EXPECT_TRUE(parse_svg_path("L1 1M2 2L3 3").subpaths.empty()) << "nothing comes before the first command";
  const SvgShape cut = parse_svg_path("M1 1L2 2 3 3C4 4 5 5 6 x M7 7L8 8");
  ASSERT_EQ(cut.subpaths.size(), 1U) << "nothing behind the fault is drawn";
  ASSERT_EQ(cut.subpaths[0].segments.size(), 2U) << "the curve whose point is faulty is left out";
  EXPECT_EQ(cut.subpaths[0].segments[1].points[3], Vector2(3.0, 3.0));
  EXPECT_FALSE(cut.subpaths[0].closed);
}

}  // namespace
}  // namespace icome::drawing
