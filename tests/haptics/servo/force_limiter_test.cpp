#include "haptics/servo/force_limiter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.h"

namespace icome::haptics {
namespace {

constexpr double kLimiterStep = 1e-3;  // s

devices::DeviceInfo premium_device() {
  return {.name = "premium", .max_force = 8.5, .continuous_force = 1.4};
}

LimiterSettings without_ramp() {
  LimiterSettings settings;
  settings.ramp_seconds = 0.0;
  settings.max_rate = 1e9;
  return settings;
}

double infinite_number() { return std::numeric_limits<double>::infinity(); }
double not_a_number() { return std::numeric_limits<double>::quiet_NaN(); }

// Lets the ramp-in pass without heating the motors.
void finish_ramp(ForceLimiter& limiter) {
  for (int tick = 0; tick < 600; ++tick) limiter.limit(Vector3::Zero(), kLimiterStep);
}

TEST(ForceLimiter, SmallForcePassesUnchanged) {
  ForceLimiter limiter(premium_device());
  finish_ramp(limiter);
  const Vector3 wanted(0.3, -0.4, 0.5);
  EXPECT_EQ(limiter.limit(wanted, kLimiterStep), wanted);
  for (std::size_t act = 0; act < kLimiterActs; ++act) {
    EXPECT_EQ(limiter.count(static_cast<LimiterAct>(act)), 0u) << act;
  }
}

TEST(ForceLimiter, ClampsToTheMaximumAndKeepsTheDirection) {
  ForceLimiter limiter(premium_device(), without_ramp());
  const Vector3 force = limiter.limit(Vector3(30, -40, 0), kLimiterStep);
  EXPECT_NEAR((force - Vector3(5.1, -6.8, 0)).norm(), 0.0, 1e-12);
  EXPECT_TRUE(limiter.acted(LimiterAct::Clamped));
  EXPECT_EQ(limiter.count(LimiterAct::Clamped), 1u);
}

TEST(ForceLimiter, ClampsForcesWhoseSquareOverflows) {
  ForceLimiter limiter(premium_device(), without_ramp());
  const Vector3 force = limiter.limit(Vector3(1e308, 1e308, -1e308), kLimiterStep);
  EXPECT_NEAR(force.norm(), 8.5, 1e-12);
  EXPECT_NEAR(force.x(), -force.z(), 1e-12);
}

TEST(ForceLimiter, StartsWithoutARamp) {
  ForceLimiter limiter(premium_device());
  EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), kLimiterStep), Vector3(1, 0, 0));
  EXPECT_FALSE(limiter.acted(LimiterAct::RampedIn));
}

TEST(ForceLimiter, RampsInOverTheGivenTime) {
  ForceLimiter limiter(premium_device());  // 0.5 s
  limiter.restart();
  std::vector<double> force;
  for (int tick = 0; tick < 600; ++tick) force.push_back(limiter.limit(Vector3(1, 0, 0), kLimiterStep).x());
  EXPECT_NEAR(force[0], 0.002, 1e-12);
  EXPECT_NEAR(force[249], 0.5, 1e-9);
  EXPECT_NEAR(force[499], 1.0, 1e-9);
  EXPECT_TRUE(std::is_sorted(force.begin(), force.end()));
  EXPECT_NEAR(static_cast<double>(limiter.count(LimiterAct::RampedIn)), 500, 1);
}

TEST(ForceLimiter, RampsInAgainWhenTheTipStartsInsideAnObject) {
  ForceLimiter limiter(premium_device());
  finish_ramp(limiter);
  LimiterInput inside{.started_inside = true};
  double last = 0.0;
  for (int tick = 0; tick < 400; ++tick) {  // a deep start would want 50 N at once
    const double force = limiter.limit(Vector3(0, 0, 50), kLimiterStep, inside).norm();
    ASSERT_LE(force - last, 8.5 / 500.0 + 1e-9);
    last = force;
  }
  EXPECT_NEAR(last, 8.5 * 0.8, 1e-6);  // one ramp, not one a tick
}

