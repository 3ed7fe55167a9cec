#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "devices/simulated/simulated_device.h"
#include "haptics/effects/drag.h"
#include "haptics/effects/effect.h"
#include "haptics/effects/fields.h"
#include "haptics/effects/springs.h"

namespace icome::haptics {
namespace {

constexpr SpringSettings kSpring{.stiffness = 200.0, .damping = 2.0};
constexpr double kEffectTolerance = 1e-12;  // N

/// Something else is touched: effects are felt where the tip is.
EffectInput tip_at(const Vector3& position, const Vector3& velocity = Vector3::Zero()) {
  EffectInput input;
  input.position = position;
  input.scp = position + Vector3(0.3, -0.2, 0.1);
  input.velocity = velocity;
  return input;
}

void expect_force(Effect& effect, const EffectInput& input, const Vector3& expected) {
  EXPECT_NEAR((effect.force(input) - expected).norm(), 0.0, kEffectTolerance)
      << effect.force(input).transpose();
}

// Work (J) that an effect does on a tip taken slowly along a closed polygon; 0 for a conservative force.
double work_around(Effect& effect, const std::vector<Vector3>& corners) {
  double work = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vector3& from = corners[i];
    const Vector3 step = (corners[(i + 1) % corners.size()] - from) / 20000.0;
    for (int k = 0; k < 20000; ++k) work += effect.force(tip_at(from + (k + 0.5) * step)).dot(step);
  }
  return work;
}

TEST(PointSpring, PullsAndDampsInAllDirections) {
  PointSpring spring(Vector3(0.01, 0, 0), kSpring);
  expect_force(spring, tip_at(Vector3(0, 0.01, 0), Vector3(0, 0, 0.5)), Vector3(2, -2, -1));
}

TEST(LineSpring, LeavesTheLineFree) {
  LineSpring spring(Vector3(0, 0, 0.01), Vector3(5, 0, 0), kSpring);
  expect_force(spring, tip_at(Vector3(0.3, 0.01, 0), Vector3(1, 0.5, 0)), Vector3(0, -3, 2));
}

TEST(PlaneSpring, HoldsFromBothSidesAndLeavesThePlaneFree) {
  PlaneSpring spring(Vector3(0, 0, 0.01), Vector3(0, 0, 2), kSpring);
  expect_force(spring, tip_at(Vector3(0.3, 0.2, 0.02), Vector3(1, 1, 0.1)), Vector3(0, 0, -2.2));
  expect_force(spring, tip_at(Vector3(0.3, 0.2, 0.0)), Vector3(0, 0, 2));
}

TEST(CurveSpring, HoldsOnTheNearestSegmentAtACornerAndAtTheEnds) {
  CurveSpring spring({Vector3(0, 0, 0), Vector3(0.1, 0, 0), Vector3(0.1, 0, 0), Vector3(0.1, 0.1, 0)},
                     kSpring);
  // Over the first segment: along x the tip is free, velocity too.
  expect_force(spring, tip_at(Vector3(0.05, 0, 0.01), Vector3(1, 0, 0.1)), Vector3(0, 0, -2.2));
  // Outside the corner: held by the corner, on all sides.
  expect_force(spring, tip_at(Vector3(0.11, -0.01, 0), Vector3(0.1, 0, 0)), Vector3(-2.2, 2, 0));
  // Beyond the ends.
  expect_force(spring, tip_at(Vector3(-0.01, 0, 0)), Vector3(2, 0, 0));
  expect_force(spring, tip_at(Vector3(0.1, 0.12, 0)), Vector3(0, -4, 0));
}

TEST(CurveSpring, AgreesWithDenseSamplingOfTheCurve) {
  base::Random random(21);
  std::vector<Vector3> points;
  for (int i = 0; i < 12; ++i) points.push_back(random.uniform(0, 0.05) * random.direction());
  CurveSpring spring(points, {.stiffness = 200.0, .damping = 0.0});
  for (int trial = 0; trial < 100; ++trial) {
    const Vector3 position = random.uniform(0, 0.08) * random.direction();
    double least = 1.0;
    for (std::size_t i = 1; i < points.size(); ++i) {
      for (int k = 0; k <= 1000; ++k) {
        const Vector3 sample = points[i - 1] + (k / 1000.0) * (points[i] - points[i - 1]);
        least = std::min(least, (sample - position).norm());
      }
    }
    EXPECT_NEAR(spring.force(tip_at(position)).norm(), 200.0 * least, 200.0 * 1e-4);
    EXPECT_LE(spring.force(tip_at(position)).norm(), 200.0 * least + kEffectTolerance);
  }
}

TEST(CurveSpring, OnePointIsAPointSpring) {
  CurveSpring spring({Vector3(0.01, 0, 0)}, kSpring);
  expect_force(spring, tip_at(Vector3::Zero(), Vector3(0, 0, 0.5)), Vector3(2, 0, -1));
}

TEST(ConstantForce, IsTheSameEverywhere) {
  ConstantForce weight(Vector3(0, -0.5, 0));
  expect_force(weight, tip_at(Vector3(1, 2, 3), Vector3(4, 5, 6)), Vector3(0, -0.5, 0));
}

TEST(ForceField, IsTheUsersFunctionOfPlaceAndTime) {
  ForceField wind([](const Vector3& position, double time) { return Vector3(time, position.x(), 0); });
  EffectInput input = tip_at(Vector3(0.25, 0, 0));
  input.time = 1.5;
  expect_force(wind, input, Vector3(1.5, 0.25, 0));
}

TEST(GravityWell, IsASpringAtItsCentreAndNothingAtTheRim) {
  GravityWell well(Vector3(0, 0, 0.1), 0.02, 100.0);
  EXPECT_NEAR(well.force(tip_at(Vector3(1e-6, 0, 0.1))).x(), -1e-4, 1e-9);
  expect_force(well, tip_at(Vector3(0.02, 0, 0.1)), Vector3::Zero());
  expect_force(well, tip_at(Vector3(0.5, 0, 0.1)), Vector3::Zero());
  // Half way: 100 * 0.01 * (1 - 1/4)^2 = 0.5625 N.
  expect_force(well, tip_at(Vector3(0, 0, 0.11)), Vector3(0, 0, -0.5625));
}

TEST(GravityWell, PullsHardestWhereItSays) {
  GravityWell well(Vector3::Zero(), 0.02, 100.0);
  double strongest = 0.0, where = 0.0;
  for (double r = 0.0; r < 0.02; r += 1e-6) {
    const double pull = well.force(tip_at(Vector3(r, 0, 0))).norm();
    if (pull > strongest) strongest = pull, where = r;
  }
  EXPECT_NEAR(strongest, 0.286 * 100.0 * 0.02, 1e-3);
  EXPECT_NEAR(where, 0.02 / std::sqrt(5.0), 2e-6);
}

TEST(GravityWell, TheStiffnessForAForceGivesJustThatForce) {
  GravityWell well(Vector3::Zero(), 0.02, GravityWell::stiffness_of(0.02, 1.5));
  double strongest = 0.0;
  for (double r = 0.0; r < 0.02; r += 1e-6)
    strongest = std::max(strongest, well.force(tip_at(Vector3(r, 0, 0))).norm());
  EXPECT_NEAR(strongest, 1.5, 1e-6);
}

TEST(GravityWell, ForceAndItsSlopeAreContinuousAtTheRim) {
  GravityWell well(Vector3::Zero(), 0.02, 100.0);
  const double inside = well.force(tip_at(Vector3(0.02 - 1e-6, 0, 0))).norm();
  EXPECT_LT(inside / 1e-6, 0.1);  // N/m, of a spring with 100 at its centre
}

// What pays for the limiter's 2 ms: K 2 ms of damping, as much as the pull is left of it.
TEST(GravityWell, DampsInAllDirectionsAndLessTowardsItsRim) {
  GravityWell well(Vector3(0, 0, 0.1), 0.02, 100.0);
  expect_force(well, tip_at(Vector3(0, 0, 0.1), Vector3(0.1, 0, -0.2)), Vector3(-0.02, 0, 0.04));
  // Half way to the rim (3/4)^2 of it.
  expect_force(well, tip_at(Vector3(0, 0, 0.11), Vector3(0.1, 0, 0)), Vector3(-0.01125, 0, -0.5625));
}

TEST(Recess, DampsOnItsSlopeAcrossItsAxis) {
  Recess recess({});  // 1 N from 8 to 12 mm: a slope of at most 785.4 N/m
  const double damping = std::numbers::pi / 0.004 * 0.002;
  expect_force(recess, tip_at(Vector3(0.010, 0, 0), Vector3(0, 0.1, 0.5)), Vector3(-1.0, -0.1 * damping, 0));
  // A quarter up: sin(45) of the slope, sin^2(45) of the peak.
  expect_force(recess, tip_at(Vector3(0.009, 0, 0), Vector3(0, 0.1, 0.5)),
               Vector3(-0.5, -0.1 * damping * std::sqrt(0.5), 0));
  expect_force(recess, tip_at(Vector3(0.004, 0, 0), Vector3(0, 0.1, 0.5)), Vector3::Zero());
}

TEST(Recess, FloorAndOutsideAreFreeAndTheSlopePushesInwards) {
  const RecessSettings settings{.centre = Vector3(0.1, 0, 0),
                                .axis = Vector3(0, 0, 3),
                                .floor_radius = 0.008,
                                .rim_radius = 0.012,
                                .peak_force = 1.5};
  Recess recess(settings);
  expect_force(recess, tip_at(Vector3(0.107, 0, 0.5)), Vector3::Zero());
  expect_force(recess, tip_at(Vector3(0.1, 0.0121, 0)), Vector3::Zero());
  expect_force(recess, tip_at(Vector3(0.1, 0.010, 0.2)), Vector3(0, -1.5, 0));    // half way up: the peak
  expect_force(recess, tip_at(Vector3(0.09 + 1e-3, 0, 0)), Vector3(0.75, 0, 0));  // a quarter: sin^2 45
}

TEST(Recess, WithoutForceIsNothing) {
  Recess recess({.peak_force = 0.0});
  expect_force(recess, tip_at(Vector3(0.010, 0, 0), Vector3(0, 0.1, 0)), Vector3::Zero());
}

TEST(Recess, LeavingCostsTheStatedEnergy) {
  Recess recess({});
  double work = 0.0;
  for (int i = 0; i < 40000; ++i) work += recess.force(tip_at(Vector3((i + 0.5) * 5e-7, 0, 0))).x() * 5e-7;
  EXPECT_NEAR(work, -1.0 * 0.004 / 2.0, 1e-8);  // 2 mJ
}

TEST(Fields, WellAndRecessGiveBackWhatTheyTake) {
  GravityWell well(Vector3::Zero(), 0.02, 100.0);
  Recess recess({});
  const std::vector<Vector3> tour = {Vector3(0.001, 0.002, 0), Vector3(0.015, -0.003, 0.004),
                                     Vector3(-0.002, 0.03, 0.01)};
  EXPECT_NEAR(work_around(well, tour), 0.0, 1e-8);
  EXPECT_NEAR(work_around(recess, tour), 0.0, 1e-8);
}

TEST(ViscousDamping, ResistsVelocity) {
  ViscousDamping syrup(3.0);
  expect_force(syrup, tip_at(Vector3::Zero(), Vector3(0.1, 0, -0.2)), Vector3(-0.3, 0, 0.6));
}

TEST(ViscousDamping, StaysBelowWhatIsStableForTheTick) {
  ViscousDamping syrup(1e6);
  EffectInput input = tip_at(Vector3::Zero(), Vector3(0.1, 0, 0));
  input.device_mass = 0.1;
  // Half of m/dt = 100 N s/m: a quarter of the stable limit 2 m/dt.
  expect_force(syrup, input, Vector3(-5.0, 0, 0));
}

// Drags the tip at 10 mm/s from 0 to `distance` and returns the forces against it.
std::vector<double> drag_forces(FrictionEffect& friction, double distance) {
  std::vector<double> forces;
  for (double x = 0.0; x < distance; x += 1e-5) {
    forces.push_back(-friction.force(tip_at(Vector3(x, 0, 0), Vector3(0.01, 0, 0))).x());
  }
  return forces;
}

TEST(FrictionEffect, SticksUpToStaticThenSlidesAgainstDynamicForce) {
  FrictionEffect friction({.static_force = 0.5, .dynamic_force = 0.3, .stiffness = 1000.0});
  const std::vector<double> forces = drag_forces(friction, 0.01);
  double peak = 0.0;
  for (const double force : forces) peak = std::max(peak, force);
  EXPECT_NEAR(peak, 0.5, 0.02);
  EXPECT_LE(peak, 0.5 + kEffectTolerance);
  EXPECT_NEAR(forces.back(), 0.3, 1e-9);
}

TEST(FrictionEffect, DampsATipThatSticksByNoMoreThanItHolds) {
  FrictionEffect friction({.static_force = 0.5, .dynamic_force = 0.3, .stiffness = 1000.0});
  // sqrt(K m) of 1000 N/m and 100 g: 10 N s/m.
  expect_force(friction, tip_at(Vector3::Zero(), Vector3(0.01, 0, 0)), Vector3(-0.1, 0, 0));
  expect_force(friction, tip_at(Vector3::Zero(), Vector3(0, 1.0, 0)), Vector3(0, -0.5, 0));
}

TEST(FrictionEffect, HoldsAStillTipWithoutDrift) {
  FrictionEffect friction({.static_force = 0.5, .dynamic_force = 0.3, .stiffness = 1000.0});
  friction.force(tip_at(Vector3::Zero()));
  for (int tick = 0; tick < 10000; ++tick) {
    ASSERT_NEAR(friction.force(tip_at(Vector3(2e-4, 0, 0))).x(), -0.2, kEffectTolerance) << tick;
  }
}

TEST(FrictionEffect, TurnsWithTheMotion) {
  FrictionEffect friction({});
  drag_forces(friction, 0.01);
  double last = 0.0;
  for (double x = 0.01; x > 0.0; x -= 1e-5) {
    last = friction.force(tip_at(Vector3(x, 0, 0), Vector3(-0.01, 0, 0))).x();
  }
  EXPECT_NEAR(last, 0.4, 1e-9);
}

TEST(FrictionEffect, ResetForgetsTheAnchor) {
  FrictionEffect friction({});
  friction.force(tip_at(Vector3::Zero()));
  friction.reset();
  expect_force(friction, tip_at(Vector3(0.05, 0, 0)), Vector3::Zero());
}

// A hand drags a light device to and fro over friction alone: the friction takes energy, never gives it
// (port and sum as in passivity_test.cpp), and the tip comes to rest when the hand does.
TEST(FrictionEffect, TakesEnergyFromAClosedLoopAndLetsItRest) {
  devices::SimulatedSettings settings;
  settings.info.effective_mass = 0.05;
  settings.hand = {.mass = 0.0, .stiffness = 300.0, .damping = 0.0};
  settings.trajectory = [](double t) { return Vector3(t < 2.0 ? 0.03 * std::sin(6.0 * t) : 0.0, 0, 0); };
  devices::SimulatedDevice device(settings);
  FrictionEffect friction({});
  devices::PointerState state;
  Vector3 last = Vector3::Zero(), held = Vector3::Zero();
  double energy = 0.0;  // J, into the friction
  for (int tick = 0; tick < 6000; ++tick) {
    device.read(state);
    energy -= held.dot(device.true_position() - last);
    ASSERT_GE(energy, -1e-12) << tick;
    last = device.true_position();
    EffectInput input = tip_at(state.position, state.velocity);
    input.device_mass = 0.05;
    held = friction.force(input);
    device.write(held);
  }
  EXPECT_GT(energy, 0.05);  // about 0.4 N over 4 passes of 6 cm and more
  EXPECT_LT(device.true_velocity().norm(), 1e-6);
}

// A device without a hand's spring: pushed with a force, its speed after `seconds` tells the mass felt.
double speed_after_push(Effect& effect, double push, double device_mass, double seconds, double encoder) {
  devices::SimulatedSettings settings;
  settings.info.effective_mass = device_mass;
  settings.hand = {.mass = 0.0, .stiffness = 0.0, .damping = 0.0};
  settings.encoder_resolution = encoder;
  devices::SimulatedDevice device(settings);
  devices::PointerState state;
  double fastest_change = 0.0, last = 0.0;
  for (int tick = 0; tick < static_cast<int>(seconds * 1000.0); ++tick) {
    device.read(state);
    EffectInput input = tip_at(state.position, state.velocity);
    input.device_mass = device_mass;
    device.write(effect.force(input) + Vector3(push, 0, 0));
    fastest_change = std::max(fastest_change, std::abs(device.true_velocity().x() - last));
    last = device.true_velocity().x();
  }
  EXPECT_LE(fastest_change, push / device_mass * 1e-3 * 1.0001);  // never faster than without the effect
  return device.true_velocity().x();
}

TEST(Inertia, TheTipFeelsAsHeavyAsItSays) {
  for (const double felt : {0.1, 0.5, 2.0}) {
    for (const double encoder : {0.0, 1e-9}) {
      Inertia inertia(felt);
      const double speed = speed_after_push(inertia, 1.0, 0.1, 2.0, encoder);
      // a = F/(m + M); the low-pass lets the first moments pass lighter.
      EXPECT_NEAR(speed, 2.0 / (0.1 + felt), 0.1 * 2.0 / (0.1 + felt)) << felt << " " << encoder;
    }
  }
}

TEST(Inertia, AnswersAStepOfAccelerationAsItsCornerSays) {
  for (const double corner : {20.0, 80.0}) {
    Inertia inertia(0.01, corner);
    inertia.force(tip_at(Vector3::Zero()));
    for (int tick = 1; tick <= 20; ++tick) {
      const double answered = 1.0 - std::exp(-2.0 * std::numbers::pi * corner * 1e-3 * tick);
      const double force = inertia.force(tip_at(Vector3::Zero(), Vector3(0, 2e-3 * tick, 0))).y();
      EXPECT_NEAR(force, -0.01 * 2.0 * answered, 1e-12) << corner << " " << tick;
    }
  }
}

// The mass on which it is as quick as its corner says, and no more of it than a device has.
TEST(Inertia, NeedsTheMassOnWhichItIsNoLaterThanItsCorner) {
  constexpr double kLarge = 10.0;  // kg
  const auto first_answer = [](double device_mass) {
    Inertia inertia(0.1, 80.0);
    EffectInput input = tip_at(Vector3::Zero());
    input.device_mass = device_mass;
    inertia.force(input);
    input.velocity = Vector3(0, 2e-3, 0);
    return -inertia.force(input).y();
  };
  const double needed = Inertia(0.1, 80.0).mass_needed(kLarge, 1e-3);
  EXPECT_NEAR(first_answer(needed), first_answer(kLarge), 1e-12);
  EXPECT_LT(first_answer(0.95 * needed), first_answer(kLarge) - 1e-4);
  EXPECT_EQ(Inertia(5.0, 80.0).mass_needed(0.05, 1e-3), 0.05);
}

TEST(Inertia, GoesOnAlikeInAFrameThatIsTurned) {
  const base::Pose turn =
      Eigen::Translation3d(0.3, 0, 0) * base::Pose(Eigen::AngleAxisd(2.0, Vector3(1, 2, 3).normalized()));
  Inertia still(0.5), turned(0.5);
  base::Random random(6);
  Vector3 velocity = Vector3::Zero();
  for (int tick = 0; tick < 40; ++tick) {
    velocity += 2e-3 * random.direction();
    if (tick == 20) turned.reframe(turn);
    const bool after = tick >= 20;
    const Vector3 force = turned.force(tip_at(Vector3::Zero(), after ? turn.linear() * velocity : velocity));
    const Vector3 expected = still.force(tip_at(Vector3::Zero(), velocity));
    EXPECT_NEAR((force - (after ? turn.linear() * expected : expected)).norm(), 0.0, 1e-12) << tick;
  }
}

TEST(Inertia, IsStableForAMassFarBeyondTheDevices) {
  for (const double encoder : {0.0, 1e-9}) {
    Inertia heavy(50.0, 1000.0);
    const double speed = speed_after_push(heavy, 1.0, 0.05, 5.0, encoder);
    EXPECT_GT(speed, 0.0);
    EXPECT_LT(speed, 1.0);
  }
}

TEST(Inertia, FeelsNothingAtConstantSpeedAndAfterReset) {
  Inertia inertia(1.0);
  for (int tick = 0; tick < 10; ++tick) {
    expect_force(inertia, tip_at(Vector3(tick * 1e-3, 0, 0), Vector3(1, 0, 0)), Vector3::Zero());
  }
  inertia.reset();
  expect_force(inertia, tip_at(Vector3::Zero(), Vector3(-5, 0, 0)), Vector3::Zero());
}

struct Flight {
  double fastest = 0.0, last = 0.0;  // m/s
};

/// A device of 100 g that nobody holds: its force is held over a tick, and it moves as masses do.
Flight let_fly(Effect& effect, Vector3 position, Vector3 velocity) {
  constexpr double kMass = 0.1, kStep = 1e-3;
  Flight flight;
  for (int tick = 0; tick < 3000; ++tick) {
    EffectInput input = tip_at(position, velocity);
    input.device_mass = kMass;
    input.dt = kStep;
    const Vector3 acceleration = effect.force(input) / kMass;
    position += kStep * velocity + 0.5 * kStep * kStep * acceleration;
    velocity += kStep * acceleration;
    flight.fastest = std::max(flight.fastest, velocity.norm());
  }
  flight.last = velocity.norm();
  return flight;
}

// What is asked for is a hundred times what the device can hold still.
TEST(EffectsTooHardForTheDevice, LetItComeToRest) {
  constexpr double kHard = 1e6;  // N/m
  const Vector3 off(0.001, 0, 0), slow(0.0, 0.0213, 0.0);
  PointSpring point(Vector3::Zero(), {.stiffness = kHard, .damping = kAutomaticDamping});
  PointSpring damped(Vector3::Zero(), {.stiffness = 100.0, .damping = kHard});
  CurveSpring curve({Vector3::Zero(), Vector3(0, 0, 0.1)},
                    {.stiffness = kHard, .damping = kAutomaticDamping});
  GravityWell well(Vector3::Zero(), 0.02, kHard);
  FrictionEffect friction({.static_force = 0.5, .dynamic_force = 0.4, .stiffness = kHard});
  for (Effect* const effect : std::initializer_list<Effect*>{&point, &damped, &curve, &well, &friction})
    EXPECT_LT(let_fly(*effect, off, slow).last, 1e-5);
}

TEST(EffectsTooHardForTheDevice, OfARecessThrowNobodyBackFasterThanHeCame) {
  Recess recess({.floor_radius = 0.008, .rim_radius = 0.0085, .peak_force = 100.0});
  for (const double speed : {0.05, 0.1, 0.2})
    EXPECT_LE(let_fly(recess, Vector3::Zero(), Vector3(speed, 0, 0)).fastest, 1.001 * speed) << speed;
}

}  // namespace
}  // namespace icome::haptics
