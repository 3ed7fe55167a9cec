#include "study/simulation/route.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace icome::study {
namespace {

using base::Bounds;
using base::Vector3;

double length(Vector3 from, const std::vector<Vector3>& way) {
  double sum = 0.0;
  for (const Vector3& to : way) {
    sum += (to - from).norm();
    from = to;
  }
  return sum;
}

/// The least distance of a way to a box, by going along it in small steps.
double nearest(Vector3 from, const std::vector<Vector3>& way, const Bounds& box) {
  double least = 1e9;
  for (const Vector3& to : way) {
    for (int i = 0; i <= 1000; ++i)
      least = std::min(least, box.exteriorDistance(from + i / 1000.0 * (to - from)));
    from = to;
  }
  return least;
}

TEST(Route, IsStraightWhereNothingIsInTheWay) {
  const auto way = route({0, 0, 0}, {1, 0, 0}, {Bounds(Vector3(0.4, 0.2, -1), Vector3(0.6, 0.4, 1))}, 0.1);
  ASSERT_EQ(way.size(), 1U);
  EXPECT_EQ(way[0], Vector3(1, 0, 0));
}

TEST(Route, GoesRoundABoxOnItsShorterSide) {
  const Bounds box(Vector3(0.4, -0.5, -5), Vector3(0.6, 0.1, 5));
  const auto way = route({0, 0, 0}, {1, 0, 0}, {box}, 0.05);
  EXPECT_GE(way.size(), 2U);
  EXPECT_GE(nearest({0, 0, 0}, way, box), 0.05 - 1e-9);
  for (const Vector3& corner : way) EXPECT_GE(corner.y(), 0.0);  // above it
  EXPECT_LT(length({0, 0, 0}, way), 1.2);
}

TEST(Route, PassesThroughABoxThatHoldsTheGoal) {
  const auto way = route({0, 0, 0}, {1, 0, 0}, {Bounds(Vector3(0.9, -1, -1), Vector3(2, 1, 1))}, 0.1);
  EXPECT_EQ(way.size(), 1U);
}

TEST(Route, ShutInItGoesStraight) {
  std::vector<Bounds> walls;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vector3 low = Vector3::Constant(-2.0), high = Vector3::Constant(2.0);
      low[axis] = side - 0.1;
      high[axis] = side + 0.1;
      walls.emplace_back(low, high);
    }
  EXPECT_EQ(route({0, 0, 0}, {3, 0, 0}, walls, 0.05).size(), 1U);
}

TEST(Route, KeepsClearOfRandomBoxes) {
  base::Random random(7);
  for (int round = 0; round < 200; ++round) {
    std::vector<Bounds> boxes;
    for (int i = 0; i < 6; ++i) {
      const Vector3 middle(random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6), random.uniform(-0.6, 0.6));
      const Vector3 half(random.uniform(0.02, 0.2), random.uniform(0.02, 0.2), random.uniform(0.02, 0.2));
      boxes.emplace_back(middle - half, middle + half);
    }
    const Vector3 from(-1, 0, 0), to(1, 0, 0);
    const auto way = route(from, to, boxes, 0.03);
    EXPECT_EQ(way.back(), to);
    for (const Bounds& box : boxes) EXPECT_GE(nearest(from, way, box), 0.03 - 1e-9) << "round " << round;
  }
}

}  // namespace
}  // namespace icome::study