TEST(ForceLimiter, ZeroOnEveryKindOfNonFiniteValueThenRampsIn) {
  for (const double bad : {not_a_number(), infinite_number(), -infinite_number()}) {
    for (int axis = 0; axis < 3; ++axis) {
      ForceLimiter limiter(premium_device());
      finish_ramp(limiter);
      limiter.limit(Vector3(1, 1, 1), kLimiterStep);
      Vector3 wanted(1, 1, 1);
      wanted[axis] = bad;
      EXPECT_EQ(limiter.limit(wanted, kLimiterStep), Vector3::Zero());
      EXPECT_TRUE(limiter.acted(LimiterAct::NotFinite));
      EXPECT_NEAR(limiter.limit(Vector3(1, 0, 0), kLimiterStep).x(), 0.002, 1e-12);
      EXPECT_FALSE(limiter.acted(LimiterAct::NotFinite));
    }
  }
}

TEST(ForceLimiter, ZeroOnATimeStepThatIsNone) {
  for (const double bad : {not_a_number(), infinite_number(), 0.0, -1e-3}) {
    ForceLimiter limiter(premium_device(), without_ramp());
    EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), bad), Vector3::Zero()) << bad;
    EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), kLimiterStep), Vector3(1, 0, 0));
  }
}

TEST(ForceLimiter, ZeroOnAStalledSourceThenRampsIn) {
  ForceLimiter limiter(premium_device());  // 10 ticks
  finish_ramp(limiter);
  const LimiterInput stale{.source_fresh = false};
  for (int tick = 0; tick < 9; ++tick) {
    EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), kLimiterStep, stale), Vector3(1, 0, 0)) << tick;
  }
  for (int tick = 0; tick < 50; ++tick) {
    EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), kLimiterStep, stale), Vector3::Zero());
    EXPECT_TRUE(limiter.acted(LimiterAct::Stalled));
  }
  EXPECT_NEAR(limiter.limit(Vector3(1, 0, 0), kLimiterStep).x(), 0.002, 1e-12);
}

TEST(ForceLimiter, OneFreshTickRestartsTheStallCount) {
  ForceLimiter limiter(premium_device());
  finish_ramp(limiter);
  for (int tick = 0; tick < 100; ++tick) {
    EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), kLimiterStep, {.source_fresh = tick % 10 == 9}),
              Vector3(1, 0, 0));
  }
}

TEST(ForceLimiter, ZeroOnALostDeviceThenRampsIn) {
  ForceLimiter limiter(premium_device());
  finish_ramp(limiter);
  limiter.limit(Vector3(1, 0, 0), kLimiterStep);
  EXPECT_EQ(limiter.limit(Vector3(1, 0, 0), kLimiterStep, {.device_ok = false}), Vector3::Zero());
  EXPECT_TRUE(limiter.acted(LimiterAct::DeviceLost));
  EXPECT_NEAR(limiter.limit(Vector3(1, 0, 0), kLimiterStep).x(), 0.002, 1e-12);
}

TEST(ForceLimiter, ChangesAtMostAtTheRate) {
  LimiterSettings settings;
  settings.max_rate = 500.0;  // 0.5 N a tick
  ForceLimiter limiter(premium_device(), settings);
  finish_ramp(limiter);
  EXPECT_NEAR(limiter.limit(Vector3(0, 2, 0), kLimiterStep).y(), 0.5, 1e-12);
  EXPECT_TRUE(limiter.acted(LimiterAct::RateLimited));
  EXPECT_NEAR(limiter.limit(Vector3(0, 2, 0), kLimiterStep).y(), 1.0, 1e-12);
  EXPECT_NEAR(limiter.limit(Vector3(0, -2, 0), kLimiterStep).y(), 0.5, 1e-12);
  EXPECT_NEAR(limiter.limit(Vector3(0, 0.7, 0), kLimiterStep).y(), 0.7, 1e-12);
  EXPECT_FALSE(limiter.acted(LimiterAct::RateLimited));
}

