// Pulling, smoothing, widths, closing and chaining of curves.
#include <gtest/gtest.h>

#include "drawing/test_drawings.h"
#include "sketch/dense_distance.h"
#include "sketch/tools/connect.h"
#include "sketch/tools/pull.h"
#include "sketch/tools/retouch.h"

namespace icome::sketch {
namespace {

using drawing::judges::random_curve;

double joint_turn(const Curve& curve, std::size_t joint) {
  const Vector2 a = curve.segments[joint == 0 ? curve.segments.size() - 1 : joint - 1].end_direction();
  const Vector2 b = curve.segments[joint].start_direction();
  return std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b)));
}

void expect_whole(const Curve& curve) {
  for (std::size_t i = 1; i < curve.segments.size(); ++i)
    EXPECT_EQ(curve.segments[i].points[0], curve.segments[i - 1].points[3]);
  EXPECT_TRUE(!curve.closed || curve.segments[0].points[0] == curve.segments.back().points[3]);
}

TEST(Pulled, ThePlacePickedGoesWhereItIsPulledWithTheExactRule) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const bool closed = seed % 3 == 0;
    const std::size_t segments = 1 + seed % 4;
    const Curve curve = random_curve(seed, segments, closed);
    std::mt19937 random(seed);
    const double place = std::uniform_real_distribution<double>(0.0, curve.end())(random);
    const Vector2 by(0.02, -0.03);
    const Curve moved = pulled(curve, place, by, PullRule::Exact);
    ASSERT_LT((moved.at(place) - curve.at(place) - by).norm(), 1e-12) << seed;
    expect_whole(moved);
    const std::size_t first = closed && segments > 1 ? 0 : 1;
    for (std::size_t j = first; j < segments; ++j) EXPECT_LT(joint_turn(moved, j), 1e-6) << seed;
  }
}

TEST(Pulled, ThePlacePickedBetweenTheEndsGoesThereWithTheRuleOfTheThesis) {
  for (unsigned seed = 0; seed < 500; ++seed) {
    const Curve curve = random_curve(seed, 1 + seed % 4, seed % 3 == 0);
    const double t = 0.06 + 0.88 * seed / 500.0;
    const double place = double(seed % curve.segments.size()) + t;
    const Curve moved = pulled(curve, place, {0.01, 0.01}, PullRule::Thesis);
    EXPECT_LT((moved.at(place) - curve.at(place) - Vector2(0.01, 0.01)).norm(), 1e-12) << seed;
    expect_whole(moved);
  }
}

TEST(Pulled, NearAnEndTheThesisMovesTheJointWithItsHandles) {
  const Curve curve = random_curve(4, 3);
  const Curve moved = pulled(curve, 1.02, {0.01, 0.0}, PullRule::Thesis);
  for (const auto& [segment, point] : {std::pair{0, 2}, {0, 3}, {1, 0}, {1, 1}}) {
    const Vector2 by = moved.segments[std::size_t(segment)].points[std::size_t(point)] -
                       curve.segments[std::size_t(segment)].points[std::size_t(point)];
    EXPECT_LT((by - Vector2(0.01, 0.0)).norm(), 1e-15);
  }
  EXPECT_EQ(moved.segments[2], curve.segments[2]);
}

TEST(PlaceAlong, IsAsFarAsChordsAddUp) {
  const Curve curve = random_curve(6, 3);
  for (const double length : {0.01, 0.1, -0.05}) {
    const double place = place_along(curve, 1.3, length);
    double sum = 0.0;
    for (int i = 0; i < 20000; ++i)
      sum += (curve.at(1.3 + (place - 1.3) * (i + 1) / 20000.0) - curve.at(1.3 + (place - 1.3) * i / 20000.0))
                 .norm();
    EXPECT_NEAR(sum, std::abs(length), 1e-8);
    EXPECT_EQ(place > 1.3, length > 0.0);
  }
  EXPECT_EQ(place_along(curve, 1.3, 10.0), 3.0);
  EXPECT_EQ(place_along(curve, 1.3, -10.0), 0.0);
}

TEST(WidthChanged, ChangesItsPlaceExactlyAndNothingBeyondItsReach) {
  const Curve curve = random_curve(7, 4);
  const Curve changed = width_changed(curve, 1.7, 2.0, 0.02);
  EXPECT_DOUBLE_EQ(changed.width_at(1.7), 2.0 * curve.width_at(1.7));
  const double begin = place_along(curve, 1.7, -0.02);
  const double end = place_along(curve, 1.7, 0.02);
  for (double at = 0.0; at <= 4.0; at += 0.01) {
    if (at < begin || at > end)
      EXPECT_NEAR(changed.width_at(at), curve.width_at(at), 1e-12) << at;
    else
      EXPECT_GE(changed.width_at(at), curve.width_at(at) - 1e-12) << at;
  }
  EXPECT_EQ(changed.segments, curve.segments);
}

// Large segments: 32 samples of a bow of a metre leave 0.2 mm out.
TEST(Smoothed, StaysWithinItsDistanceOfTheCurveItself) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    Curve curve = random_curve(seed, 1 + seed % 3, seed % 2 == 0);
    for (CubicBezier& segment : curve.segments)
      for (Vector2& point : segment.points) point *= 5.0;
    for (const double distance : {1e-4, 2e-3}) {
      const Curve smooth = smoothed(curve, distance);
      const auto dense = judges::sampled(curve.segments, 2000);
      EXPECT_LE(judges::dense_distance(dense, smooth.segments), distance + 2e-6) << seed;
      EXPECT_EQ(smooth.closed, curve.closed);
      expect_whole(smooth);
    }
  }
}

TEST(ClosedCurve, NearEndsMeetHalfwayAndFarOnesAreJoinedStraight) {
  const Curve curve = random_curve(8, 2);
  const Curve ring = closed(curve, 0.001);
  EXPECT_EQ(ring.segments.size(), 3U);
  EXPECT_LT((ring.at(2.5) - 0.5 * (curve.at(0.0) + curve.at(2.0))).norm(), 1e-15);
  const Curve met = closed(curve, 10.0);
  EXPECT_EQ(met.segments.size(), 2U);
  expect_whole(met);
  EXPECT_LT((met.at(0.0) - 0.5 * (curve.at(0.0) + curve.at(2.0))).norm(), 1e-15);
}

TEST(Chained, KeepsThePlacesAndWidthsOfBoth) {
  const Curve first = random_curve(9, 2);
  const Curve second = random_curve(10, 3);
  const Curve chain = chained(first, second);
  expect_whole(chain);
  EXPECT_EQ(chain.at(1.0), first.at(1.0));
  EXPECT_EQ(chain.at(4.0), second.at(2.0));
  EXPECT_NEAR(chain.width_at(1.2), first.width_at(1.2), 1e-15);
  EXPECT_NEAR(chain.width_at(3.7), second.width_at(1.7), 1e-15);
}

}  // namespace
}  // namespace icome::sketch
