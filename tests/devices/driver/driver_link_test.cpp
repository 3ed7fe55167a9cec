#include "devices/driver/driver_link.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "realtime/guard/guard.h"
#include "repeats.h"

namespace icome::devices {
namespace {

constexpr std::int64_t kMillisecond = 1'000'000;  // ns
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

DeviceInfo touch_like() { return {.name = "link", .workspace_radius = 0.1, .max_force = 3.0}; }

PointerState reading_at(double x, double y = 0.0, double z = 0.0) {
  PointerState state;
  state.position = {x, y, z};
  return state;
}

/// A link to a connected device, with a clock of its own.
class DriverLinkTest : public testing::Test {
 public:
  DriverLinkTest() { link.connect(touch_like()); }

  DeviceStatus passed(const PointerState& reading) {
    now += kMillisecond;
    link.pass(reading, now);
    return link.read(state);
  }

  /// The force after `milliseconds` of a servo that asks for `asked` in each.
  Vector3 force_after(int milliseconds, const Vector3& asked) {
    Vector3 force = Vector3::Zero();
    for (int i = 0; i < milliseconds; ++i) {
      now += kMillisecond;
      link.write(asked, now);
      force = link.force(now);
    }
    return force;
  }

  /// Likewise with a hand that keeps at a place, as still as hands are.
  Vector3 held_force_after(int milliseconds, const Vector3& asked, double x = 0.0) {
    Vector3 force = Vector3::Zero();
    for (int i = 0; i < milliseconds; ++i) {
      link.pass(reading_at(x + 1e-6 * (i % 2)), now + kMillisecond);
      force = force_after(1, asked);
    }
    return force;
  }

  bool tells(const char* words) const { return link.condition().find(words) != std::string::npos; }

