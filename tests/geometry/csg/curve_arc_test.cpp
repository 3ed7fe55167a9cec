// Arcs of curves, and where balls touch them, against dense sampling and closed forms.
#include "geometry/csg/curve_arc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace icome::geometry {
namespace {

constexpr double kArcRing = 0.01;  // m, radius of the circle of which arcs are cut

Vector3 on_ring(double angle) { return kArcRing * Vector3(std::cos(angle), std::sin(angle), 0.0); }

/// From `from` to `to` (rad) on the circle.
CurveArc ring_arc(double from, double to) {
  CurveArc::Places places;
  for (int i = 0; i <= CurveArc::kDegree; ++i)
    places[i] = on_ring(0.5 * (from + to) + 0.5 * (to - from) * CurveArc::node(i));
  return CurveArc(places);
}

double densely_sampled(const CurveArc& arc, const Vector3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 2000; ++i) {
    const double s = arc.first() + (arc.last() - arc.first()) * i / 2000.0;
    least = std::min(least, (arc.at(s) - point).norm());
  }
  return least;
}

Vector3 place_in_ball(base::Random& random, double reach) {
  return random.uniform(0.0, reach) * random.direction();
}

TEST(CurveArc, FollowsACircle) {
  const CurveArc arc = ring_arc(0.2, 0.6);
  for (int i = 0; i <= 100; ++i) {
    const double s = -1.0 + 0.02 * i;
    EXPECT_LT((arc.at(s) - on_ring(0.4 + 0.2 * s)).norm(), 1e-12 * kArcRing);
    EXPECT_TRUE(arc.bounds().contains(arc.at(s)));
  }
  EXPECT_GE(arc.sagitta(), kArcRing * (1.0 - std::cos(0.2)));
  EXPECT_LT(arc.sagitta(), 1.3 * kArcRing * (1.0 - std::cos(0.2)));
}

TEST(CurveArc, FindsTheNearestPlace) {
  base::Random random(3);
  const CurveArc whole = ring_arc(0.0, 0.5);
  for (int i = 0; i < 300; ++i) {
    const CurveArc arc = whole.part(random.uniform(-1.0, 0.0), random.uniform(0.0, 1.0));
    const Vector3 point = on_ring(0.2) + place_in_ball(random, 0.008);  // nearer than the middle of the ring
    const double found = (arc.at(arc.nearest(point)) - point).norm();
    const double sampled = densely_sampled(arc, point);  // every 3 um
    EXPECT_LE(found, sampled + 1e-12);
    EXPECT_GT(found, sampled - 2e-6);
    EXPECT_GE(found + 1e-15, arc.least_distance(point, point));
  }
}

TEST(CurveArc, IsTouchedWhereTheDistanceSaysSo) {
  base::Random random(4);
  constexpr double kTouchSlack = 1e-11;
  int touched = 0;
  for (int i = 0; i < 600; ++i) {
    const double angle = random.uniform(0.0, 6.0);
    const CurveArc arc = ring_arc(angle, angle + random.uniform(0.05, 0.5));
    const double radius = std::pow(10.0, random.uniform(-4.0, -1.5));
    const Vector3 start = on_ring(angle) + (radius + random.uniform(0.0, 0.01)) * random.direction();
    if (densely_sampled(arc, start) < radius + 1e-7) continue;
    const Vector3 step = 2.0 * (on_ring(angle) + place_in_ball(random, 0.003) - start);
    const auto touch = arc.first_touch(radius, start, step, kTouchSlack);
    const double end = touch ? touch->t : 1.0;
    for (int k = 0; k <= 30; ++k)  // free until then
      ASSERT_GT(densely_sampled(arc, start + end * k / 30.0 * step), radius - 1e-10) << i;
    if (!touch) continue;
    ++touched;
    const Vector3 there = start + end * step;
    EXPECT_NEAR((arc.at(arc.nearest(there)) - there).norm(), radius, 2e-11) << i;
    EXPECT_NEAR((arc.at(touch->s) - there).norm(), radius, 1e-9) << i;
  }
  EXPECT_GT(touched, 40);
}

TEST(CurveArc, IsTouchedByABallThatSinksIntoItsRingAtOnceAllAround) {
  // All places of the ring are met at the same moment.
  const CurveArc arc = ring_arc(0.0, 0.5);
  const auto touch = arc.first_touch(0.0125, {0.0, 0.0, 0.02}, {0.0, 0.0, -0.02}, 1e-11);
  ASSERT_TRUE(touch);
  EXPECT_NEAR(0.02 - 0.02 * touch->t, 0.0075, 1e-8);
  EXPECT_GE(0.02 - 0.02 * touch->t, 0.0075);
}

TEST(CurveArc, LetsABallThatRestsOnItLeave) {
  const CurveArc line(Vector3(-0.01, 0.0, 0.0), Vector3(0.01, 0.0, 0.0));
  const Vector3 start(0.0, 0.0, 0.002);
  EXPECT_FALSE(line.first_touch(0.002, start, {0.0, 0.001, 0.001}, 1e-11));
  const auto pressed = line.first_touch(0.002, start, {0.0, 0.001, -0.001}, 1e-11);
  ASSERT_TRUE(pressed);
  EXPECT_EQ(pressed->t, 0.0);
}

TEST(SegmentDistance, AgreesWithSampling) {
  base::Random random(5);
  for (int i = 0; i < 100; ++i) {
    const Vector3 a = place_in_ball(random, 1.0), b = place_in_ball(random, 1.0),
                  c = place_in_ball(random, 1.0), d = i % 4 == 0 ? c : place_in_ball(random, 1.0);
    double least = 10.0;
    for (int j = 0; j <= 200; ++j) {
      const Vector3 point = a + j / 200.0 * (b - a);
      const double length = (d - c).squaredNorm();
      const double t = length > 0.0 ? std::clamp((point - c).dot(d - c) / length, 0.0, 1.0) : 0.0;
      least = std::min(least, (c + t * (d - c) - point).norm());
    }
    EXPECT_LE(segment_distance(a, b, c, d), least + 1e-12);
    EXPECT_GT(segment_distance(a, b, c, d), least - 0.006);
  }
}

}  // namespace
}  // namespace icome::geometry
