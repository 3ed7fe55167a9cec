#include "animation/motion/way.h"

#include <gtest/gtest.h>

#include "animation/motion/cell_point.h"
#include "animation/motion/scenes.h"
#include "repeats.h"

namespace icome::animation {
namespace {

using namespace scenes;

std::vector<Vector2> random_way(base::Random& random, int places, double size) {
  std::vector<Vector2> way;
  for (int k = 0; k < places; ++k) {
    way.emplace_back(random.uniform(-size, size), random.uniform(-size, size));
    if (random.index(5) == 0) way.push_back(way.back());
  }
  return way;
}

std::vector<Vector2> circle(double radius, int places) {
  std::vector<Vector2> way;
  for (int k = 0; k < places; ++k)
    way.emplace_back(radius * std::cos(2 * M_PI * k / places), -radius * std::sin(2 * M_PI * k / places));
  return way;
}

TEST(Way, FindsTheNearestPlaceAsTryingAllDoes) {
  base::Random random(3);
  for (int k = 0; k < repeats(4000); ++k) {
    const std::vector<Vector2> places = random_way(random, 1 + int(random.index(12)), 100);
    const bool closed = random.index(2) == 0;
    const Way way(places, closed);
    const Vector2 place(random.uniform(-150, 150), random.uniform(-150, 150));
    EXPECT_NEAR((way.at(way.nearest(place)) - place).norm(), distance_from(places, closed, place), 1e-9);
  }
}

TEST(Way, SlidesNeverAwayAndToAPlaceThatNoStepBetters) {
  base::Random random(4);
  for (int k = 0; k < repeats(4000); ++k) {
    const std::vector<Vector2> places = random_way(random, 3 + int(random.index(12)), 100);
    const Way way(places, random.index(2) == 0);
    const Vector2 hand(random.uniform(-150, 150), random.uniform(-150, 150));
    const double from = random.uniform(0, way.length());
    const double to = way.slid(from, hand);
    const double distance = (way.at(to) - hand).norm();
    EXPECT_LE(distance, (way.at(from) - hand).norm() + 1e-9);
    for (const double step : {-1e-3, 1e-3})
      EXPECT_GE((way.at(way.within(to + step)) - hand).norm(), distance - 1e-9);
    const double in_a_frame = way.slid_in_a_frame(from, hand);
    EXPECT_LE((way.at(in_a_frame) - hand).norm(), (way.at(from) - hand).norm() + 1e-9);
  }
}

TEST(Way, StaysOnItsBranch) {
  // A hairpin whose branches are 10 px apart.
  const std::vector<Vector2> hairpin = {{0, 0}, {100, 0}, {100, 10}, {0, 10}};
  const Way way(hairpin, false);
  EXPECT_NEAR(way.slid(20, {20, 9}), 20, 1e-9) << "nearer to the other branch";
  EXPECT_NEAR(way.nearest({20, 9}), 190, 1e-9);
}

TEST(Way, SlidesLittleWhereLittlePulls) {
  const Way way(circle(100, 360), true);
  // The hand goes through the centre, from above to below, 1 px beside it.
  double s = way.nearest({1, -100}), largest = 0;
  for (int k = 0; k <= 200; ++k) {
    const double next = way.slid_in_a_frame(s, {1, -100 + double(k)});
    largest = std::max(largest, std::abs(way.between(s, next)));
    s = next;
  }
  for (int k = 0; k < 20; ++k) s = way.slid_in_a_frame(s, {1, 100});
  EXPECT_NEAR(way.at(s).y(), 100, 0.1) << "it came round";
  EXPECT_LT(largest, 200);
}

TEST(Way, KeepsUpWithAHandOnIt) {
  // 30 px a frame along a way with sharp corners.
  const std::vector<Vector2> zigzag = {{0, 0}, {70, 0}, {70, 80}, {150, 80}, {100, 0}, {200, 0}};
  const Way way(zigzag, false);
  double s = 0;
  for (double hand = 0; hand < way.length(); hand += 7.3) {
    s = way.slid_in_a_frame(s, way.at(hand));
    EXPECT_LT((way.at(s) - way.at(hand)).norm(), 7.4) << hand;
  }
}

TEST(Way, TurnsAsItRunsAndEvenlyAtCorners) {
  const Way way(std::vector<Vector2>{{0, 0}, {200, 0}, {200, -200}}, false);  // right, then up
  EXPECT_NEAR(way.angle(100), 0, 1e-12);
  EXPECT_NEAR(way.angle(200), M_PI / 4, 1e-12) << "half at the corner";
  EXPECT_NEAR(way.angle(300), M_PI / 2, 1e-12);
  double last = way.angle(0);
  for (double s = 0.1; s < 400; s += 0.1) {
    const double angle = way.angle(s);
    EXPECT_LE(std::abs(angle - last), 0.1 * M_PI / 2 / Way::kCorner + 1e-12);
    last = angle;
  }
}

TEST(Way, CountsTurnsOfAClosedWay) {
  const Way way(circle(300, 720), true);
  for (const double s : {10.0, 400.0, 1000.0, 1880.0})
    EXPECT_NEAR(way.angle(s), M_PI / 2 + s / 300, 5e-3) << "counter-clockwise from the right";
}

TEST(Way, HasNoTroubleWithPlacesThatAreOne) {
  const Way point(std::vector<Vector2>{{3, 4}, {3, 4}, {3, 4}}, true);
  EXPECT_EQ(point.at(point.nearest({7, 7})), Vector2(3, 4));
  EXPECT_EQ(point.slid(0, {9, 9}), 0);
  EXPECT_EQ(point.angle(0), 0);
  EXPECT_TRUE(Way({}, false).is_empty());
}

}  // namespace
}  // namespace icome::animation
