#include "haptics/effects/energy_tank.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace icome::haptics {
namespace {

const Vector3 kForce(1, 0, 0);
const Vector3 kWay(1e-3, 0, 0);

/// A tick in which `share` of what was given acted.
void after_tick(EnergyTank& tank, const Vector3& way, double share = 1.0) {
  tank.acts(share);
  tank.settle(way);
}

TEST(EnergyTank, GivesNothingBeforeItHasTaken) {
  EnergyTank tank;
  after_tick(tank, kWay);
  EXPECT_EQ(tank.give(kForce), Vector3::Zero());
  EXPECT_EQ(tank.give(-kForce), -kForce) << "what resists is never held back";
}

TEST(EnergyTank, GivesBackJustWhatItHasTaken) {
  EnergyTank tank;
  after_tick(tank, kWay);
  for (int i = 0; i < 10; ++i) {
    tank.give(-kForce);
    after_tick(tank, kWay);
  }
  EXPECT_NEAR(tank.stored(), 10e-3, 1e-15);
  double given = 0.0;
  for (int i = 0; i < 100; ++i) {
    given += tank.give(0.3 * kForce).dot(kWay);
    after_tick(tank, kWay);
  }
  EXPECT_NEAR(given, 10e-3, 1e-15);
}

TEST(EnergyTank, CountsWhatTheLimiterLetThrough) {
  EnergyTank tank;
  tank.give(-kForce);
  after_tick(tank, kWay, 0.25);
  EXPECT_NEAR(tank.stored(), 0.25e-3, 1e-15);
}

TEST(EnergyTank, CountsTheWorstOfTicksInWhichTheDeviceWasSilent) {
  for (const double sign : {1.0, -1.0}) {
    EnergyTank tank;
    for (int i = 0; i < 10; ++i) {
      tank.give(-kForce);
      after_tick(tank, kWay);
    }
    tank.give(sign * kForce);
    for (const double share : {0.5, 1.0, 0.25}) tank.acts(share);
    tank.settle(3.0 * kWay);
    // Nobody knows in which of the three ticks the tip went: what gives may have given all of it, what takes
    // may have taken a quarter.
    EXPECT_NEAR(tank.stored(), 10e-3 + (sign > 0.0 ? -3e-3 : 0.75e-3), 1e-15);
  }
}

TEST(EnergyTank, HoldsNoMoreThanAFacetNeeds) {
  EnergyTank tank;
  for (int i = 0; i < 1000; ++i) {
    tank.give(-kForce);
    after_tick(tank, kWay);
  }
  EXPECT_DOUBLE_EQ(tank.stored(), EnergyTank::kMost);
  double given = 0.0;
  for (int i = 0; i < 1000; ++i) {
    given += tank.give(kForce).dot(kWay);
    after_tick(tank, kWay);
  }
  EXPECT_NEAR(given, EnergyTank::kMost, 1e-12) << "J, of the 1 J that was taken";
}

TEST(EnergyTank, ATipThatGoesAnywhereGetsAtMostWhatOneTickMisjudges) {
  base::Random random(5);
  EnergyTank tank;
  double balance = 0.0, least = 0.0;
  Vector3 way = Vector3::Zero();
  for (int i = 0; i < 100000; ++i) {
    const Vector3 given = tank.give(random.uniform(0.0, 1.0) * random.direction());
    way += random.uniform(0.0, 1e-5) * random.direction() - 0.01 * way;  // 1e-5 m/tick^2 at most
    balance -= given.dot(way);
    least = std::min(least, balance);
    after_tick(tank, way);
  }
  EXPECT_GE(least, -1.01e-5) << "1 N over the change of the way in a tick";
  EXPECT_NEAR(balance, tank.stored(), 1e-9);
}

}  // namespace
}  // namespace icome::haptics
