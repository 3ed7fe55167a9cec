#include "geometry/curve/cubic_bezier.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::geometry {
namespace {

const CubicBezier kBow = {{Vector2(0, 0), Vector2(0, 1), Vector2(1, 1), Vector2(1, 0)}};

TEST(CubicBezier, RunsFromItsFirstPointToItsLast) {
  EXPECT_EQ(kBow.at(0.0), Vector2(0, 0));
  EXPECT_EQ(kBow.at(1.0), Vector2(1, 0));
  EXPECT_EQ(kBow.at(0.5), Vector2(0.5, 0.75));  // (1 + 3 + 3 + 1) / 8 of the four points
}

TEST(CubicBezier, PartsLieOnTheWhole) {
  const CubicBezier part = kBow.part(0.25, 0.75);
  for (const double t : {0.0, 0.3, 1.0}) EXPECT_LT((part.at(t) - kBow.at(0.25 + 0.5 * t)).norm(), 1e-15);
}

TEST(CubicBezier, BoundsAreThoseOfTheCurveNotOfItsControlPoints) {
  EXPECT_NEAR(kBow.bounds().max().y(), 0.75, 1e-15);
  EXPECT_EQ(kBow.hull_bounds().max().y(), 1.0);
  const CubicBezier line = CubicBezier::line(Vector2(1, 2), Vector2(3, -1));
  EXPECT_EQ(line.bounds().min(), Vector2(1, -1));
  EXPECT_EQ(line.bounds().max(), Vector2(3, 2));
}

TEST(CubicBezier, LengthOfALineAndOfAQuarterCircle) {
  EXPECT_NEAR(CubicBezier::line(Vector2(0, 0), Vector2(3, 4)).length(), 5.0, 1e-12);
  EXPECT_NEAR(CubicBezier::line(Vector2(0, 0), Vector2(3, 4)).length(0.5), 2.5, 1e-12);
  constexpr double kHandle = 0.5522847498307936;
  const CubicBezier quarter = {{Vector2(1, 0), Vector2(1, kHandle), Vector2(kHandle, 1), Vector2(0, 1)}};
  EXPECT_NEAR(quarter.length(), M_PI / 2.0, 3e-4);  // the usual cubic is at most 2.7e-4 outside the circle
}

TEST(CubicBezier, DirectionsOfEndsLookPastEqualControlPoints) {
  const CubicBezier curve = {{Vector2(0, 0), Vector2(0, 0), Vector2(0, 2), Vector2(3, 2)}};
  EXPECT_EQ(curve.start_direction(), Vector2(0, 1));
  EXPECT_EQ(curve.end_direction(), Vector2(1, 0));
  const CubicBezier point = {{Vector2(1, 1), Vector2(1, 1), Vector2(1, 1), Vector2(1, 1)}};
  EXPECT_EQ(point.start_direction(), Vector2(0, 0));
}

}  // namespace
}  // namespace icome::geometry
