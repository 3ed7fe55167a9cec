#include "drawing/outline/outline.h"

#include <gtest/gtest.h>

#include "drawing/outline/painted_region.h"

namespace icome::drawing {
namespace {

using testing::DenseDiscs;
using testing::Windings;

constexpr double kRimTolerance = 2e-6;  // m

Curve curve_of_width(std::vector<CubicBezier> segments, double from_width, double to_width) {
  const auto count = double(segments.size());
  return {std::move(segments), {{0.0, from_width, count, to_width}}, false};
}

Curve straight(double length, double from_width, double to_width) {
  return curve_of_width({CubicBezier::line({0.0, 0.0}, {length, 0.0})}, from_width, to_width);
}

/// Four quarters of a circle around the origin.
Curve round_curve(double radius, double width) {
  const double handle = 0.5522847498 * radius;
  std::vector<CubicBezier> quarters;
  Vector2 from(radius, 0.0);
  for (int i = 0; i < 4; ++i) {
    const Vector2 to(-from.y(), from.x());
    quarters.push_back({{from, from + to * handle / radius, to + from * handle / radius, to}});
    from = to;
  }
  quarters.back().points[3] = quarters.front().points[0];
  Curve curve = curve_of_width(quarters, width, width);
  curve.closed = true;
  return curve;
}

bool painted(const std::vector<OutlinePiece>& pieces, const Vector2& p) {
  return Windings(pieces).around(p) != 0;
}

Bounds2 box_of(const std::vector<OutlinePiece>& pieces) {
  Bounds2 box;
  for (const OutlinePiece& piece : pieces)
    for (const CubicBezier& edge : piece.rim) box.extend(edge.bounds());
  return box;
}

TEST(OutlineOf, AStraightLineIsALoopOfTwoLinesAndTwoHalfCircles) {
  const auto pieces = outline_of(straight(0.01, 0.002, 0.002), CurveEnds::Round, kRimTolerance);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].rim.size(), 6U);
  EXPECT_NEAR(box_of(pieces).min().x(), -0.001, 1e-9);
  EXPECT_NEAR(box_of(pieces).max().x(), 0.011, 1e-9);
  EXPECT_NEAR(box_of(pieces).max().y(), 0.001, 1e-9);
  EXPECT_FALSE(painted(pieces, {-0.0009, 0.0009}));  // the end is round
}

TEST(OutlineOf, FlatEndsStopAtTheLastPoint) {
  const auto pieces = outline_of(straight(0.01, 0.002, 0.002), CurveEnds::Flat, kRimTolerance);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_EQ(pieces[0].rim.size(), 4U);
  EXPECT_EQ(box_of(pieces).min().x(), 0.0);
  EXPECT_EQ(box_of(pieces).max().x(), 0.01);
}

TEST(OutlineOf, AWideningLineTouchesItsDiscsAslant) {
  // The radius grows by 0.2 along 1, so the touching points lie 0.2 r behind the centres.
  const auto pieces = outline_of(straight(0.01, 0.002, 0.006), CurveEnds::Flat, kRimTolerance);
  EXPECT_NEAR(box_of(pieces).min().x(), -0.0002, 1e-9);
  const double touching = 0.001 * std::sqrt(1.0 - 0.04);
  EXPECT_TRUE(painted(pieces, {-0.0001, touching - 2e-6}));
  EXPECT_FALSE(painted(pieces, {-0.0001, touching + 3e-5}));
  EXPECT_EQ(box_of(pieces).max().x(), 0.01);
}

TEST(OutlineOf, ADiscThatOutgrowsItsWayIsAllThatIsSeen) {
  const auto pieces = outline_of(straight(0.001, 0.001, 0.01), CurveEnds::Round, kRimTolerance);
  ASSERT_EQ(pieces.size(), 1U);
  EXPECT_NEAR(box_of(pieces).min().x(), 0.001 - 0.005, 1e-9);
  EXPECT_NEAR(box_of(pieces).max().x(), 0.001 + 0.005, 1e-9);
}

