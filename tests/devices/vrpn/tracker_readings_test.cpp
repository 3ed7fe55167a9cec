#include "devices/vrpn/tracker_readings.h"

#include <gtest/gtest.h>

#include <cmath>

namespace icome::devices::vrpn {
namespace {

/// A message about the device that came at `seconds`, by the server's clock too.
bool take(TrackerReadings& readings, Kind kind, const Payload& payload, double seconds) {
  Message message;
  message.time = 1'000'000 + static_cast<std::int64_t>(std::lround(1e6 * seconds));
  message.payload = payload.bytes();
  return readings.take(kind, message, static_cast<std::int64_t>(1e9 * seconds));
}

PosQuat pose_at(const Vector3& position, std::int32_t sensor = 0) {
  PosQuat pose;
  pose.sensor = sensor;
  pose.position = position;
  return pose;
}

TEST(VrpnReadings, KnownPosesComeInOurAxesAndMetres) {
  // A tracker in mm whose x points right, y away from the user and z up.
  auto address = VrpnAddress::parse("Tracker0@host?axes=x,z,-y&scale=0.001");
  ASSERT_TRUE(address);
  TrackerReadings readings(*address);
  PosQuat pose = pose_at({100, 200, 300});
  // A quarter turn about its z (up) is one about our y.
  pose.orientation = Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ());
  EXPECT_TRUE(take(readings, Kind::PosQuat, pack(pose), 0.0));
  EXPECT_TRUE(readings.state().position.isApprox(Vector3(0.1, 0.3, -0.2)));
  const Quaternion about_y(Eigen::AngleAxisd(M_PI / 2, Vector3::UnitY()));
  EXPECT_LT(readings.state().orientation.angularDistance(about_y), 1e-12);
  take(readings, Kind::Velocity, pack(Velocity{0, {0, 1000, 0}}), 0.0);
  EXPECT_TRUE(readings.state().velocity.isApprox(Vector3(0, 0, -1)));
}

TEST(VrpnReadings, OnlyTheSensorThatWasAskedForMoves) {
  TrackerReadings readings(VrpnAddress{.sensor = 1});
  EXPECT_FALSE(take(readings, Kind::PosQuat, pack(pose_at({1, 0, 0}, 0)), 0.0));
  EXPECT_TRUE(take(readings, Kind::PosQuat, pack(pose_at({2, 0, 0}, 1)), 0.0));
  EXPECT_EQ(readings.state().position.x(), 2.0);
}

TEST(VrpnReadings, ButtonsAndAGrip) {
  TrackerReadings readings(VrpnAddress{.grip = 1});
  EXPECT_FALSE(take(readings, Kind::ButtonChange, pack(Button{3, true}), 0.0)) << "no pose is known yet";
  take(readings, Kind::PosQuat, pack(pose_at({0, 0, 0})), 0.0);
  EXPECT_EQ(readings.state().buttons, 8U);
  EXPECT_TRUE(take(readings, Kind::ButtonChange, pack(Button{0, true}), 0.0));
  EXPECT_EQ(readings.state().buttons, 9U);
  take(readings, Kind::ButtonChange, pack(Button{3, false}), 0.0);
  EXPECT_EQ(readings.state().buttons, 1U);
  EXPECT_FALSE(take(readings, Kind::ButtonChange, pack(Button{77, true}), 0.0));
  EXPECT_TRUE(take(readings, Kind::ButtonStates, pack_buttons(6, 3), 0.0));
  EXPECT_EQ(readings.state().buttons, 6U);
  EXPECT_TRUE(take(readings, Kind::AnalogChannel, Payload().put(2.0).put(0.1).put(0.75), 0.0));
  EXPECT_EQ(readings.state().grip, 0.75);
}

TEST(VrpnReadings, VelocityIsTheSlopeOfTheLastTenMilliseconds) {
  TrackerReadings readings((VrpnAddress()));
  // At rest, then 0.2 m/s: after 10 ms nothing is left of the rest.
  for (int i = 0; i < 50; ++i) take(readings, Kind::PosQuat, pack(pose_at({0, 0, 0})), 0.001 * i);
  for (int i = 0; i < 12; ++i)
    take(readings, Kind::PosQuat, pack(pose_at({0, 0.0002 * i, 0})), 0.05 + 0.001 * i);
  EXPECT_NEAR(readings.state().velocity.y(), 0.2, 1e-9);
  // Noise of 10 micrometres: a difference of two would be off by some 14 mm/s.
  double worst = 0.0;
  for (int i = 12; i < 200; ++i) {
    const double noise = 1e-5 * std::sin(2.4 * i);
    take(readings, Kind::PosQuat, pack(pose_at({0, 0.0002 * i + noise, 0})), 0.05 + 0.001 * i);
    worst = std::max(worst, std::abs(readings.state().velocity.y() - 0.2));
  }
  EXPECT_LT(worst, 0.004);
}

TEST(VrpnReadings, ASlowTrackerHasTheSlopeOfTwoReadings) {
  TrackerReadings readings((VrpnAddress()));
  take(readings, Kind::PosQuat, pack(pose_at({0, 0, 0})), 0.0);
  EXPECT_EQ(readings.state().velocity, Vector3::Zero());
  take(readings, Kind::PosQuat, pack(pose_at({0.01, 0, 0})), 0.02);
  EXPECT_NEAR(readings.state().velocity.x(), 0.5, 1e-9);
  take(readings, Kind::PosQuat, pack(pose_at({1, 0, 0})), 5.0);
  EXPECT_EQ(readings.state().velocity, Vector3::Zero()) << "after a long rest nothing is known";
  take(readings, Kind::PosQuat, pack(pose_at({2, 0, 0})), 4.0);
  EXPECT_EQ(readings.state().velocity, Vector3::Zero()) << "a clock that runs back";
}

TEST(VrpnReadings, TheSlopeBeginsAnewAtAJump) {
  TrackerReadings readings((VrpnAddress()));
  for (int i = 0; i < 20; ++i) take(readings, Kind::PosQuat, pack(pose_at({0, 0.0002 * i, 0})), 0.001 * i);
  EXPECT_NEAR(readings.state().velocity.y(), 0.2, 1e-9);
  // Half a metre aside, and there 0.1 m/s back.
  take(readings, Kind::PosQuat, pack(pose_at({0.5, 0, 0})), 0.02);
  EXPECT_EQ(readings.state().velocity, Vector3::Zero());
  for (int i = 1; i < 12; ++i) {
    take(readings, Kind::PosQuat, pack(pose_at({0.5, -0.0001 * i, 0})), 0.02 + 0.001 * i);
    EXPECT_LT((readings.state().velocity - Vector3(0, -0.1, 0)).norm(), 1e-9);
  }
  // A slow tracker, whose jump is farther than a hand comes in that time.
  take(readings, Kind::PosQuat, pack(pose_at({0.5, 5.0, 0})), 0.2);
  EXPECT_EQ(readings.state().velocity, Vector3::Zero());
}

TEST(VrpnReadings, TheTrackersOwnVelocityComesFirst) {
  TrackerReadings readings((VrpnAddress()));
  take(readings, Kind::PosQuat, pack(pose_at({0, 0, 0})), 0.001);
  take(readings, Kind::Velocity, pack(Velocity{0, {0.3, 0, 0}}), 0.001);
  take(readings, Kind::PosQuat, pack(pose_at({0.0005, 0, 0})), 0.002);
  EXPECT_EQ(readings.state().velocity.x(), 0.3);
  take(readings, Kind::PosQuat, pack(pose_at({0.1, 0, 0})), 0.2);
  EXPECT_NEAR(readings.state().velocity.x(), 0.0995 / 0.198, 1e-6) << "it tells none any more";
}

}  // namespace
}  // namespace icome::devices::vrpn
