// A simulated hand on a wall, tick by tick as the servo does it. The port is the tip: what flows into the
// virtual wall in a tick is -F . (x[n+1] - x[n]), exact because F is held over the tick. A wall is passive
// when the sum never falls below zero: it never gives back more than it was given.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/random.h"
#include "devices/device_profiles.h"
#include "devices/simulated/simulated_device.h"
#include "haptics/effects/surface_force.h"
#include "haptics/servo/force_limiter.h"

namespace icome::haptics {
namespace {

using devices::DeviceInfo;
using devices::SimulatedDevice;
using devices::SimulatedSettings;

constexpr double kNoEnergy = 1e-12;  // J, rounding

struct PressOutcome {
  double least_energy = 0.0;   // J, the lowest that the sum of energy into the wall ever was
  double energy = 0.0;         // J, at the end
  double last_speed = 0.0;     // m/s, largest of the last tenth
  double last_spread = 0.0;    // m, of the depths in the last tenth
  double deepest = 0.0;        // m
  double largest_force = 0.0;  // N, asked of the device
  Vector3 end = Vector3::Zero();
};

// The half-space z <= 0 with its SCP the projection of the tip.
Vector3 wall_force(const devices::PointerState& state, const Surface& surface) {
  if (state.position.z() >= 0.0) return Vector3::Zero();
  Contact contact;
  contact.tip = contact.scp = state.position;
  contact.scp.z() = 0.0;
  contact.tip_velocity = state.velocity;
  return spring_damper_force(contact, surface);
}

struct PressLoop {
  bool limited = false;
  int delay = 0;  // ticks that a force waits before the device gets it
};

PressOutcome press(const SimulatedSettings& settings, const Surface& surface, double seconds,
                   const PressLoop& loop = {}) {
  SimulatedDevice device(settings);
  ForceLimiter limiter(settings.info);
  const double dt = 1.0 / settings.rate;
  const int ticks = static_cast<int>(seconds * settings.rate);
  PressOutcome outcome;
  Vector3 last = device.true_position(), held = Vector3::Zero(), waiting = Vector3::Zero();
  double highest = -1.0, lowest = 1.0;
  devices::PointerState state;
  for (int tick = 0; tick < ticks; ++tick) {
    device.read(state);
    outcome.energy -= held.dot(device.true_position() - last);
    last = device.true_position();
    outcome.least_energy = std::min(outcome.least_energy, outcome.energy);
    outcome.deepest = std::max(outcome.deepest, -last.z());
    const Vector3 wanted = wall_force(state, surface);
    const Vector3 force = loop.limited ? limiter.limit(wanted, dt) : wanted;
    held = loop.delay > 0 ? waiting : force;
    waiting = force;
    outcome.largest_force = std::max(outcome.largest_force, held.norm());
    device.write(held);
    if (tick * 10 >= ticks * 9) {
      outcome.last_speed = std::max(outcome.last_speed, device.true_velocity().norm());
      highest = std::max(highest, last.z());
      lowest = std::min(lowest, last.z());
    }
  }
  outcome.last_spread = highest - lowest;
  outcome.end = last;
  return outcome;
}

// The depth at which wall and hand balance: the hand pulls to `target` < 0.
double resting_height(const SimulatedSettings& settings, const Surface& surface, double target) {
  return settings.hand.stiffness * target / (settings.hand.stiffness + surface.stiffness);
}

// A hand that waits 2 cm above the wall and, at 0.6 s (after the limiter's ramp), jumps to a target so far
// below that half of the continuous force holds it.
double press_target(const DeviceInfo& device, const Surface& surface, const devices::SimulatedHand& hand) {
  const double force = 0.5 * device.continuous_force;
  return -(force / hand.stiffness + force / surface.stiffness);
}

SimulatedSettings pressing_hand(const DeviceInfo& device, const Surface& surface, double rate) {
  SimulatedSettings settings;
  settings.info = device;
  settings.rate = rate;
  settings.start = Vector3(0, 0, 0.02);
  const double target = press_target(device, surface, settings.hand);
  settings.trajectory = [target](double t) { return Vector3(0, 0, t < 0.6 ? 0.02 : target); };
  return settings;
}

Surface stable_surface(const DeviceInfo& device, double rate, double damping = kAutomaticDamping) {
  Surface surface{.damping = damping};
  make_stable(surface, device.nominal_stiffness, device.effective_mass, 1.0 / rate);
  return surface;
}

void expect_passive_and_settled(const PressOutcome& outcome, double height) {
  EXPECT_GE(outcome.least_energy, -kNoEnergy);
  EXPECT_GT(outcome.energy, 0.0);
  EXPECT_LT(outcome.last_speed, 1e-6);
  EXPECT_LT(outcome.last_spread, 1e-9);
  EXPECT_NEAR(outcome.end.z(), height, 1e-9);
}

class PassivityAtRate : public testing::TestWithParam<double> {};

TEST_P(PassivityAtRate, HandPressingAtEachProfilesStiffnessIsPassiveAndSettles) {
  for (const DeviceInfo& device : devices::device_profiles()) {
    SCOPED_TRACE(device.name);
    const Surface surface = stable_surface(device, GetParam());
    const SimulatedSettings settings = pressing_hand(device, surface, GetParam());
    const double height = resting_height(settings, surface, press_target(device, surface, settings.hand));
    expect_passive_and_settled(press(settings, surface, 4.0), height);
    expect_passive_and_settled(press(settings, surface, 4.0, {.limited = true}), height);
  }
}

TEST_P(PassivityAtRate, EvenWithoutTheHandsMassAndDamping) {
  // The hardest case: nothing but the wall itself takes energy out. It must still settle.
  for (const DeviceInfo& device : devices::device_profiles()) {
    for (const double damping : {kAutomaticDamping, 0.0, 1e6}) {
      SCOPED_TRACE(device.name + " " + std::to_string(damping));
      const Surface surface = stable_surface(device, GetParam(), damping);
      SimulatedSettings settings = pressing_hand(device, surface, GetParam());
      settings.hand.mass = settings.hand.damping = 0.0;
      const PressOutcome outcome = press(settings, surface, 4.0);
      EXPECT_GE(outcome.least_energy, -kNoEnergy);
      EXPECT_LT(outcome.deepest, 0.02);
      if (damping != 0.0) {
        EXPECT_LT(outcome.last_speed, 1e-3);
      }
    }
  }
}

TEST_P(PassivityAtRate, RestlessHandNeverGetsEnergyFromTheWall) {
  for (const DeviceInfo& device : devices::device_profiles()) {
    SCOPED_TRACE(device.name);
    const Surface surface = stable_surface(device, GetParam());
    SimulatedSettings settings;
    settings.info = device;
    settings.rate = GetParam();
    settings.start = Vector3(0, 0, 0.01);
    // Taps, presses and slides: a new random target every 50 ms, once the limiter has ramped in (a wall
    // that fades in around the tip does give energy: its spring was never pressed).
    settings.trajectory = [](double t) {
      if (t < 0.6) return Vector3(0, 0, 0.01);
      base::Random random(static_cast<std::uint64_t>(t / 0.05) + 17);
      return Vector3(random.uniform(-0.02, 0.02), 0.0, random.uniform(-0.02, 0.02));
    };
    EXPECT_GE(press(settings, surface, 10.0).least_energy, -kNoEnergy);
    EXPECT_GE(press(settings, surface, 10.0, {.limited = true}).least_energy, -kNoEnergy);
  }
}

TEST_P(PassivityAtRate, SettlesWithATickOfDelay) {
  for (const DeviceInfo& device : devices::device_profiles()) {
    SCOPED_TRACE(device.name);
    const Surface surface = stable_surface(device, GetParam());
    const SimulatedSettings settings = pressing_hand(device, surface, GetParam());
    const PressOutcome outcome = press(settings, surface, 4.0, {.limited = true, .delay = 1});
    EXPECT_LT(outcome.last_speed, 1e-6);
  }
}

std::string rate_name(const testing::TestParamInfo<double>& rate) {
  return std::to_string(static_cast<int>(rate.param)) + "Hz";
}

INSTANTIATE_TEST_SUITE_P(Rates, PassivityAtRate, testing::Values(500.0, 1000.0, 4000.0), rate_name);

TEST(Passivity, EncoderStepsOnlyTrembleByAStep) {
  for (const DeviceInfo& device : devices::device_profiles()) {
    SCOPED_TRACE(device.name);
    const Surface surface = stable_surface(device, 1000.0);
    SimulatedSettings settings = pressing_hand(device, surface, 1000.0);
    settings.encoder_resolution = 3e-5;  // thesis table 4.1
    const PressOutcome outcome = press(settings, surface, 4.0, {.limited = true});
    EXPECT_GE(outcome.least_energy, -kNoEnergy);
    EXPECT_LT(outcome.last_spread, 2.0 * 3e-5);
  }
}

// Thesis 5.3.2: "the simulation becomes unstable if the damping constant is too large for a given step
// size". On a wall that holds from both sides, the linear case, the derived bound is exact.
double speed_on_two_sided_wall(double damping) {
  SimulatedSettings settings;
  settings.info = devices::find_device_profile("PHANToM Premium 1.5").value();
  settings.hand = {.mass = 0.0, .stiffness = 0.0, .damping = 0.0};
  settings.start = Vector3(0, 0, 0.001);
  SimulatedDevice device(settings);
  devices::PointerState state;
  double last = 0.001;  // m
  for (int tick = 0; tick < 2000; ++tick) {
    device.read(state);
    device.write(Vector3(0, 0, -800.0 * state.position.z() - damping * (state.position.z() - last) * 1000.0));
    last = state.position.z();
  }
  return device.true_velocity().norm();
}

TEST(Passivity, DampingBoundIsExactOnATwoSidedWall) {
  const double most = stable_damping_range(800.0, 0.075, 1e-3).most;
  EXPECT_LT(speed_on_two_sided_wall(0.99 * most), 1e-6);
  EXPECT_GT(speed_on_two_sided_wall(1.01 * most), 1.0);
}

TEST(Passivity, TooLargeADampingConstantMakesThePressUnstable) {
  const DeviceInfo device = devices::find_device_profile("PHANToM Premium 1.5").value();
  Surface surface{.stiffness = 800.0};
  SimulatedSettings settings = pressing_hand(device, stable_surface(device, 1000.0), 1000.0);
  settings.hand.damping = settings.hand.mass = 0.0;
  settings.encoder_resolution = 1e-9;  // velocity by backward difference, as the bound assumes
  const double most = stable_damping_range(800.0, device.effective_mass, 1e-3).most;
  surface.damping = 0.5 * most;
  const PressOutcome stable = press(settings, surface, 4.0);
  EXPECT_LT(stable.last_speed, 1e-3);
  EXPECT_GE(stable.least_energy, -kNoEnergy);
  surface.damping = 1.1 * most;
  const PressOutcome unstable = press(settings, surface, 4.0);
  EXPECT_GT(unstable.last_speed, 0.05);
  EXPECT_LT(unstable.least_energy, -1e-3);
}

TEST(Passivity, UndampedWallGivesEnergyToTheHand) {
  // The zero-order hold leaks: without damping the wall is active, which is why it is never allowed.
  const DeviceInfo device = devices::find_device_profile("omega.x").value();
  const Surface surface{.stiffness = 5000.0, .damping = 0.0};
  SimulatedSettings settings = pressing_hand(device, surface, 1000.0);
  settings.hand.damping = settings.hand.mass = 0.0;
  const PressOutcome outcome = press(settings, surface, 4.0);
  EXPECT_LT(outcome.least_energy, -1e-3);
  EXPECT_GT(outcome.last_speed, 0.1);
}

TEST(Passivity, SaturatedDeviceStillSettles) {
  // The hand leans on the wall with three times the continuous force: the limiter gives way, slowly.
  const DeviceInfo device = devices::find_device_profile("PHANToM Premium 1.5").value();
  const Surface surface = stable_surface(device, 1000.0);
  SimulatedSettings settings = pressing_hand(device, surface, 1000.0);
  const double target = -3.0 * device.continuous_force / settings.hand.stiffness;
  settings.trajectory = [target](double t) { return Vector3(0, 0, t < 0.6 ? 0.02 : target); };
  const PressOutcome outcome = press(settings, surface, 60.0, {.limited = true});
  EXPECT_GE(outcome.least_energy, -kNoEnergy);
  EXPECT_LE(outcome.largest_force, device.max_force);
  // In the end the device gives its continuous force, so the hand's spring holds that much.
  EXPECT_NEAR(outcome.end.z() - target, device.continuous_force / settings.hand.stiffness, 1e-5);
  EXPECT_LT(outcome.last_speed, 1e-4);
}

}  // namespace
}  // namespace icome::haptics