TEST(OutlineOf, APointIsADot) {
  const Curve dot = curve_of_width({CubicBezier::line({0.003, 0.004}, {0.003, 0.004})}, 0.002, 0.002);
  for (const CurveEnds ends : {CurveEnds::Round, CurveEnds::Flat}) {
    const auto pieces = outline_of(dot, ends, kRimTolerance);
    ASSERT_EQ(pieces.size(), 1U);
    EXPECT_NEAR(box_of(pieces).min().x(), 0.002, 1e-9);
    EXPECT_NEAR(box_of(pieces).max().y(), 0.005, 1e-9);
  }
}

TEST(OutlineOf, NothingIsPaintedWithoutWidth) {
  EXPECT_TRUE(outline_of(straight(0.01, 0.0, 0.0), CurveEnds::Round, kRimTolerance).empty());
  EXPECT_TRUE(outline_of({}, CurveEnds::Round, kRimTolerance).empty());
}

TEST(OutlineOf, AClosedCurveHasAnInnerAndAnOuterRim) {
  const auto pieces = outline_of(round_curve(0.01, 0.002), CurveEnds::Round, kRimTolerance);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_FALSE(painted(pieces, {0.0, 0.0}));
  EXPECT_TRUE(painted(pieces, {0.01, 0.0}));
  EXPECT_NEAR(box_of(pieces).max().x(), 0.011, kRimTolerance);
}

TEST(OutlineOf, ACircleThatIsNarrowerThanItsLineHasNoHole) {
  const auto pieces = outline_of(round_curve(0.001, 0.003), CurveEnds::Round, kRimTolerance);
  EXPECT_TRUE(painted(pieces, {0.0, 0.0}));
  EXPECT_TRUE(painted(pieces, {0.0001, 0.0002}));
}

TEST(OutlineOf, CornersAreRoundAndSmoothJoinsAddNothing) {
  const CubicBezier across = CubicBezier::line({0.0, 0.0}, {0.01, 0.0});
  const auto corner =
      outline_of(curve_of_width({across, CubicBezier::line({0.01, 0.0}, {0.01, 0.01})}, 0.002, 0.002),
                 CurveEnds::Flat, kRimTolerance);
  const Vector2 outwards = Vector2(1.0, -1.0).normalized();
  EXPECT_TRUE(painted(corner, Vector2(0.01, 0.0) + 0.000995 * outwards));
  EXPECT_FALSE(painted(corner, Vector2(0.01, 0.0) + 0.001005 * outwards));
  const auto straight_on =
      outline_of(curve_of_width({across, CubicBezier::line({0.01, 0.0}, {0.02, 0.0})}, 0.002, 0.002),
                 CurveEnds::Flat, kRimTolerance);
  ASSERT_EQ(straight_on.size(), 1U);
  EXPECT_EQ(straight_on[0].rim.size(), 6U);
}

TEST(OutlineOf, IsTheUnionOfTheDiscs) {
  // Loops, cusps, lines to and fro, points, widths that jump, fall to zero, grow faster than the curve runs.
  for (std::uint64_t seed = 0; seed < 1000; ++seed) {
    base::Random random(seed);
    const Curve curve = testing::troublesome_curve(random, 0.01);
    const Windings windings(outline_of(curve, CurveEnds::Round, kRimTolerance));
    const DenseDiscs discs(curve);
    for (int i = 0; i < 100; ++i) {
      const Vector2 p = discs.some_point(random, 4.0 * kRimTolerance);
      const double distance = discs.distance(p);
      if (std::abs(distance) <= kRimTolerance) continue;
      const int winding = windings.around(p);
      ASSERT_EQ(winding != 0, distance < 0.0) << "seed " << seed << ", " << distance << " m";
      ASSERT_LE(winding, 0) << "seed " << seed;
    }
  }
}

TEST(OutlineOf, FlatEndsTakeNothingButTheCaps) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    base::Random random(seed);
    const Curve curve = testing::troublesome_curve(random, 0.01);
    const Windings flat(outline_of(curve, CurveEnds::Flat, kRimTolerance));
    const DenseDiscs discs(curve);
    for (int i = 0; i < 100; ++i) {
      const Vector2 p = discs.some_point(random, 4.0 * kRimTolerance);
      const bool inside = discs.distance_within(p) < -kRimTolerance;
      const bool outside = discs.distance(p) > kRimTolerance;
      if (!inside && !outside) continue;
      ASSERT_EQ(flat.around(p) != 0, inside) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace icome::drawing
