#include "sketch/feel/resistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace icome::sketch {
namespace {

// Thesis 4.14, and its erratum: no click when a curve is taken hold of.
TEST(Resistance, RisesFromNothingAndStaysBetweenTheLimitsOfTheThesis) {
  EXPECT_EQ(resistance(0.0), 0.0);
  double last = 0.0;
  for (double length = 1e-6; length < 10.0; length *= 1.05) {
    const double force = resistance(length);
    EXPECT_GE(force, length < 1.0 ? std::nextafter(last, 1.0) : last) << length;
    EXPECT_GE(force, length >= kFeltFrom ? 0.2 : 0.0) << length;
    EXPECT_LE(force, 1.0) << length;
    last = force;
  }
}

TEST(Resistance, OfAPullGoesBackToTheCurve) {
  const Vector2 force = pull_force({0.003, -0.004});
  EXPECT_NEAR(force.norm(), resistance(0.005), 1e-15);
  EXPECT_NEAR(force.x() / force.y(), -0.75, 1e-12);
  EXPECT_LT(force.x(), 0.0);
  EXPECT_EQ(pull_force({0.0, 0.0}), Vector2(0.0, 0.0));
}

// A selection that hangs on more of the drawing is harder to move.
TEST(Resistance, OfAMoveGrowsWithWhatHoldsTheSelection) {
  const Vector2 move(0.01, 0.0);
  EXPECT_EQ(move_force(move, 0), Vector2(0.0, 0.0));
  EXPECT_LT(move_force(move, 1).norm(), move_force(move, 3).norm());
  EXPECT_LT(move_force(move, 1).x(), 0.0);
}

TEST(Resistance, OfATurnIsAcrossTheArmAndAgainstTheTurn) {
  const std::array<Vector2, 1> held = {Vector2(0.0, 0.02)};
  const Vector2 force = turn_force({0.05, 0.0}, {0.0, 0.0}, 0.1, held);
  EXPECT_NEAR(force.x(), 0.0, 1e-15);
  EXPECT_NEAR(force.y(), -resistance(0.002), 1e-15);  // the point held would have gone 0.1 * 20 mm
  EXPECT_NEAR(turn_force({0.05, 0.0}, {0.0, 0.0}, -0.1, held).y(), resistance(0.002), 1e-15);
}

TEST(Resistance, OfAScalingIsAlongTheArm) {
  const std::array<Vector2, 2> held = {Vector2(0.0, 0.02), Vector2(0.03, 0.0)};
  EXPECT_NEAR(scale_force({0.05, 0.0}, {0.0, 0.0}, 1.1, held).x(), -resistance(0.005), 1e-15);
  EXPECT_NEAR(scale_force({0.05, 0.0}, {0.0, 0.0}, 0.9, held).x(), resistance(0.005), 1e-15);
}

// Thesis 4.16: felt within M only, and without a step where one enters or arrives.
TEST(Resistance, AnEndAttractsWithoutAStep) {
  constexpr double kWithin = 0.01;
  double last = 0.0;
  double greatest = 0.0;
  for (int i = 0; i <= 1200; ++i) {
    const double distance = 1e-5 * i;
    const Vector2 force = connect_force({distance, 0.0}, {0.0, 0.0}, kWithin);
    EXPECT_LE(force.x(), 0.0);
    EXPECT_LT(std::abs(force.x() - last), 0.01) << distance;
    EXPECT_EQ(force.x() < 0.0, distance > 0.0 && distance < kWithin);
    greatest = std::max(greatest, -force.x());
    last = force.x();
  }
  EXPECT_GT(greatest, 0.2);
}

}  // namespace
}  // namespace icome::sketch