TEST(ForceLimiter, RateHoldsWhileTheRatingComesDown) {
  LimiterSettings settings = without_ramp();
  settings.thermal_seconds = 5.0;
  settings.max_rate = 70.0;  // N/s, little above the rating's own decline of up to 63 N/s
  ForceLimiter limiter(premium_device(), settings);
  Vector3 last = Vector3::Zero();
  for (int tick = 0; tick < 20000; ++tick) {
    const double angle = tick * 5e-3;
    const Vector3 force = limiter.limit(20.0 * Vector3(std::cos(angle), std::sin(angle), 0), kLimiterStep);
    ASSERT_LE((force - last).norm(), 0.07 * (1.0 + 1e-9)) << tick;
    last = force;
  }
}

TEST(ForceLimiter, ALateTickMovesNoFurtherThanTheLongestStep) {
  LimiterSettings settings;
  settings.max_rate = 100.0;
  ForceLimiter limiter(premium_device(), settings);
  finish_ramp(limiter);
  EXPECT_NEAR(limiter.limit(Vector3(5, 0, 0), 3.0).x(), 1.0, 1e-12);  // 100 N/s for 0.01 s
}

TEST(ForceLimiter, SustainedForceComesDownToTheContinuousRatingSmoothly) {
  ForceLimiter limiter(premium_device(), without_ramp());
  double last = 8.5, seconds_at_peak = 0.0;
  for (int tick = 0; tick < 20000; ++tick) {
    const double force = limiter.limit(Vector3(0, 0, -20), kLimiterStep).norm();
    ASSERT_LE(force, last + 1e-12);         // only downwards
    ASSERT_LE(last - force, 0.07) << tick;  // and without a jump
    if (force > 8.49) seconds_at_peak += kLimiterStep;
    last = force;
  }
  // Half the budget is free at peak: -20 s ln(1 - 0.5 * 1.4^2/8.5^2).
  EXPECT_NEAR(seconds_at_peak, -20.0 * std::log(1.0 - 0.5 * 1.96 / 72.25), 0.005);
  EXPECT_NEAR(last, 1.4, 1e-6);
  EXPECT_NEAR(limiter.heat(), 1.0, 1e-6);
  EXPECT_TRUE(limiter.acted(LimiterAct::Continuous));
}

TEST(ForceLimiter, ContinuousForceMayLastForEver) {
  ForceLimiter limiter(premium_device(), without_ramp());
  for (int tick = 0; tick < 200000; ++tick) {
    ASSERT_NEAR(limiter.limit(Vector3(1.399, 0, 0), kLimiterStep).x(), 1.399, 1e-12) << tick;
  }
}

TEST(ForceLimiter, RestCoolsTheMotors) {
  ForceLimiter limiter(premium_device(), without_ramp());
  for (int tick = 0; tick < 20000; ++tick) limiter.limit(Vector3(0, 0, -20), kLimiterStep);
  for (int tick = 0; tick < 20000; ++tick) limiter.limit(Vector3::Zero(), kLimiterStep);
  EXPECT_NEAR(limiter.heat(), std::exp(-1.0), 1e-3);
  EXPECT_NEAR(limiter.limit(Vector3(0, 0, -20), kLimiterStep).norm(), 8.5, 1e-9);
}

TEST(ForceLimiter, ReconnectingDoesNotCoolTheMotors) {
  ForceLimiter limiter(premium_device(), without_ramp());
  for (int tick = 0; tick < 20000; ++tick) limiter.limit(Vector3(0, 0, -20), kLimiterStep);
  limiter.restart();
  EXPECT_LT(limiter.limit(Vector3(0, 0, -20), kLimiterStep).norm(), 1.5);
}

