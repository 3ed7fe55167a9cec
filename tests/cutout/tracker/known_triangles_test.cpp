#include "cutout/tracker/known_triangles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace icome::cutout {
namespace {

constexpr double kOneDegreeOfList = std::numbers::pi / 180.0;

KnownTriangle shape(const char* id, double degrees, double height) {
  return {id, degrees * kOneDegreeOfList, height, ""};
}

bool mentions(const std::vector<std::string>& sentences, const std::string& part) {
  for (const std::string& sentence : sentences)
    if (sentence.find(part) != std::string::npos) return true;
  return false;
}

TEST(KnownTriangles, AreReadAsTheyAreWritten) {
  const KnownTriangles known = {
      {{"fox", 71.3 * kOneDegreeOfList, 80.25, "fox \"head\"\n"}, shape("boat", 40, 55)}};
  const auto read = read_known_triangles(known_triangles_text(known), "list.toml");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->triangles.size(), 2U);
  EXPECT_EQ(read->triangles[0].id, "fox");
  EXPECT_EQ(read->triangles[0].cell, "fox \"head\"\n");
  EXPECT_NEAR(read->triangles[0].base_angle, 71.3 * kOneDegreeOfList, 1e-12);
  EXPECT_NEAR(read->triangles[0].height, 80.25, 1e-12);
  EXPECT_TRUE(read->triangles[1].cell.empty());
}

struct BadList {
  const char* text;
  const char* complaint;
};
class KnownTrianglesBadList : public testing::TestWithParam<BadList> {};

TEST_P(KnownTrianglesBadList, IsRefusedWithItsLine) {
  const auto read = read_known_triangles(GetParam().text, "k.toml");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find(GetParam().complaint), std::string::npos) << read.error().message;
}

INSTANTIATE_TEST_SUITE_P(
    All, KnownTrianglesBadList,
    testing::Values(BadList{"", "k.toml:1:1: there is no triangle"},
                    BadList{"[[triangle]]\nid = 3\n", "k.toml:2:6"},
                    BadList{"[[triangle]]\nid = 'a'\nbase_angle_deg = 91\nheight_mm = 1\n", "k.toml:3:18"},
                    BadList{"[[triangle]]\nid = 'a'\nbase_angle_deg = nan\nheight_mm = 1\n", "k.toml:3:18"},
                    BadList{"[[triangle]]\nid = 'a'\nbase_angle_deg = 40\nheight_mm = -1\n", "k.toml:4:13"},
                    BadList{"[[triangle]]\nid = 'a'\nbase_angle_deg = 40\n", "height_mm is missing"},
                    BadList{"[[triangle]]\nid='a'\nbase_angle_deg=40\nheight_mm=5\nhieght=3\n", "k.toml:5:1"},
                    BadList{"[[triangle]]\nid='a'\nbase_angle_deg=40\nheight_mm=5\n"
                            "[[triangle]]\nid='a'\nbase_angle_deg=50\nheight_mm=5\n",
                            "'a' already, in line 1"},
                    BadList{"triangle = 5\n", "k.toml:1:12"}, BadList{"[[triangle\n", "k.toml:1:"}));

TEST(KnownTriangles, WarnOfSixtyDegreesAndLookAlikes) {
  const KnownTriangles known = {
      {shape("even", 60.5, 70), shape("one", 70, 80), shape("two", 70.9, 81), shape("other", 45, 60)}};
  const auto warnings = warnings_of(known);
  EXPECT_TRUE(mentions(warnings, "'even' has base angles of 60.5"));
  EXPECT_TRUE(mentions(warnings, "'one' and 'two' look alike"));
  EXPECT_FALSE(mentions(warnings, "other"));
}

// Three triangles of half the size, one in each corner, leave a hole in the middle and bound the whole.
TEST(KnownTriangles, WarnOfThreeThatMakeAFourth) {
  const KnownTriangles known = {
      {shape("whole", 70, 100), shape("left", 70, 50), shape("right", 70, 50), shape("top", 70, 50)}};
  EXPECT_TRUE(
      mentions(warnings_of(known), "'left', 'right' and 'top' can lie so that their edges look like"));
  const KnownTriangles shorter = {
      {shape("whole", 70, 100), shape("left", 70, 30), shape("right", 70, 38), shape("top", 70, 34)}};
  EXPECT_TRUE(warnings_of(shorter).empty());
}

// Base angles of 36 and 72 degrees: cut along the bisector of a corner of 72 degrees, the golden triangle
// falls into an acute one and an obtuse one of base angles 36, whose legs are the acute one's.
TEST(KnownTriangles, WarnOfTwoThatMakeAThird) {
  const double leg = 100.0;
  const double base = 2.0 * leg * std::cos(72 * kOneDegreeOfList);
  const KnownTriangles known = {{shape("whole", 72, leg * std::sin(72 * kOneDegreeOfList)),
                                 shape("acute", 72, base * std::sin(72 * kOneDegreeOfList)),
                                 shape("obtuse", 36, base * std::sin(36 * kOneDegreeOfList))}};
  EXPECT_TRUE(mentions(warnings_of(known), "'acute' and 'obtuse', laid together, look like 'whole'"));
}

TEST(KnownTriangles, WarnOfThousandWithinBounds) {
  KnownTriangles known;
  for (int i = 0; i < 1000; ++i) known.triangles.push_back(shape("x", 70, 50 + i % 3));
  EXPECT_EQ(warnings_of(known).size(), 31U);
}

}  // namespace
}  // namespace icome::cutout