  DriverLink link{touch_like()};
  PointerState state;
  std::int64_t now = 1000 * kMillisecond;
};

TEST_F(DriverLinkTest, GivesTheNewestReadingOnce) {
  EXPECT_EQ(link.read(state), DeviceStatus::Stalled);
  EXPECT_EQ(passed(reading_at(0.01)), DeviceStatus::Ok);
  EXPECT_EQ(state.position.x(), 0.01);
  EXPECT_EQ(link.read(state), DeviceStatus::Stalled);
  EXPECT_EQ(state.position.x(), 0.01) << "an old state is kept";
}

TEST_F(DriverLinkTest, IsLostWhileNothingIsConnected) {
  link.disconnect("It was unplugged.");
  EXPECT_EQ(link.read(state), DeviceStatus::Lost);
  EXPECT_EQ(link.write(Vector3::Zero(), now), DeviceStatus::Lost);
  EXPECT_EQ(link.condition(), "It was unplugged.");
  link.connect(touch_like());
  EXPECT_EQ(link.condition(), "");
  EXPECT_EQ(passed(reading_at(0.05)), DeviceStatus::Ok);
  EXPECT_TRUE(state.jumped) << "where it comes back is no way of a hand";
}

TEST_F(DriverLinkTest, RefusesWhatIsNoNumber) {
  PointerState bad = reading_at(kNoNumber);
  EXPECT_EQ(passed(bad), DeviceStatus::Stalled);
  bad = reading_at(0.0);
  bad.velocity.y() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(passed(bad), DeviceStatus::Stalled);
  bad = reading_at(0.0);
  bad.orientation.w() = kNoNumber;
  EXPECT_EQ(passed(bad), DeviceStatus::Stalled);
  EXPECT_EQ(link.counts().not_finite, 3u);
}

TEST_F(DriverLinkTest, RefusesWhatNoDeviceReaches) {
  EXPECT_EQ(passed(reading_at(0.0, 5.0)), DeviceStatus::Stalled);
  EXPECT_EQ(link.counts().far_away, 1u);
}

TEST_F(DriverLinkTest, RefusesASpikeButFollowsAJumpThatLasts) {
  EXPECT_EQ(passed(reading_at(0.0)), DeviceStatus::Ok);
  EXPECT_EQ(passed(reading_at(0.1)), DeviceStatus::Stalled);
  EXPECT_EQ(passed(reading_at(0.001)), DeviceStatus::Ok);
  EXPECT_FALSE(state.jumped);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(passed(reading_at(0.1)), DeviceStatus::Stalled);
  EXPECT_EQ(passed(reading_at(0.1)), DeviceStatus::Ok);
  EXPECT_TRUE(state.jumped);
  EXPECT_EQ(passed(reading_at(0.1)), DeviceStatus::Ok);
  EXPECT_FALSE(state.jumped);
  EXPECT_EQ(link.counts().spikes, 4u);
}

TEST_F(DriverLinkTest, AJumpThatTheDriverToldCountsAlsoWhereItsReadingWasReplaced) {
  ASSERT_EQ(passed(reading_at(0.0)), DeviceStatus::Ok);
  PointerState jumped = reading_at(0.001);
  jumped.jumped = true;
  link.pass(jumped, now += kMillisecond);
  ASSERT_EQ(passed(reading_at(0.001)), DeviceStatus::Ok);
  EXPECT_TRUE(state.jumped);
  ASSERT_EQ(passed(reading_at(0.001)), DeviceStatus::Ok);
  EXPECT_FALSE(state.jumped);
  // Refused as a spike at first, and soon within a hand's reach.
  jumped = reading_at(0.03);
  jumped.jumped = true;
  EXPECT_EQ(passed(jumped), DeviceStatus::Stalled);
  now += kMillisecond;
  ASSERT_EQ(passed(reading_at(0.03)), DeviceStatus::Ok);
  EXPECT_TRUE(state.jumped);
}

TEST_F(DriverLinkTest, TellsOfAJumpWhoseOwnReadingWasReplaced) {
  EXPECT_EQ(passed(reading_at(0.0)), DeviceStatus::Ok);
  for (int i = 0; i < 6; ++i) link.pass(reading_at(0.1), now += kMillisecond);
  EXPECT_EQ(link.read(state), DeviceStatus::Ok);
  EXPECT_TRUE(state.jumped);
}

TEST_F(DriverLinkTest, FollowsAFastHand) {
  // 5 m/s with some readings missing.
  for (int i = 0; i < 15; ++i) {
    if (i % 5 == 3) {
      now += kMillisecond;
      continue;
    }
    EXPECT_EQ(passed(reading_at(0.005 * i)), DeviceStatus::Ok);
  }
}

TEST_F(DriverLinkTest, MakesRotationsOfOrientations) {
  PointerState reading = reading_at(0.0);
  reading.orientation = Quaternion(0.99, 0.0, 0.2, 0.0);
  EXPECT_EQ(passed(reading), DeviceStatus::Ok);
  EXPECT_NEAR(state.orientation.norm(), 1.0, 1e-12);
  reading.orientation.coeffs().setZero();
  EXPECT_EQ(passed(reading), DeviceStatus::Ok);
  EXPECT_EQ(state.orientation.w(), 1.0);
}

TEST_F(DriverLinkTest, ForcesGrowFromNone) {
  EXPECT_EQ(link.force(now), Vector3::Zero()) << "nothing was asked for yet";
  const Vector3 asked(0, 2, 0);
  EXPECT_LT(force_after(1, asked).norm(), 0.1);
  EXPECT_EQ(force_after(400, asked), asked);
}

TEST_F(DriverLinkTest, TheFirstForceIsNone) {
  link.write({0, 3, 0}, now);
  EXPECT_EQ(link.force(now), Vector3::Zero());
  EXPECT_EQ(force_after(400, {0, 3, 0}), Vector3(0, 3, 0));
  link.connect(touch_like());
  link.write({0, 3, 0}, now += kMillisecond);
  EXPECT_EQ(link.force(now), Vector3::Zero()) << "the ramp begins when the device is back";
}

TEST_F(DriverLinkTest, ForcesGrowFromNoneAfterAJumpThatLasts) {
  const Vector3 asked(0, 2, 0);
  ASSERT_EQ(held_force_after(400, asked), asked);
  ASSERT_EQ(passed(reading_at(0.0)), DeviceStatus::Ok);
  // A spike changes nothing.
  ASSERT_EQ(passed(reading_at(0.1)), DeviceStatus::Stalled);
  EXPECT_EQ(force_after(1, asked), asked);
  ASSERT_EQ(passed(reading_at(0.0)), DeviceStatus::Ok);
  for (int i = 0; i < 3; ++i) ASSERT_EQ(passed(reading_at(0.1)), DeviceStatus::Stalled);
  ASSERT_EQ(passed(reading_at(0.1)), DeviceStatus::Ok);
  EXPECT_LT(force_after(1, asked).norm(), 0.1) << "a blow at the new place";
  EXPECT_EQ(held_force_after(400, asked, 0.1), asked);
}

TEST_F(DriverLinkTest, ReadsNothingOfTheConnectionBefore) {
  link.pass(reading_at(0.03), now += kMillisecond);
  // The servo does not look meanwhile.
  link.disconnect("It was unplugged.");
  link.connect(touch_like());
  EXPECT_EQ(link.read(state), DeviceStatus::Stalled);
  EXPECT_EQ(passed(reading_at(0.01)), DeviceStatus::Ok);
  EXPECT_EQ(state.position.x(), 0.01);
}

TEST_F(DriverLinkTest, NeverGivesMoreThanTheDeviceCan) {
  EXPECT_NEAR(force_after(400, {0, 0, 100}).norm(), 3.0, 1e-12);
  EXPECT_EQ(force_after(1, {0, kNoNumber, 0}), Vector3::Zero());
  DeviceInfo weaker = touch_like();
  weaker.max_force = 1.0;
  link.connect(weaker);
  EXPECT_NEAR(force_after(400, {0, 0, 100}).norm(), 1.0, 1e-12) << "another device was plugged in";
}

TEST_F(DriverLinkTest, TakesAForceAwayThatIsTooOld) {
  const Vector3 asked(0, 2, 0);
  EXPECT_EQ(force_after(400, asked), asked);
  EXPECT_EQ(link.force(now + 9 * kMillisecond), asked);
  EXPECT_EQ(link.force(now + 11 * kMillisecond), Vector3::Zero());
  EXPECT_EQ(link.force(now + 12 * kMillisecond), Vector3::Zero());
  EXPECT_EQ(link.counts().watchdog_stops, 1u);
  now += 12 * kMillisecond;
  EXPECT_LT(force_after(1, asked).norm(), 0.1) << "a blow instead of a ramp";
}

TEST_F(DriverLinkTest, GivesNoForceWhileItIsWithheldAndThenARamp) {
  const Vector3 asked(0, 2, 0);
  ASSERT_EQ(held_force_after(400, asked), asked);
  link.withhold("it has no power; plug it in");
  EXPECT_EQ(held_force_after(1, asked), Vector3::Zero()) << "at once";
  EXPECT_EQ(link.condition(), "No force: it has no power; plug it in");
  EXPECT_EQ(held_force_after(400, asked), Vector3::Zero());
  link.withhold("it is not calibrated");
  EXPECT_EQ(link.condition(), "No force: it is not calibrated");
  link.withhold({});
  EXPECT_LT(held_force_after(1, asked).norm(), 0.1) << "a blow instead of a ramp";
  EXPECT_EQ(link.condition(), "It gives forces again, which grow from none");
  EXPECT_EQ(held_force_after(400, asked), asked);
  EXPECT_EQ(link.counts().watchdog_stops, 0u);
}

TEST_F(DriverLinkTest, WhatIsWithheldEndsWithTheConnection) {
  link.withhold("it has no power");
  link.disconnect("It was unplugged.");
  EXPECT_EQ(link.condition(), "It was unplugged.");
  link.connect(touch_like());
  EXPECT_EQ(link.condition(), "");
  EXPECT_EQ(held_force_after(400, {0, 2, 0}), Vector3(0, 2, 0));
}

TEST_F(DriverLinkTest, GivesNoForceWithoutReadings) {
  const Vector3 asked(0, 2, 0);
  ASSERT_EQ(held_force_after(400, asked), asked);
  EXPECT_EQ(force_after(90, asked), asked);
  EXPECT_EQ(force_after(20, asked), Vector3::Zero()) << "nobody knows where the hand is";
  EXPECT_EQ(link.condition(), "") << "that comes and goes";
  EXPECT_EQ(force_after(1000, asked), Vector3::Zero());
  EXPECT_TRUE(tells("No force: it tells nothing new of its place")) << link.condition();
  EXPECT_LT(held_force_after(1, asked).norm(), 0.1) << "a blow instead of a ramp";
  EXPECT_TRUE(tells("It gives forces again")) << link.condition();
  EXPECT_EQ(held_force_after(400, asked), asked);
}

TEST_F(DriverLinkTest, GivesNoForceWhereReadingsStandStill) {
  const Vector3 asked(0, 2, 0);
  const auto frozen = [&](int milliseconds, const Vector3& force) {
    Vector3 given = Vector3::Zero();
    for (int i = 0; i < milliseconds; ++i) {
      link.pass(reading_at(0.01), now + kMillisecond);
      given = force_after(1, force);
    }
    return given;
  };
  frozen(5000, Vector3::Zero());
  EXPECT_EQ(link.condition(), "") << "a device that lies on the table";
  EXPECT_EQ(frozen(2900, asked), asked);
  EXPECT_EQ(frozen(300, asked), Vector3::Zero());
  EXPECT_TRUE(tells("No force: what it tells of its place stays the same")) << link.condition();
  EXPECT_EQ(frozen(3000, asked), Vector3::Zero()) << "it would push again into the unknown";
  EXPECT_LT(held_force_after(1, asked, 0.011).norm(), 0.1);
  EXPECT_EQ(held_force_after(400, asked, 0.011), asked);
  link.may_keep_still();
  frozen(400, asked);
  EXPECT_EQ(frozen(6000, asked), asked) << "a gamepad";
}

TEST_F(DriverLinkTest, TellsWhereManyReadingsAreRefused) {
  for (int i = 0; i < 3000; ++i) passed(reading_at(i % 500 == 0 ? kNoNumber : 0.0));
  EXPECT_EQ(link.condition(), "") << "now and then one";
  for (int i = 0; i < 2100; ++i) passed(reading_at(i % 2 == 0 ? 0.09 : 0.0));
  EXPECT_TRUE(tells("Some of its readings make no sense and are left out (times so far: 105"))
      << link.condition();
  for (int i = 0; i < 7000; ++i) passed(reading_at(0.0));
  EXPECT_EQ(link.condition(), "") << "it is over";
  for (int i = 0; i < 2100; ++i)
    i % 2 == 0 ? link.leave_out(now += kMillisecond) : (void)passed(reading_at(0.0));
  EXPECT_TRUE(tells("make no sense")) << "those that the driver refused count as well";
}

TEST_F(DriverLinkTest, NeverLetsNonsensePassWhateverComes) {
  base::Random random(7);
  const auto odd = [&random] {
    const double kind = random.uniform(0.0, 1.0);
    if (kind < 0.1) return kNoNumber;
    if (kind < 0.2) return std::numeric_limits<double>::infinity();
    if (kind < 0.3) return random.uniform(-1e300, 1e300);
    return random.uniform(-0.2, 0.2);
  };
  realtime::RealtimeGuard guard;
  for (int i = 0; i < repeats(1'000'000); ++i) {
    now += std::int64_t(random.uniform(-2.0, 20.0) * double(kMillisecond));
    PointerState reading = reading_at(odd(), odd(), odd());
    reading.velocity = {odd(), odd(), odd()};
    reading.orientation.coeffs() << odd(), odd(), odd(), odd();
    link.pass(reading, now);
    if (link.read(state) == DeviceStatus::Ok) {
      ASSERT_TRUE(state.position.allFinite());
      ASSERT_LE(state.velocity.norm(), 20.0 + 1e-9);
      ASSERT_NEAR(state.orientation.norm(), 1.0, 1e-9);
    }
    link.write({odd(), odd(), odd()}, now);
    ASSERT_LE(link.force(now).norm(), 3.0 + 1e-12);
  }
  guard.stop();
  EXPECT_EQ(guard.allocations() + guard.locks(), 0u);
}

}  // namespace
}  // namespace icome::devices