TEST(ForceLimiter, DeviceWithoutSensibleLimitsGetsNoForce) {
  for (const double bad : {0.0, -1.0, not_a_number(), infinite_number()}) {
    devices::DeviceInfo device = premium_device();
    device.max_force = bad;
    ForceLimiter limiter(device);
    for (int tick = 0; tick < 1000; ++tick) {
      EXPECT_EQ(limiter.limit(Vector3(1, 2, 3), kLimiterStep), Vector3::Zero());
    }
    EXPECT_EQ(limiter.limit(Vector3(1e-200, 0, 0), kLimiterStep), Vector3::Zero());
  }
}

// A wanted force, step or state of the kind that bugs produce.
Vector3 nasty_force(base::Random& random) {
  switch (random.index(8)) {
    case 0:
      return Vector3::Zero();
    case 1:
      return random.uniform(0, 1e-300) * random.direction();
    case 2:
      return 1e300 * random.direction();
    case 3:
      return Vector3(not_a_number(), 1, 2);
    case 4:
      return Vector3(1, -infinite_number(), 2);
    default:
      return random.uniform(0, 30) * random.direction();
  }
}

TEST(ForceLimiter, HoldsEveryGuaranteeAgainstRandomAdversaries) {
  base::Random random(11);
  for (int run = 0; run < 40; ++run) {
    devices::DeviceInfo device{.name = "", .max_force = random.uniform(0.5, 25)};
    device.continuous_force = random.uniform(0.14, 1.0) * device.max_force;
    LimiterSettings settings;
    settings.ramp_seconds = random.uniform(0, 0.2);
    settings.thermal_seconds = random.uniform(5, 60);
    settings.max_rate = random.uniform(300, 10000);  // above the thermal decline, <= 51 * 25 N / 5 s
    ForceLimiter limiter(device, settings);
    Vector3 last = Vector3::Zero();
    double mean_square = 0.0;  // the rating's definition, computed again here
    // A steady force for a while, then another: sustained loads as well as noise.
    Vector3 steady = nasty_force(random);
    for (int tick = 0; tick < 20000; ++tick) {
      if (random.index(500) == 0) steady = nasty_force(random);
      const Vector3 wanted = random.index(4) == 0 ? nasty_force(random) : steady;
      const double dt = random.uniform(1e-4, 5e-3);
      const LimiterInput input{.source_fresh = random.index(3) != 0,
                               .device_ok = random.index(1000) != 0,
                               .started_inside = random.index(300) == 0};
      const Vector3 force = limiter.limit(wanted, dt, input);
      ASSERT_TRUE(force.allFinite());
      ASSERT_LE(force.norm(), device.max_force);
      mean_square += (1.0 - std::exp(-dt / settings.thermal_seconds)) * (force.squaredNorm() - mean_square);
      ASSERT_LE(mean_square, device.continuous_force * device.continuous_force * (1.0 + 1e-9));
      if (!wanted.allFinite() || !input.device_ok) {
        ASSERT_EQ(force, Vector3::Zero());
      } else if (!force.isZero(0.0)) {
        ASSERT_LE((force - last).norm(), settings.max_rate * dt * (1.0 + 1e-9) + 1e-12);
      }
      last = force;
    }
  }
}

TEST(ForceLimiter, LengthLimitsKeepTheDirectionOfRandomForces) {
  base::Random random(12);
  ForceLimiter limiter(premium_device(), without_ramp());
  for (int tick = 0; tick < 20000; ++tick) {
    const Vector3 wanted = random.uniform(0.1, 100.0) * random.direction();
    const Vector3 force = limiter.limit(wanted, kLimiterStep);
    ASSERT_NEAR(force.normalized().dot(wanted.normalized()), 1.0, 1e-12);
  }
}

TEST(ForceLimiter, SameCallsGiveTheSameBits) {
  ForceLimiter a(premium_device()), b(premium_device());
  base::Random random(13);
  for (int tick = 0; tick < 5000; ++tick) {
    const Vector3 wanted = random.uniform(0, 20) * random.direction();
    ASSERT_EQ(a.limit(wanted, kLimiterStep), b.limit(wanted, kLimiterStep));
  }
}

}  // namespace
}  // namespace icome::haptics
