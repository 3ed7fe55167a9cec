#include "devices/simulated/simulated_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "realtime/guard/guard.h"

namespace icome::devices {
namespace {

// 0.1 kg device + 0.1 kg hand on a 200 N/m spring: omega0 = sqrt(1000) rad/s.
SimulatedSettings free_oscillator() {
  SimulatedSettings settings;
  settings.info.effective_mass = 0.1;
  settings.hand = {.mass = 0.1, .stiffness = 200.0, .damping = 0.0};
  return settings;
}

TEST(SimulatedDevice, StepResponseIsTheUndampedCosine) {
  SimulatedDevice device(free_oscillator());
  device.set_target(Vector3(0.01, 0, -0.02));
  PointerState state;
  const double omega = std::sqrt(1000.0);
  for (int tick = 1; tick <= 5000; ++tick) {
    ASSERT_EQ(device.read(state), DeviceStatus::Ok);
    const double t = tick * 1e-3;
    ASSERT_NEAR(state.position.x(), 0.01 * (1.0 - std::cos(omega * t)), 1e-12) << tick;
    ASSERT_NEAR(state.velocity.z(), -0.02 * omega * std::sin(omega * t), 1e-10) << tick;
  }
  EXPECT_DOUBLE_EQ(device.time(), 5.0);
}

TEST(SimulatedDevice, DampedHandComesToRestWhereForceAndSpringBalance) {
  SimulatedSettings settings;
  settings.hand = {.mass = 0.05, .stiffness = 400.0, .damping = 5.0};
  SimulatedDevice device(settings);
  device.write(Vector3(0, 2.0, 0));
  PointerState state;
  for (int tick = 0; tick < 2000; ++tick) device.read(state);
  EXPECT_NEAR(state.position.y(), 2.0 / 400.0, 1e-9);  // 5 mm
  EXPECT_NEAR(state.velocity.norm(), 0.0, 1e-7);
}

TEST(SimulatedDevice, ForceIsHeldOverTheTick) {
  SimulatedSettings settings;
  settings.info.effective_mass = 0.25;
  settings.hand = {.mass = 0.25, .stiffness = 0.0, .damping = 0.0};
  settings.rate = 100.0;
  SimulatedDevice device(settings);
  PointerState state;
  device.write(Vector3(3.0, 0, 0));
  device.read(state);
  EXPECT_NEAR(state.position.x(), 0.5 * 6.0 * 1e-4, 1e-15);  // a t^2/2, a = 3 N / 0.5 kg
  EXPECT_NEAR(state.velocity.x(), 6.0 * 1e-2, 1e-14);
}

TEST(SimulatedDevice, FollowsATrajectoryOfTime) {
  SimulatedSettings settings;
  settings.trajectory = [](double t) { return Vector3(0.02 * std::sin(2.0 * t), 0, 0); };
  SimulatedDevice device(settings);
  PointerState state;
  double worst = 0.0;
  for (int tick = 0; tick < 4000; ++tick) {
    device.read(state);
    if (device.time() > 1.0) {
      worst = std::max(worst, (state.position - settings.trajectory(device.time())).norm());
    }
  }
  // A spring-damper lags by b v/k = 5 * 0.04 / 300 m.
  EXPECT_GT(worst, 0.4e-3);
  EXPECT_LT(worst, 0.8e-3);
}

TEST(SimulatedDevice, TrajectoryIsFollowedWithinTheTick) {
  SimulatedSettings settings = free_oscillator();
  settings.trajectory = [](double t) { return Vector3(t < 0.0005 ? 0.0 : 0.01, 0, 0); };
  PointerState state;
  SimulatedDevice fine(settings);
  fine.read(state);
  // Half a tick of 0.01 m * 200 N/m / 0.2 kg = 10 m/s^2.
  EXPECT_NEAR(state.velocity.x(), 10.0 * 0.0005, 1e-6);
  settings.substeps = 1;
  SimulatedDevice coarse(settings);
  coarse.read(state);
  EXPECT_EQ(state.velocity.x(), 0.0);
}

TEST(SimulatedDevice, EncoderRoundsAndVelocityIsItsBackwardDifference) {
  SimulatedSettings settings = free_oscillator();
  settings.encoder_resolution = 3e-5;
  SimulatedDevice device(settings);
  device.set_target(Vector3(0.01, 0.002, 0));
  PointerState before, state;
  device.read(before);
  for (int tick = 0; tick < 200; ++tick, before = state) {
    device.read(state);
    const Vector3 counts = state.position / 3e-5;
    ASSERT_NEAR((counts - counts.array().round().matrix()).norm(), 0.0, 1e-9);
    ASSERT_LE((state.position - device.true_position()).cwiseAbs().maxCoeff(), 1.5e-5 + 1e-12);
    ASSERT_NEAR((state.velocity - (state.position - before.position) * 1000.0).norm(), 0.0, 1e-9);
  }
}

TEST(SimulatedDevice, SameCallsGiveTheSameBits) {
  SimulatedDevice a, b;
  PointerState left, right;
  for (SimulatedDevice* device : {&a, &b}) device->set_target(Vector3(0.01, 0.02, 0.03));
  for (int tick = 0; tick < 1000; ++tick) {
    a.read(left);
    b.read(right);
    ASSERT_EQ(left.position, right.position);
    a.write(-100.0 * left.position);
    b.write(-100.0 * right.position);
  }
}

TEST(SimulatedDevice, UnpluggedIsLostAndMotorsDie) {
  SimulatedDevice device;
  PointerState state;
  device.write(Vector3(3, 0, 0));
  for (int tick = 0; tick < 2000; ++tick) device.read(state);
  const PointerState kept = state;
  device.inject(SimulatedFailure::Unplugged);
  for (int tick = 0; tick < 2000; ++tick) EXPECT_EQ(device.read(state), DeviceStatus::Lost);
  EXPECT_EQ(device.write(Vector3(3, 0, 0)), DeviceStatus::Lost);
  EXPECT_EQ(state.position, kept.position);        // the caller's state is left alone
  EXPECT_LT(device.true_position().norm(), 1e-6);  // the hand went back to its target
  device.inject(SimulatedFailure::None);
  EXPECT_EQ(device.read(state), DeviceStatus::Ok);
  EXPECT_LT(state.position.norm(), 1e-6);
}

TEST(SimulatedDevice, StalledHoldsTheForce) {
  SimulatedDevice device;
  PointerState state;
  device.inject(SimulatedFailure::Stalled);
  device.write(Vector3(3, 0, 0));
  for (int tick = 0; tick < 2000; ++tick) ASSERT_EQ(device.read(state), DeviceStatus::Stalled);
  EXPECT_EQ(state.position, Vector3::Zero());
  EXPECT_NEAR(device.true_position().x(), 3.0 / 300.0, 1e-6);
}

TEST(SimulatedDevice, NotANumberReadsOkButIsNotFinite) {
  SimulatedDevice device;
  PointerState state;
  device.inject(SimulatedFailure::NotANumber);
  EXPECT_EQ(device.read(state), DeviceStatus::Ok);
  EXPECT_FALSE(state.position.allFinite());
  device.write(state.position);  // a force that is no number moves nothing
  device.inject(SimulatedFailure::None);
  device.read(state);
  EXPECT_EQ(state.position, Vector3::Zero());
}

TEST(SimulatedDevice, ReadAndWriteTakeNoMemoryAndNoLock) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  SimulatedSettings settings;
  settings.trajectory = [](double t) { return Vector3(t, 0, 0); };
  settings.encoder_resolution = 3e-5;
  SimulatedDevice device(settings);
  PointerState state;
  realtime::RealtimeGuard guard;
  for (int tick = 0; tick < 100; ++tick) {
    device.set_target(Vector3(0.01, 0, 0));
    device.read(state);
    device.write(-100.0 * state.position);
  }
  guard.stop();
  EXPECT_EQ(guard.allocations() + guard.frees() + guard.locks(), 0u);
}

TEST(SimulatedDevice, IsPutElsewhereAtRestAndSaysSoOnce) {
  SimulatedDevice device;
  PointerState state;
  device.set_target({0.1, 0.0, 0.0});
  for (int i = 0; i < 20; ++i) device.read(state);
  EXPECT_GT(state.velocity.x(), 0.0);
  const Vector3 there(0.0, 0.5, 0.0);
  device.set_target(there);
  device.put(there);
  // Whoever could not read meanwhile hears of it later.
  device.inject(SimulatedFailure::Stalled);
  EXPECT_EQ(device.read(state), DeviceStatus::Stalled);
  device.inject(SimulatedFailure::None);
  ASSERT_EQ(device.read(state), DeviceStatus::Ok);
  EXPECT_TRUE(state.jumped);
  EXPECT_LT((state.position - there).norm(), 1e-12);
  EXPECT_LT(state.velocity.norm(), 1e-9);
  ASSERT_EQ(device.read(state), DeviceStatus::Ok);
  EXPECT_FALSE(state.jumped);
}

TEST(SimulatedDevice, LiesAsideUntilItIsPutAgain) {
  SimulatedDevice device;
  PointerState state;
  ASSERT_EQ(device.read(state), DeviceStatus::Ok);
  EXPECT_FALSE(state.parked);
  const Vector3 aside(0.0, 0.0, 3.0);
  device.set_target(aside);
  device.park(aside);
  for (int i = 0; i < 10; ++i) {
    ASSERT_EQ(device.read(state), DeviceStatus::Ok);
    EXPECT_TRUE(state.parked);
    EXPECT_LT((state.position - aside).norm(), 1e-12);
  }
  device.put(aside);
  ASSERT_EQ(device.read(state), DeviceStatus::Ok);
  EXPECT_FALSE(state.parked);
  EXPECT_TRUE(state.jumped);
}

TEST(SimulatedDevice, TargetMayBeSetFromAnotherThread) {
  SimulatedDevice device;
  std::thread person([&device] {
    for (int i = 1; i <= 1000; ++i) device.set_target(Vector3::Constant(i * 1e-5));
  });
  PointerState state;
  for (int tick = 0; tick < 1000; ++tick) {
    device.read(state);
    // Never a torn target: all three axes always move alike.
    ASSERT_EQ(state.position.x(), state.position.y());
    ASSERT_EQ(state.position.x(), state.position.z());
  }
  person.join();
  for (int tick = 0; tick < 2000; ++tick) device.read(state);
  EXPECT_NEAR(state.position.x(), 0.01, 1e-6);
}

}  // namespace
}  // namespace icome::devices
