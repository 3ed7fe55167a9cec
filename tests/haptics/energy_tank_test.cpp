#include "haptics/energy_tank.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace icome::haptics {
namespace {

const Vector3 kForce(1, 0, 0);
const Vector3 kWay(1e-3, 0, 0);

TEST(EnergyTank, GivesNothingBeforeItHasTaken) {
  EnergyTank tank;
  tank.settle(kWay, 1.0);
  EXPECT_EQ(tank.give(kForce), Vector3::Zero());
  EXPECT_EQ(tank.give(-kForce), -kForce) << "what resists is never held back";
}

TEST(EnergyTank, GivesBackJustWhatItHasTaken) {
  EnergyTank tank;
  tank.settle(kWay, 1.0);
  for (int i = 0; i < 10; ++i) {
    tank.give(-kForce);
    tank.settle(kWay, 1.0);
  }
  EXPECT_NEAR(tank.stored(), 10e-3, 1e-15);
  double given = 0.0;
  for (int i = 0; i < 100; ++i) {
    given += tank.give(0.3 * kForce).dot(kWay);
    tank.settle(kWay, 1.0);
  }
  EXPECT_NEAR(given, 10e-3, 1e-15);
}

TEST(EnergyTank, CountsWhatTheLimiterLetThrough) {
  EnergyTank tank;
  tank.give(-kForce);
  tank.settle(kWay, 0.25);
  EXPECT_NEAR(tank.stored(), 0.25e-3, 1e-15);
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
    tank.settle(way, 1.0);
  }
  EXPECT_GE(least, -1.01e-5) << "1 N over the change of the way in a tick";
  EXPECT_NEAR(balance, tank.stored(), 1e-9);
}

}  // namespace
}  // namespace icome::haptics
