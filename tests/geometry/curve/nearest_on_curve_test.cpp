#include "geometry/curve/nearest_on_curve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "geometry/curve/curve_index.h"

namespace icome::geometry {
namespace {

/// The least distance to many places of the curve, which is never below the true one.
double sampled_distance(const CubicBezier& curve, const Vector2& point, int samples) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= samples; ++i) least = std::min(least, (curve.at(i / double(samples)) - point).norm());
  return least;
}

/// Random curves of the kinds on which root finders fail: straight, doubled back, cusps, loops, points.
class RandomCurves {
 public:
  explicit RandomCurves(unsigned seed) : random_(seed) {}

  Vector2 point() { return {number_(random_), number_(random_)}; }

  CubicBezier next() {
    const Vector2 a = point();
    const Vector2 b = point();
    switch (kind_(random_)) {
      case 0:
        return {{a, b, a, b}};  // an S folded on a line
      case 1:
        return {{a, a, a, a}};  // a point
      case 2:
        return {{a, a, b, b}};  // straight, resting at its ends
      case 3:
        return CubicBezier::line(a, b);
      case 4:
        return {{a, a + (b - a) * 2.0, b - (b - a) * 2.0, b}};  // doubled back twice
      case 5:
        return {{a, b, a + (b - a) * 0.5 + Vector2(0, 1), a}};  // closed
      case 6:
        return {{Vector2(0, 0), Vector2(1, 1), Vector2(0, 1), Vector2(1, 0)}};  // a cusp in the middle
      default:
        return {{a, b, point(), point()}};
    }
  }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> number_{-1.0, 1.0};
  std::uniform_int_distribution<int> kind_{0, 12};
};

TEST(NearestOnCurve, IsNeverFartherThanTheBestOfManySamples) {
  RandomCurves curves(7);
  for (int i = 0; i < 20000; ++i) {
    const CubicBezier curve = curves.next();
    const Vector2 point = curves.point();
    const NearestOnCurve near = nearest_on_curve(curve, point);
    const double sampled = sampled_distance(curve, point, 200);
    EXPECT_LE(std::sqrt(near.distance_squared), sampled + 1e-12) << i;
    EXPECT_NEAR((curve.at(near.t) - point).squaredNorm(), near.distance_squared, 1e-15);
    EXPECT_GE(near.t, 0.0);
    EXPECT_LE(near.t, 1.0);
  }
}

// Seen from its centre a quarter circle by the usual cubic is 1 away at its ends and its middle, 1.000273
// between.
TEST(NearestOnCurve, FindsTheLeastOfSeveralMinima) {
  constexpr double kHandle = 0.5522847498307936;
  const CubicBezier quarter = {{Vector2(1, 0), Vector2(1, kHandle), Vector2(kHandle, 1), Vector2(0, 1)}};
  const NearestOnCurve near = nearest_on_curve(quarter, Vector2(0.001, 0.001));
  EXPECT_NEAR(near.t, 0.5, 1e-6);
  EXPECT_NEAR(std::sqrt(near.distance_squared), 1.0 - 0.001 * std::sqrt(2.0), 1e-9);
}

TEST(NearestOnCurve, KeepsToThePartAskedFor) {
  const CubicBezier line = CubicBezier::line(Vector2(0, 0), Vector2(1, 0));
  EXPECT_DOUBLE_EQ(nearest_on_curve(line, Vector2(0.1, 1.0), 0.25, 0.5).t, 0.25);
  EXPECT_NEAR(nearest_on_curve(line, Vector2(0.4, 1.0), 0.25, 0.5).t, 0.4, 1e-12);
  EXPECT_DOUBLE_EQ(nearest_on_curve(line, Vector2(0.9, 1.0), 0.25, 0.5).t, 0.5);
}

TEST(NearestOnCurve, IsTheSameAThousandTimesAsLarge) {
  RandomCurves curves(8);
  for (int i = 0; i < 2000; ++i) {
    const CubicBezier curve = curves.next();
    const Vector2 point = curves.point();
    CubicBezier large = curve;
    for (Vector2& p : large.points) p *= 1024.0;
    EXPECT_EQ(nearest_on_curve(curve, point).t, nearest_on_curve(large, 1024.0 * point).t);
  }
}

TEST(CurveIndex, FindsWhatAskingEachCurveFinds) {
  RandomCurves curves(9);
  std::vector<CubicBezier> many;
  for (int i = 0; i < 500; ++i) {
    CubicBezier curve = curves.next();
    const Vector2 place = 20.0 * curves.point();
    for (Vector2& p : curve.points) p += place;
    many.push_back(curve);
  }
  const CurveIndex index(many);
  for (int i = 0; i < 2000; ++i) {
    const Vector2 point = 22.0 * curves.point();
    double least = std::numeric_limits<double>::infinity();
    for (const CubicBezier& curve : many)
      least = std::min(least, nearest_on_curve(curve, point).distance_squared);
    CurveIndex::Nearest found;
    ASSERT_TRUE(index.nearest(point, 1e3, found));
    EXPECT_NEAR(std::sqrt(found.on_curve.distance_squared), std::sqrt(least), 1e-12);
    EXPECT_EQ(index.nearest(point, 0.5 * std::sqrt(least), found), false);
  }
}

}  // namespace
}  // namespace icome::geometry
