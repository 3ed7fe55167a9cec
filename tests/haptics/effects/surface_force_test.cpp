#include "haptics/effects/surface_force.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "base/random.h"
#include "devices/device_profiles.h"

namespace icome::haptics {
namespace {

// The independent reference: the largest eigenvalue of one tick of a free mass on the sampled wall,
// force from the position and its backward difference, held over the tick, `delay` ticks late.
double spectral_radius(double stiffness, double damping, double mass, double dt, int delay = 0) {
  // State: x, v, x one tick ago, then the forces under way.
  const int size = 3 + delay;
  Eigen::MatrixXd tick = Eigen::MatrixXd::Zero(size, size);
  Eigen::RowVectorXd force = Eigen::RowVectorXd::Zero(size);
  force(0) = -stiffness - damping / dt;
  force(2) = damping / dt;
  Eigen::RowVectorXd acting = force;
  if (delay > 0) {
    acting.setZero();
    acting(size - 1) = 1.0;
    tick.row(3) = force;
    for (int i = 4; i < size; ++i) tick(i, i - 1) = 1.0;
  }
  tick.row(0) = acting * (dt * dt / (2.0 * mass));
  tick(0, 0) += 1.0;
  tick(0, 1) += dt;
  tick.row(1) = acting * (dt / mass);
  tick(1, 1) += 1.0;
  tick(2, 0) = 1.0;
  return tick.eigenvalues().cwiseAbs().maxCoeff();
}

TEST(StableDampingRange, IsWhereTheTickContracts) {
  base::Random random(1);
  for (int i = 0; i < 300; ++i) {
    const double mass = std::exp(random.uniform(std::log(0.01), std::log(1.0)));
    const double dt = std::exp(random.uniform(std::log(1e-4), std::log(4e-3)));
    const double stiffness = random.uniform(0.01, 0.6) * mass / (dt * dt);
    const DampingRange range = stable_damping_range(stiffness, mass, dt);
    ASSERT_LT(range.least, range.most);
    EXPECT_LT(spectral_radius(stiffness, range.least * 1.001, mass, dt), 1.0);
    EXPECT_GT(spectral_radius(stiffness, range.least * 0.999, mass, dt), 1.0);
    EXPECT_LT(spectral_radius(stiffness, range.most * 0.999, mass, dt), 1.0);
    EXPECT_GT(spectral_radius(stiffness, range.most * 1.001, mass, dt), 1.0);
  }
}

TEST(StableDampingRange, LowerEndIsTheLeakOfTheHoldForSoftWalls) {
  // Colgate and Brown, Gil: K dt / 2 = 0.5 N s/m for 1000 N/m at 1 kHz, up to terms in K dt^2/m = 0.01.
  EXPECT_NEAR(stable_damping_range(1000.0, 0.1, 1e-3).least, 0.5, 0.01);
}

TEST(StableDampingRange, PureDampingMayReachTwiceMassOverStep) {
  const DampingRange range = stable_damping_range(0.0, 0.075, 1e-3);
  EXPECT_DOUBLE_EQ(range.least, 0.0);
  EXPECT_DOUBLE_EQ(range.most, 150.0);
}

TEST(StableDampingRange, IsEmptyBeyondTheStiffnessThatAnyDampingCanHold) {
  const double limit = 4.0 * (3.0 - 2.0 * std::sqrt(2.0)) * 0.1 / 1e-6;  // K dt^2/m = 0.686
  EXPECT_GT(stable_damping_range(limit * 0.999, 0.1, 1e-3).most, 0.0);
  EXPECT_EQ(stable_damping_range(limit * 1.001, 0.1, 1e-3).most, 0.0);
  for (double damping = 1.0; damping < 200.0; damping += 1.0) {
    EXPECT_GT(spectral_radius(limit * 1.001, damping, 0.1, 1e-3), 1.0);
  }
}

TEST(StableDamping, KeepsASensibleRequest) { EXPECT_EQ(stable_damping(1000.0, 0.1, 1e-3, 5.0), 5.0); }

TEST(StableDamping, LowersOneThatIsTooLargeForTheStep) {
  const double most = stable_damping_range(1000.0, 0.1, 1e-3).most;
  EXPECT_GT(spectral_radius(1000.0, 300.0, 0.1, 1e-3), 1.0);
  EXPECT_DOUBLE_EQ(stable_damping(1000.0, 0.1, 1e-3, 300.0), most / 4.0);
  EXPECT_LT(spectral_radius(1000.0, most / 4.0, 0.1, 1e-3), 1.0);
}

TEST(StableDamping, RaisesOneThatDoesNotPayForTheStep) {
  EXPECT_GT(spectral_radius(1000.0, 0.0, 0.1, 1e-3), 1.0);
  EXPECT_DOUBLE_EQ(stable_damping(1000.0, 0.1, 1e-3, 0.0), 2.0);  // 2 K dt
  EXPECT_LT(spectral_radius(1000.0, 2.0, 0.1, 1e-3), 1.0);
}

TEST(StableDamping, AutomaticIsTheGeometricMiddleOfTheRange) {
  const DampingRange range = stable_damping_range(1000.0, 0.1, 1e-3);
  EXPECT_NEAR(stable_damping(1000.0, 0.1, 1e-3, kAutomaticDamping), std::sqrt(range.least * range.most),
              1e-9);
  EXPECT_DOUBLE_EQ(stable_damping(1000.0, 0.1, 1e-3, kAutomaticDamping), 10.0);  // sqrt(1000 * 0.1)
  EXPECT_EQ(stable_damping(0.0, 0.1, 1e-3, kAutomaticDamping), 0.0);
}

TEST(StableDamping, HoldsForEveryProfileRateAndRequestWithAndWithoutDelay) {
  for (const devices::DeviceInfo& device : devices::device_profiles()) {
    for (const double rate : {500.0, 1000.0, 4000.0, 10000.0}) {
      for (const double requested : {kAutomaticDamping, 0.0, 5.0, 1e6}) {
        for (const double stiffness : {10.0, device.nominal_stiffness, 1e7}) {
          const double mass = device.effective_mass, dt = 1.0 / rate;
          Surface surface{.stiffness = stiffness, .damping = requested};
          make_stable(surface, device.nominal_stiffness, mass, dt);
          EXPECT_LT(spectral_radius(surface.stiffness, surface.damping, mass, dt), 1.0)
              << device.name << " " << rate << " " << requested << " " << stiffness;
          EXPECT_LT(spectral_radius(surface.stiffness, surface.damping, mass, dt, 1), 1.0)
              << device.name << " " << rate << " " << requested << " " << stiffness;
        }
      }
    }
  }
}

TEST(StableDamping, HoldsForEveryRelativeStiffnessUpToTheLimitWithDelay) {
  for (int i = 1; i <= 100; ++i) {
    const double stiffness = i * 1e-3 * 0.1 / 1e-6;  // K dt^2/m = 0.001 to 0.1
    for (const double requested : {kAutomaticDamping, 0.0, 1e6}) {
      const double damping = stable_damping(stiffness, 0.1, 1e-3, requested);
      EXPECT_LT(spectral_radius(stiffness, damping, 0.1, 1e-3, 1), 1.0) << i << " " << requested;
    }
  }
}

TEST(StableStiffness, LeavesEveryProfileItsNominalOneAtOneKilohertz) {
  for (const devices::DeviceInfo& device : devices::device_profiles()) {
    EXPECT_EQ(stable_stiffness(device.effective_mass, 1e-3, device.nominal_stiffness),
              device.nominal_stiffness)
        << device.name;
  }
}

TEST(MakeStable, TakesTheDevicesStiffnessWhereNoneIsGivenAndLimitsIt) {
  Surface surface;
  make_stable(surface, 800.0, 0.075, 1e-3);
  EXPECT_DOUBLE_EQ(surface.stiffness, 800.0);
  EXPECT_DOUBLE_EQ(surface.damping, std::sqrt(60.0));
  Surface hard{.stiffness = 1e6};
  make_stable(hard, 800.0, 0.075, 1e-3);
  EXPECT_DOUBLE_EQ(hard.stiffness, 0.1 * 0.075 / 1e-6);  // 7500 N/m
}

Contact pressed_one_millimetre() {
  Contact contact;
  contact.tip = Vector3(0.02, 0.0, -0.001);
  contact.scp = Vector3(0.02, 0.0, 0.0);
  return contact;
}

constexpr double kForceTolerance = 1e-12;  // N

TEST(SpringDamperForce, SpringPushesOut) {
  const Surface surface{.stiffness = 1000.0, .damping = 5.0};
  EXPECT_NEAR((spring_damper_force(pressed_one_millimetre(), surface) - Vector3(0, 0, 1)).norm(), 0,
              kForceTolerance);
}

TEST(SpringDamperForce, DampsApproachAndRetreatAlongTheNormalOnly) {
  const Surface surface{.stiffness = 1000.0, .damping = 5.0};
  Contact contact = pressed_one_millimetre();
  contact.tip_velocity = Vector3(7.0, -3.0, -0.1);
  EXPECT_NEAR((spring_damper_force(contact, surface) - Vector3(0, 0, 1.5)).norm(), 0, kForceTolerance);
  contact.tip_velocity = Vector3(7.0, -3.0, 0.1);
  EXPECT_NEAR((spring_damper_force(contact, surface) - Vector3(0, 0, 0.5)).norm(), 0, kForceTolerance);
}

TEST(SpringDamperForce, ADampingDepthLetsAFastTipLandWithoutAStep) {
  const Surface surface{.stiffness = 1000.0, .damping = 5.0, .damping_depth = 0.0005};
  const auto force_at = [&](double depth) {
    Contact contact = pressed_one_millimetre();
    contact.tip.z() = contact.scp.z() - depth;
    contact.tip_velocity = Vector3(0, 0, -1.0);
    return spring_damper_force(contact, surface).z();
  };
  EXPECT_NEAR(force_at(1e-9), 0.0, 2e-5);
  EXPECT_NEAR(force_at(0.00025), 0.25 + 2.5, kForceTolerance) << "half of the damper";
  EXPECT_NEAR(force_at(0.0005), 0.5 + 5.0, kForceTolerance);
  EXPECT_NEAR(force_at(0.001), 1.0 + 5.0, kForceTolerance);
}

TEST(SpringDamperForce, NeverPullsATipThatLeavesFast) {
  const Surface surface{.stiffness = 1000.0, .damping = 5.0};
  Contact contact = pressed_one_millimetre();
  contact.tip_velocity = Vector3(0, 0, 2.0);  // the damper alone would pull with 10 N
  EXPECT_NEAR(spring_damper_force(contact, surface).norm(), 0, kForceTolerance);
  contact.tip.z() = 0.001;  // outside already
  contact.tip_velocity = Vector3(0, 0, -2.0);
  EXPECT_NEAR(spring_damper_force(contact, surface).norm(), 0, kForceTolerance);
}

TEST(SpringDamperForce, FrictionsSidewaysSpringIsKept) {
  const Surface surface{.stiffness = 1000.0, .damping = 5.0};
  Contact contact = pressed_one_millimetre();
  contact.scp.x() -= 0.0005;
  contact.tip_velocity = Vector3(0, 0, 2.0);
  EXPECT_NEAR((spring_damper_force(contact, surface) - Vector3(-0.5, 0, 0)).norm(), 0, kForceTolerance);
}

TEST(SpringDamperForce, VelocityIsRelativeToAMovingSurface) {
  const Surface surface{.stiffness = 1000.0, .damping = 5.0};
  Contact contact = pressed_one_millimetre();
  contact.tip_velocity = contact.scp_velocity = Vector3(0, 0, 0.7);
  EXPECT_NEAR((spring_damper_force(contact, surface) - Vector3(0, 0, 1)).norm(), 0, kForceTolerance);
}

TEST(SpringDamperForce, ContactNeverPullsInwardsWhateverComes) {
  base::Random random(5);
  for (int i = 0; i < 10000; ++i) {
    Contact contact;
    contact.normal = random.direction();
    contact.tip = random.uniform(0, 0.01) * random.direction();
    contact.tip_velocity = random.uniform(0, 3.0) * random.direction();
    contact.scp_velocity = random.uniform(0, 3.0) * random.direction();
    const Surface surface{.stiffness = random.uniform(0, 5000), .damping = random.uniform(0, 100)};
    EXPECT_GE(spring_damper_force(contact, surface).dot(contact.normal), -kForceTolerance);
  }
}

// Amplitude of a filtered unit sine of `frequency`, at 4 kHz with a 100 Hz corner.
double gain_at(double frequency) {
  VelocityFilter filter(100.0);
  double largest = 0.0;
  for (int tick = 0; tick < 8000; ++tick) {
    const double t = tick / 4000.0;
    const Vector3 out =
        filter.filter(Vector3(0, std::sin(2.0 * std::numbers::pi * frequency * t), 0), 1.0 / 4000.0);
    if (t > 1.0) largest = std::max(largest, std::abs(out.y()));
  }
  return largest;
}

TEST(VelocityFilter, PassesSlowHalvesPowerAtTheCornerStopsFast) {
  EXPECT_NEAR(gain_at(2.0), 1.0, 0.001);
  EXPECT_NEAR(gain_at(100.0), std::sqrt(0.5), 0.01);
  EXPECT_NEAR(gain_at(1000.0), 0.1, 0.02);
}

TEST(VelocityFilter, FirstValuePassesAndResetForgets) {
  VelocityFilter filter(10.0);
  EXPECT_EQ(filter.filter(Vector3(1, 2, 3), 1e-3), Vector3(1, 2, 3));
  EXPECT_GT(filter.filter(Vector3::Zero(), 1e-3).x(), 0.9);
  filter.reset();
  EXPECT_EQ(filter.filter(Vector3::Zero(), 1e-3), Vector3::Zero());
}

}  // namespace
}  // namespace icome::haptics
