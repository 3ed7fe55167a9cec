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

TEST(NearestOnCurve, IsNoFartherForABadGuess) {
  RandomCurves curves(10);
  for (int i = 0; i < 5000; ++i) {
    const CubicBezier curve = curves.next();
    const Vector2 point = curves.point();
    const double least = nearest_on_curve(curve, point).distance_squared;
    for (const double guess : {0.0, 1e-9, 0.3, 1.0, 7.0})
      EXPECT_NEAR(nearest_on_curve(curve, point, 0.0, 1.0, guess).distance_squared, least, 1e-14) << i;
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

/// Curves of very different sizes, some of which lie on each other, and a point that is far from them, near
/// one of them or on it.
class IndexedScene {
 public:
  explicit IndexedScene(unsigned seed) : random_(seed), curves_(seed) {
    const int count = 1 + int(random_() % 40);
    for (int i = 0; i < count; ++i) {
      CubicBezier curve = curves_.next();
      const double scale = std::pow(10.0, uniform(-4.0, 0.5));
      const Vector2 place = 2.0 * curves_.point();
      for (Vector2& p : curve.points) p = scale * p + place;
      many_.push_back(curve);
      if (random_() % 8 == 0) many_.push_back(curve.reversed());
    }
  }

  const std::vector<CubicBezier>& curves() const { return many_; }

  Vector2 point() {
    const CubicBezier& curve = many_[random_() % many_.size()];
    const Vector2 on = curve.at(uniform(0.0, 1.0));
    switch (random_() % 4) {
      case 0:
        return on;
      case 1:
        return on + 1e-3 * curves_.point();
      case 2:
        return 1e4 * curves_.point();
      default:
        return 3.0 * curves_.point();
    }
  }

  double least_sampled(const Vector2& point, int samples) const {
    double least = std::numeric_limits<double>::infinity();
    for (const CubicBezier& curve : many_) least = std::min(least, sampled_distance(curve, point, samples));
    return least;
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  std::mt19937 random_;
  RandomCurves curves_;
  std::vector<CubicBezier> many_;
};

class IndexedScenes : public testing::TestWithParam<unsigned> {};

TEST_P(IndexedScenes, AnswersAreOnTheCurveAndNoFartherThanManySamples) {
  for (unsigned seed = 100 * GetParam(); seed < 100 * GetParam() + 25; ++seed) {
    IndexedScene scene(seed);
    const CurveIndex index(scene.curves());
    for (int i = 0; i < 8; ++i) {
      const Vector2 point = scene.point();
      CurveIndex::Nearest found;
      ASSERT_TRUE(index.nearest(point, std::numeric_limits<double>::infinity(), found)) << seed;
      const double rounding = 1e-12 * (1.0 + point.norm());
      const double distance = std::sqrt(found.on_curve.distance_squared);
      EXPECT_LE(distance, scene.least_sampled(point, 400) + rounding) << seed;
      EXPECT_EQ(scene.curves()[found.curve].at(found.on_curve.t), found.on_curve.point) << seed;
      EXPECT_NEAR((found.on_curve.point - point).norm(), distance, rounding) << seed;
    }
  }
}
INSTANTIATE_TEST_SUITE_P(Seeds, IndexedScenes, testing::Range(0U, 4U));

TEST(CurveIndex, AnswersWhereSinglePrecisionDoesNotReach) {
  const CubicBezier line = CubicBezier::line(Vector2(0, 0), Vector2(1, 0));
  CurveIndex::Nearest found;
  EXPECT_FALSE(CurveIndex().nearest(Vector2(0, 0), 1.0, found));
  const CurveIndex index(std::vector<CubicBezier>{line, line});
  for (const double far : {1e12, 1e18, 1e100}) {
    ASSERT_TRUE(index.nearest(Vector2(far, far), std::numeric_limits<double>::infinity(), found)) << far;
    EXPECT_EQ(found.on_curve.t, 1.0) << far;
  }
  EXPECT_FALSE(index.nearest(Vector2(0.5, 1e-6), 1e-7, found));
  EXPECT_TRUE(index.nearest(Vector2(0.5, 1e-6), 1.1e-6, found));
  EXPECT_FALSE(index.nearest(Vector2(std::nan(""), 0.0), 1.0, found));
}

}  // namespace
}  // namespace icome::geometry
