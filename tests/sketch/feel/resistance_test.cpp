#include "sketch/feel/resistance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/random.h"

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
    EXPECT_LE(force, kHardness * length) << length;
    last = force;
  }
  EXPECT_NEAR(resistance(1e-9) / 1e-9, kHardness, 0.1);
}

TEST(ToolForce, OfAPullGoesBackToTheCurve) {
  const ToolGrip grip = {.start = {0.1, 0.2}, .holding = 1.0};
  const Vector2 force = tool_force(grip, Vector2(0.103, 0.196)).force;
  EXPECT_NEAR(force.norm(), resistance(0.005), 1e-12);
  EXPECT_NEAR(force.x() / force.y(), -0.75, 1e-9);
  EXPECT_LT(force.x(), 0.0);
  EXPECT_EQ(tool_force(grip, grip.start).force, Vector2(0.0, 0.0));
}

// A selection that hangs on more of the drawing is harder to move.
TEST(ToolForce, OfAMoveGrowsWithWhatHoldsTheSelection) {
  const auto force = [](double holding) {
    return tool_force({.holding = holding}, Vector2(0.01, 0.0)).force;
  };
  EXPECT_EQ(force(0.0), Vector2(0.0, 0.0));
  EXPECT_LT(force(1.0).norm(), force(3.0).norm());
  EXPECT_NEAR(force(3.0).x(), -resistance(0.03), 1e-15);
}

TEST(ToolForce, OfATurnIsAcrossTheArmAndAgainstTheTurn) {
  const ToolGrip grip = {.start = {0.05, 0.0}, .turned = 0.02};
  const auto at = [&](double angle, double arm) {
    return tool_force(grip, arm * Vector2(std::cos(angle), std::sin(angle))).force;
  };
  const Vector2 force = at(0.1, 0.05);
  EXPECT_NEAR(force.dot(Vector2(std::cos(0.1), std::sin(0.1))), 0.0, 1e-15) << "across the arm";
  EXPECT_LT(force.y(), 0.0);
  // The point held, at 20 mm, would have been moved by a chord of 2 mm.
  EXPECT_NEAR(force.norm(), resistance(0.04 * std::sin(0.05)) * std::cos(0.05), 1e-12);
  EXPECT_NEAR(at(-0.1, 0.05).y(), -force.y(), 1e-15);
  EXPECT_NEAR(at(0.1, 0.1).norm(), 0.5 * force.norm(), 1e-12) << "a torque";
  EXPECT_NEAR(at(0.1, 1e-6).norm(), 0.0, 1e-4) << "none at the centre";
}

TEST(ToolForce, OfAScalingIsAlongTheArm) {
  const ToolGrip grip = {.start = {0.05, 0.0}, .scaled = 0.05};
  EXPECT_NEAR(tool_force(grip, Vector2(0.055, 0.0)).force.x(), -resistance(0.005), 1e-12);
  EXPECT_NEAR(tool_force(grip, Vector2(0.045, 0.0)).force.x(), resistance(0.005), 1e-12);
}

// Thesis 4.16: felt within M only, and without a step where one enters or arrives.
TEST(ToolForce, AnEndAttractsWithoutAStep) {
  constexpr double kWithin = 0.01;
  const ToolGrip grip = {.end = Vector2(0.0, 0.0), .within = kWithin};
  double last = 0.0;
  double greatest = 0.0;
  for (int i = 0; i <= 1200; ++i) {
    const double distance = 1e-5 * i;
    const Vector2 force = tool_force(grip, Vector2(distance, 0.0)).force;
    EXPECT_LE(force.x(), 0.0);
    EXPECT_LT(std::abs(force.x() - last), 0.01) << distance;
    EXPECT_EQ(force.x() < 0.0, distance > 0.0 && distance < kWithin);
    greatest = std::max(greatest, -force.x());
    last = force.x();
  }
  EXPECT_GT(greatest, 0.2);
  const ToolGrip line = {.end = Vector2(0.0, 0.0), .within = kWithin, .free = {0.0, 1.0}};
  EXPECT_EQ(tool_force(line, Vector2(0.002, 0.5)).force, tool_force(line, Vector2(0.002, 0.0)).force);
}

ToolGrip random_grip(base::Random& random) {
  const auto place = [&] { return Vector2(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)); };
  ToolGrip grip = {.start = place(), .centre = place()};
  if (random.index(2) > 0) grip.holding = double(random.index(5));
  if (random.index(2) > 0) grip.turned = random.uniform(0.0, 0.3);
  if (random.index(2) > 0) grip.scaled = random.uniform(0.0, 0.3);
  if (random.index(2) > 0) grip.end = place();
  grip.within = random.uniform(0.001, 0.03);
  grip.softness = random.uniform(0.1, 1.0);
  return grip;
}

TEST(ToolForce, ChangesWithoutAStepAndIsNowhereHarderThanItSays) {
  base::Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const ToolGrip grip = random_grip(random);
    const Vector2 pen(random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15));
    const ToolForce force = tool_force(grip, pen);
    ASSERT_TRUE(force.force.allFinite());
    ASSERT_LE(force.force.norm(), 4.0);
    ASSERT_LE(force.hardness, greatest_hardness(grip) * (1.0 + 1e-9));
    const Vector2 step = 1e-7 * Vector2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    const double change = (tool_force(grip, pen + step).force - force.force).norm();
    // A turn about a place near the pen is across it: its direction changes as quickly as the pen goes round.
    ASSERT_LE(change, 2.0 * greatest_hardness(grip) * step.norm() + 1e-9) << i;
  }
}

TEST(ToolForce, GivesNoEnergyOnClosedWays) {
  base::Random random(4);
  for (int i = 0; i < 200; ++i) {
    ToolGrip grip = random_grip(random);
    grip.softness = 1.0;
    grip.centre = Vector2(0.5, 0.0);  // far away: near it a turn fades, which the effect accounts for
    const Vector2 middle = grip.start + 0.02 * Vector2(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    double work = 0.0, taken = 0.0;
    Vector2 before = middle + Vector2(0.03, 0.0);
    for (int k = 1; k <= 4000; ++k) {
      const double angle = 2.0 * M_PI * k / 4000;
      const Vector2 now = middle + 0.03 * Vector2(std::cos(angle), std::sin(angle));
      const double part = tool_force(grip, 0.5 * (before + now)).force.dot(now - before);
      work += part;
      taken += std::abs(part);
      before = now;
    }
    EXPECT_NEAR(work, 0.0, 1e-3 * taken + 1e-9) << i;
  }
}

}  // namespace
}  // namespace icome::sketch
