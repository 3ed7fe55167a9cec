#include "haptics/effects/grip.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/random.h"

namespace icome::haptics {
namespace {

EffectInput grip_at(const Vector3& position, const Vector3& velocity = Vector3::Zero()) {
  EffectInput input;
  input.position = position;
  input.scp = position + Vector3(0.3, -0.2, 0.1);  // something else is touched
  input.velocity = velocity;
  return input;
}

/// One that feels nothing but what a test adds.
GripFeel bare() {
  GripFeel feel;
  feel.holds = true;
  feel.least_pull = feel.most_pull = 0.0;
  return feel;
}

TEST(Grip, IsNotFeltByAnEmptyHand) {
  GripFeel feel;
  feel.weight = Vector3(0, -1, 0);
  EXPECT_EQ(grip_force(feel, grip_at(Vector3(1, 2, 3))), Vector3::Zero());
}

TEST(Grip, PullsBackTheMoreTheFartherByEquation414) {
  GripFeel feel;
  feel.holds = true;
  EXPECT_EQ(pull_back(feel, 0.0), 0.0);
  double before = 0.0;
  for (int i = 1; i <= 3000; ++i) {
    const double pull = pull_back(feel, 1e-4 * i);
    EXPECT_GT(pull, before) << i;
    EXPECT_LT(pull - before, 0.03) << "no click: " << i;
    if (i >= 20) {
      EXPECT_GE(pull, 0.2);  // from 2 mm on
    }
    EXPECT_LE(pull, 1.0);
    before = pull;
  }
  EXPECT_NEAR(pull_back(feel, 0.05), 0.2 + 0.8 * (1.0 - std::exp(-1.0)), 1e-12);
  base::Random random(3);
  feel.start = Vector3(0.1, -0.2, 0.3);
  for (int i = 0; i < 100; ++i) {
    const Vector3 way = random.uniform(0.0, 0.2) * random.direction();
    const Vector3 force = grip_force(feel, grip_at(feel.start + way));
    EXPECT_NEAR((force + pull_back(feel, way.norm()) * way.normalized()).norm(), 0.0, 1e-12);
  }
}

TEST(Grip, HoldsOnALineAndInAPlane) {
  GripFeel feel = bare();
  feel.hold = {.stiffness = 200.0, .damping = 2.0};
  feel.freedom = Vector3::UnitX() * Vector3::UnitX().transpose();
  const EffectInput input = grip_at(Vector3(0.3, 0.01, -0.02), Vector3(1, 0.5, 0));
  EXPECT_NEAR((grip_force(feel, input) - Vector3(0, -3, 4)).norm(), 0.0, 1e-12);
  feel.freedom = base::Matrix3::Identity() - Vector3::UnitY() * Vector3::UnitY().transpose();
  EXPECT_NEAR((grip_force(feel, input) - Vector3(0, -3, 0)).norm(), 0.0, 1e-12);
  // What is pulled back is the way along which it could go.
  feel.least_pull = feel.most_pull = 0.5;
  const Vector3 along = Vector3(0.3, 0, -0.02).normalized();
  EXPECT_NEAR((grip_force(feel, input) - (Vector3(0, -3, 0) - 0.5 * along)).norm(), 0.0, 1e-12);
}

TEST(Grip, FeelsWhereItIsStopped) {
  GripFeel feel = bare();
  feel.hold = {.stiffness = 200.0, .damping = 2.0};
  feel.stops[0] = {Vector3(0, 0.1, 0), Vector3::UnitY()};
  feel.stops[1] = {Vector3(0.2, 0, 0), -Vector3::UnitX()};
  feel.stop_count = 2;
  EXPECT_EQ(grip_force(feel, grip_at(Vector3(0.1, 0.11, 5))), Vector3::Zero());
  EXPECT_NEAR((grip_force(feel, grip_at(Vector3(0.21, 0.08, 0))) - Vector3(-2, 4, 0)).norm(), 0.0, 1e-12);
  const Vector3 place(0, 0.09, 0);
  EXPECT_NEAR(grip_force(feel, grip_at(place, Vector3(0, -0.5, 0))).y(), 3.0, 1e-12);
  EXPECT_NEAR(grip_force(feel, grip_at(place, Vector3(0, 0.5, 0))).y(), 2.0, 1e-12) << "who leaves is free";
  feel.stop_count = 1000;
  EXPECT_TRUE(grip_force(feel, grip_at(place)).allFinite());
}

TEST(Grip, FeelsWeightAndTheWellOfASnap) {
  GripFeel feel = bare();
  feel.weight = Vector3(0, -2, 0);
  feel.well = GripFeel::Well{Vector3(0.01, 0, 0), 0.02, 100.0};
  EXPECT_EQ(grip_force(feel, grip_at(Vector3(1, 1, 1))), Vector3(0, -2, 0));
  // k r (1 - (r/R)^2)^2
  const double pull = 100.0 * 0.01 * 0.75 * 0.75;
  EXPECT_NEAR((grip_force(feel, grip_at(Vector3::Zero())) - Vector3(pull, -2, 0)).norm(), 0.0, 1e-12);
}

TEST(Grip, PullsToALineOrAPlaneAcrossOnly) {
  GripFeel feel = bare();
  const double pull = 100.0 * 0.01 * 0.75 * 0.75;
  const base::Matrix3 along = Vector3::UnitZ() * Vector3::UnitZ().transpose();
  feel.well = GripFeel::Well{Vector3(0.01, 0, 0), 0.02, 100.0, base::Matrix3::Identity() - along};
  EXPECT_NEAR((grip_force(feel, grip_at(Vector3(0, 0, 7))) - Vector3(pull, 0, 0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(grip_force(feel, grip_at(Vector3(0, 0.03, 7))), Vector3::Zero());
  feel.well = GripFeel::Well{Vector3(0, 0, 0.01), 0.02, 100.0, along};
  EXPECT_NEAR((grip_force(feel, grip_at(Vector3(5, -7, 0))) - Vector3(0, 0, pull)).norm(), 0.0, 1e-12);
}

// As a spring that holds it in a plane and a stop may be felt at one place, and the well of a snap with them.
TEST(Grip, NeedsTheMassForAllThatPullsAtOnePlace) {
  GripFeel feel = bare();
  feel.hold = {.stiffness = 1000.0, .damping = 0.0};
  EXPECT_NEAR(grip_mass_needed(feel, 1.0, 1e-3), 0.02, 1e-12);  // K dt^2/m = 0.1
  feel.well = GripFeel::Well{Vector3::Zero(), 0.02, 500.0};
  EXPECT_NEAR(grip_mass_needed(feel, 1.0, 1e-3), 0.025, 1e-12);
  feel.hold.damping = 100.0;
  EXPECT_NEAR(grip_mass_needed(feel, 1.0, 1e-3), 0.4, 0.002) << "a quarter of 2 m/dt is 200 N s/m";
  feel.holds = false;
  EXPECT_EQ(grip_mass_needed(feel, 1.0, 1e-3), 0.0);
}

TEST(Grip, TooHardForTheDeviceLetsItComeToRest) {
  constexpr double kMass = 0.1, kStep = 1e-3;
  for (const SpringSettings& hold : {SpringSettings{.stiffness = 1e6, .damping = kAutomaticDamping},
                                     SpringSettings{.stiffness = 100.0, .damping = 1e6}}) {
    GripFeel feel = bare();
    feel.hold = hold;
    feel.freedom.setZero();
    Vector3 position(0.001, 0, 0), velocity(0, 0.02, 0);
    for (int tick = 0; tick < 3000; ++tick) {
      EffectInput input = grip_at(position, velocity);
      input.device_mass = kMass;
      input.dt = kStep;
      const Vector3 acceleration = grip_force(feel, input) / kMass;
      position += kStep * velocity + 0.5 * kStep * kStep * acceleration;
      velocity += kStep * acceleration;
    }
    EXPECT_LT(velocity.norm(), 1e-5);
  }
}

}  // namespace
}  // namespace icome::haptics
