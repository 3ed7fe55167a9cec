#include "interaction/mouse_hand.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"

namespace icome::interaction {
namespace {

constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A mouse over a floor (y = 0), seen from 2 m above under some angle (rad, 0: straight down).
MouseHand::Input over_floor(double angle = 0.0, double scale = 1.0) {
  MouseHand::Input input;
  input.ray.origin = scale * Vector3(0.3, 2.0, 0.1);
  input.ray.direction = Vector3(std::sin(angle), -std::cos(angle), 0.0);
  const double distance = scale * 2.0 / std::cos(angle);
  input.picked = PickedPoint{input.ray.origin + distance * input.ray.direction, Vector3::UnitY(), distance};
  input.view_width = 0.8;
  input.distance = scale;
  return input;
}

MouseHand::Input over_air(MouseHand::Input input) {
  input.picked.reset();
  return input;
}

TEST(MouseHand, HoversJustAboveWhatIsUnderTheMouse) {
  for (const double angle : {0.0, 0.7, 1.3}) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
      MouseHand hand;
      const MouseHand::Input input = over_floor(angle, scale);
      const double width = 0.8 * input.picked->distance;
      const Vector3 off = hand.target(input) - input.picked->point;
      EXPECT_NEAR(off.norm(), 0.01 * width, 1e-12 * scale);
      EXPECT_GT(off.y(), 0.007 * width);  // well off the floor
      // Nearly under the mouse: no further aside than above.
      EXPECT_LT((off - off.dot(input.ray.direction) * input.ray.direction).norm(), 0.0072 * width);
    }
  }
}

TEST(MouseHand, PressesStraightDownTheDeeperTheHarder) {
  for (const double pressure : {0.01, 0.5, 1.0}) {
    MouseHand hand;
    MouseHand::Input input = over_floor(0.8);
    input.pressure = pressure;
    const Vector3 expected =
        input.picked->point - Vector3(0.0, pressure * 0.03 * 0.8 * input.picked->distance, 0.0);
    EXPECT_TRUE(hand.target(input).isApprox(expected, 1e-12));
    input.hand = input.picked->point + Vector3(0.0, 0.01, 0.0);  // has arrived
    EXPECT_TRUE(hand.target(input).isApprox(expected, 1e-12));
  }
}

TEST(MouseHand, TheWheelPressesDeeperUntilTheButtonGoesUp) {
  MouseHand hand;
  MouseHand::Input input = over_floor();
  input.pressure = 0.5;
  const double one = hand.target(input).y();
  input.wheel = 2.0;
  const double deeper = hand.target(input).y();
  EXPECT_NEAR(deeper, 2.0 * one, 1e-12);
  input.wheel = 0.0;
  EXPECT_EQ(hand.target(input).y(), deeper);
  input.wheel = -4.0;  // as if let go
  EXPECT_GE(hand.target(input).y(), 0.0);
  input.wheel = 1e300;
  EXPECT_GT(hand.target(input).y(), -0.3);
  input.wheel = 0.0;
  input.pressure = 0.0;
  EXPECT_GT(hand.target(input).y(), 0.0);
  input.pressure = 0.5;
  EXPECT_EQ(hand.target(input).y(), one);
}

TEST(MouseHand, OverNothingItKeepsItsDepth) {
  MouseHand hand;
  const MouseHand::Input floor = over_floor(0.4);
  hand.target(floor);
  MouseHand::Input air = over_air(over_floor(1.0));
  EXPECT_NEAR((hand.target(air) - air.ray.origin).norm(), floor.picked->distance, 1e-12);
  air.pressure = 1.0;
  EXPECT_NEAR((hand.target(air) - air.ray.origin).norm(), floor.picked->distance, 1e-12);
  air.wheel = 3.0;
  EXPECT_NEAR((hand.target(air) - air.ray.origin).norm(), floor.picked->distance * std::pow(1.05, 3.0),
              1e-12);
  // Who goes nearer with the view takes the hand along.
  air.wheel = 0.0;
  const double before = (hand.target(air) - air.ray.origin).norm();
  air.distance *= 0.01;
  EXPECT_NEAR((hand.target(air) - air.ray.origin).norm(), 0.01 * before, 1e-12);
}

TEST(MouseHand, BeforeItTouchedAnythingItIsWhereTheViewLooks) {
  MouseHand hand;
  const MouseHand::Input air = over_air(over_floor(0.2));
  EXPECT_TRUE(hand.target(air).isApprox(air.ray.origin + air.distance * air.ray.direction, 1e-12));
}

TEST(MouseHand, IsLiftedOnItsWayToSomewhereElse) {
  MouseHand hand;
  MouseHand::Input input = over_floor();
  input.pressure = 0.5;
  const double width = 0.8 * input.picked->distance;
  const Vector3 there = input.picked->point;
  input.hand = there;
  const double pressed = hand.target(input).y();
  EXPECT_LT(pressed, 0.0);
  input.hand = there + Vector3(0.029 * width, 0.0, 0.0);  // friction holds it back
  EXPECT_NEAR(hand.target(input).y(), pressed, 1e-12);
  input.hand = there + Vector3(0.2, 0.0, 0.0);
  EXPECT_NEAR(MouseHand().target(input).y(), 0.01 * width, 1e-12);
  double last = pressed;  // and comes down gently
  for (double lag = 0.03; lag < 0.06; lag += 0.001) {
    input.hand = there + Vector3(lag * width, 0.0, 0.0);
    const double height = MouseHand().target(input).y();
    EXPECT_GE(height, last - 1e-12);
    last = height;
  }
}

TEST(MouseHand, OfAMouseThatRestsOnlyEasesThePressOnWhatSlidesAway) {
  MouseHand hand;
  MouseHand::Input input = over_floor();
  input.pressure = 0.5;
  const double width = 0.8 * input.picked->distance;
  const Vector3 there = input.picked->point;
  input.hand = there;
  double last = hand.target(input).y();
  for (int i = 0; i < 200; ++i) {
    // It slides off and comes back, again and again.
    input.hand = there + Vector3(i % 7 < 3 ? 0.2 : 0.0, 0.0, 0.0);
    const double height = hand.target(input).y();
    EXPECT_GE(height, last - 1e-12) << "deeper again";
    EXPECT_LT(height, last + 0.002 * width) << "all of a sudden";
    last = height;
  }
  EXPECT_GT(last, 0.0);
  // Moved on, it presses as always.
  input.picked->point.x() += 0.1;
  input.hand = input.picked->point;
  EXPECT_LT(hand.target(input).y(), -0.01 * width);
}

TEST(MouseHand, TheSameInputsGiveTheSameTargets) {
  MouseHand one, other;
  base::Random random(3);
  for (int i = 0; i < 500; ++i) {
    MouseHand::Input input = over_floor(random.uniform(0.0, 1.3));
    if (random.index(3) == 0) input.picked.reset();
    input.pressure = random.index(2) == 0 ? 0.0 : random.uniform();
    input.wheel = double(random.index(3)) - 1.0;
    EXPECT_EQ(one.target(input), other.target(input));
  }
}

TEST(MouseHand, WhatIsNoNumberDoesNotMoveIt) {
  for (const double bad : {kNoNumber, std::numeric_limits<double>::infinity(), -1e308}) {
    MouseHand hand;
    const MouseHand::Input good = over_floor();
    const Vector3 before = hand.target(good);
    MouseHand::Input input = good;
    input.ray.origin.x() = bad;
    EXPECT_TRUE(hand.target(input).allFinite());
    input = good;
    input.view_width = bad;
    EXPECT_TRUE(hand.target(input).allFinite());
    input = good;
    input.picked->point.y() = bad;
    EXPECT_TRUE(hand.target(input).allFinite());
    input = good;
    input.pressure = input.wheel = bad;
    EXPECT_TRUE(hand.target(input).allFinite());
    input = good;
    input.distance = bad;
    EXPECT_TRUE(hand.target(input).allFinite());
    input = good;
    input.pressure = 0.5;
    input.hand = Vector3::Constant(bad);
    EXPECT_TRUE(hand.target(input).allFinite());
    MouseHand::Input free = good;
    hand.target(free);
    EXPECT_TRUE(std::isinf(bad) || std::isnan(bad) || (hand.target(good) - before).allFinite());
  }
}

TEST(DragPlane, FollowsTheMouseInItsPlane) {
  const Vector3 grasped(0.5, 0.2, -1.0);
  const Vector3 eye(0.0, 0.5, 3.0);
  const Vector3 normal(0.1, 0.3, 2.0);
  const DragPlane plane(grasped, normal);
  EXPECT_LT(plane.moved({eye, (grasped - eye).normalized()})->norm(), 1e-12);
  const Vector3 goal = grasped + normal.cross(Vector3(0.3, -0.2, 0.5));
  EXPECT_TRUE(plane.moved({eye, 7.0 * (goal - eye)})->isApprox(goal - grasped, 1e-12));
}

TEST(DragPlane, BehindTheEyeAndAtTheHorizonThereIsNothing) {
  const DragPlane plane(Vector3::Zero(), Vector3::UnitY());
  const Vector3 eye(0.0, 1.0, 2.0);
  EXPECT_TRUE(plane.moved({eye, Vector3(0.0, -0.1, -1.0)}));
  EXPECT_FALSE(plane.moved({eye, Vector3(0.0, 0.1, -1.0)}));
  EXPECT_FALSE(plane.moved({eye, Vector3(0.0, 0.0, -1.0)}));
  EXPECT_FALSE(plane.moved({eye, Vector3(0.0, -1e-5, -1.0)}));
  EXPECT_FALSE(plane.moved({eye, Vector3(kNoNumber, 0.0, -1.0)}));
  EXPECT_FALSE(DragPlane(Vector3::Zero(), Vector3::Zero()).moved({eye, -Vector3::UnitY()}));
}

TEST(DragPlane, KeepsToALine) {
  const Vector3 grasped(0.5, 0.2, -1.0);
  const Vector3 eye(0.0, 0.5, 3.0);
  DragPlane plane(grasped, Vector3::UnitZ());
  const Vector3 line = Vector3(1.0, 2.0, 0.5);
  plane.keep_to(line);
  const Vector3 goal = grasped + 0.4 * line;
  EXPECT_TRUE(plane.moved({eye, (goal - eye).normalized()})->isApprox(0.4 * line, 1e-12));
  // Beside the line: the place that the ray passes nearest.
  const Vector3 aside = goal + 0.1 * line.cross(goal - eye).normalized();
  EXPECT_TRUE(plane.moved({eye, (aside - eye).normalized()})->isApprox(0.4 * line, 1e-9));
  plane.keep_to(Vector3(grasped - eye));  // straight at the eye: no place is nearest
  const auto along = plane.moved({eye, (grasped - eye).normalized()});
  EXPECT_TRUE(!along || along->allFinite());
  plane.keep_to(std::nullopt);
  EXPECT_NEAR(plane.moved({eye, (goal - eye).normalized()})->z(), 0.0, 1e-12);
}

TEST(DragTurn, GoesRoundWithTheMouse) {
  const Vector3 centre(0.2, 0.1, -1.0), eye(0.0, 0.0, 3.0);
  const Vector3 axis = Vector3(0.2, 0.3, 1.0).normalized(), out = axis.unitOrthogonal();
  const auto ray = [&](double angle, double radius) {
    const Vector3 at = centre + radius * (Eigen::AngleAxisd(angle, axis) * out);
    return Ray{eye, (at - eye).normalized()};
  };
  const DragTurn turn(centre, axis, ray(0.0, 0.1));
  for (const double angle : {0.3, -2.0, 3.0}) EXPECT_NEAR(turn.turned(ray(angle, 0.4)).value(), angle, 1e-9);
  EXPECT_FALSE(turn.turned({eye, (centre - eye).normalized()})) << "the centre is no way round";
  EXPECT_FALSE(turn.turned({eye, Vector3::UnitZ()})) << "behind the eye";
  EXPECT_FALSE(DragTurn(centre, axis, {eye, Vector3::UnitZ()}).turned(ray(1.0, 0.1)));
  EXPECT_FALSE(DragTurn(centre, Vector3::UnitX(), {eye, -Vector3::UnitZ()}).turned(ray(1.0, 0.1)));
}

}  // namespace
}  // namespace icome::interaction
