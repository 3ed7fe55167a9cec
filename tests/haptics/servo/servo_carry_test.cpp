// A device's workspace that is carried through the world, as by a camera that one flies.
#include <gtest/gtest.h>

#include "base/random.h"
#include "haptics/contact_world.h"
#include "haptics/judge/contact_judge.h"
#include "haptics/servo/servo.h"
#include "haptics/servo/servo_fixture.h"
#include "realtime/guard/guard.h"

namespace icome::haptics {
namespace {

constexpr double kPeriod = 1e-3;

TEST(Servo, BeginsAnewWhereADeviceHasJumpedTo) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.publish(box_scene());
  device.position.z() = 0.06;
  servo.tick(kPeriod);
  device.position.z() = 0.049;
  servo.tick(kPeriod);
  EXPECT_TRUE(servo.last().contact.touching);
  // Without a jump the SCP would stay on this side.
  device.position.z() = -0.06;
  device.jumped = true;
  servo.tick(kPeriod);
  EXPECT_FALSE(servo.last().contact.touching);
  EXPECT_EQ(servo.last().contact.scp, servo.last().tip);
  device.jumped = false;
  device.position.z() = -0.049;
  for (int i = 0; i < 10; ++i) servo.tick(kPeriod);
  EXPECT_NEAR(servo.last().contact.scp.z(), -0.05, 1e-9);
  EXPECT_LT(servo.last().force.z(), 0.0);
}

TEST(Servo, FeelsNothingWhereADeviceLiesAside) {
  ScriptedDevice device;
  Servo servo(device, {});
  servo.publish(box_scene());
  device.position.z() = 0.06;
  servo.tick(kPeriod);
  device.position.z() = 0.045;
  for (int i = 0; i < 20; ++i) servo.tick(kPeriod);
  EXPECT_GT(device.force.z(), 1.0);
  const auto expect_nothing = [&] {
    servo.tick(kPeriod);
    EXPECT_FALSE(servo.last().contact.touching);
    EXPECT_EQ(servo.last().contact.scp, servo.last().tip);
  };
  device.parked = true;
  for (int i = 0; i < 20; ++i) expect_nothing();
  EXPECT_EQ(device.force, Vector3::Zero());
  // Whatever happens within the solid: it jumps, another scene comes, nothing is heard of it for a tick.
  device.position.z() = 0.0;
  device.jumped = true;
  expect_nothing();
  device.jumped = false;
  servo.publish(box_scene(0.01));
  device.status = DeviceStatus::Stalled;
  expect_nothing();
  device.status = DeviceStatus::Ok;
  expect_nothing();
  EXPECT_EQ(device.force, Vector3::Zero());
  // Taken up again, it is within a solid that puts it out.
  device.parked = false;
  servo.tick(kPeriod);
  EXPECT_TRUE(servo.last().contact.touching && servo.last().contact.started_inside);
}

TEST(ServoCarry, CarriesARestingTipThroughFreeSpaceWithoutForce) {
  ScriptedDevice device;
  device.position = {0.0, 0.01, 0.2};
  Servo servo(device, {});
  servo.publish(box_scene());
  servo.tick(kPeriod);
  Pose goal = Pose::Identity();
  Vector3 last = servo.last().tip;
  for (int step = 1; step <= 20; ++step) {
    goal.translation().x() = 0.01 * step;
    servo.carry(goal);
    for (int i = 0; i < 16; ++i) {  // as often as a screen is drawn
      servo.tick(kPeriod);
      ASSERT_EQ(device.force, Vector3::Zero());
      ASSERT_FALSE(servo.last().contact.touching);
      const double moved = servo.last().tip.x() - last.x();
      ASSERT_GE(moved, 0.0);
      ASSERT_LE(moved, 0.01 * 0.1);  // in steps, not at once
      last = servo.last().tip;
    }
  }
  for (int i = 0; i < 25; ++i) servo.tick(kPeriod);
  EXPECT_EQ(servo.last().tip, Vector3(goal * device.position));
  EXPECT_EQ(device.force, Vector3::Zero());
}

TEST(ServoCarry, StopsAtAWallHoweverItIsCarried) {
  base::Random random(4711);
  const auto box = primitive("box:0.1x0.1x0.1");
  for (int run = 0; run < 4; ++run) {
    ScriptedDevice device;
    device.position = {0.0, 0.0, 0.08};
    Servo servo(device, {});
    servo.publish(box_scene());
    ContactJudge judge({JudgedObject{box}}, {});
    bool touched = false;
    for (int step = 0; step < 12; ++step) {
      Pose goal = Pose::Identity();
      // Through the box and beyond, turned about, too.
      goal.translation() = random.uniform(0.0, 0.15) * random.direction() - Vector3(0.0, 0.0, 0.08);
      goal.linear() = Eigen::AngleAxisd(random.uniform(0.0, 1.0), random.direction()).toRotationMatrix();
      servo.carry(goal);
      for (int i = 0; i < 16; ++i) {
        const TickReport& report = servo.tick(kPeriod);
        judge.judge({report.tip, report.contact.scp, report.contact.touching});
        touched = touched || report.contact.touching;
        ASSERT_LE(device.force.norm(), device.info().max_force);
      }
    }
    EXPECT_TRUE(touched);
    EXPECT_EQ(judge.pops(), 0U);
    EXPECT_EQ(judge.sticks(), 0U);
  }
}

TEST(ServoCarry, GivesTheForceInTheDevicesOwnFrame) {
  ScriptedDevice device;
  device.position = {0.0, 0.0, 0.06};
  Servo servo(device, {});
  servo.publish(box_scene());
  servo.tick(kPeriod);
  // About the box: what was its top, seen from the device, is a side of it.
  Pose goal = Pose::Identity();
  goal.linear() = Eigen::AngleAxisd(0.5 * 3.14159265358979, Vector3::UnitY()).toRotationMatrix();
  servo.carry(goal);
  for (int i = 0; i < 25; ++i) servo.tick(kPeriod);
  for (int i = 0; i < 300; ++i) {
    device.position.z() = 0.06 - 0.0105 * std::min(1.0, i / 100.0);
    servo.tick(kPeriod);
  }
  EXPECT_NEAR(servo.last().contact.normal.x(), 1.0, 1e-9);
  EXPECT_NEAR(device.force.z(), 0.5, 1e-6);
  EXPECT_NEAR(device.force.head<2>().norm(), 0.0, 1e-6);
}

TEST(ServoCarry, TakesALostDeviceAlongWithoutForce) {
  ScriptedDevice device;
  device.position = {0.0, 0.0, 0.0501};
  Servo servo(device, {});
  servo.publish(box_scene());
  servo.tick(kPeriod);
  device.status = DeviceStatus::Lost;
  Pose goal = Pose::Identity();
  goal.translation().z() = -0.02;
  servo.carry(goal);
  for (int i = 0; i < 30; ++i) {
    servo.tick(kPeriod);
    ASSERT_EQ(device.force, Vector3::Zero());
  }
  EXPECT_NEAR(servo.last().contact.scp.z(), 0.05, 1e-6);  // it was swept there, and stays outside
  device.status = DeviceStatus::Ok;
  double last = 0.0;
  for (int i = 0; i < 1000; ++i) {
    servo.tick(kPeriod);
    ASSERT_LE(std::abs(device.force.norm() - last), 0.05 * device.info().max_force);
    last = device.force.norm();
  }
  EXPECT_GT(last, 1.0);
}

TEST(ServoCarry, TakesNoMemoryAndNoLocks) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "sanitizers need these functions themselves";
  ScriptedDevice device;
  device.position = {0.0, 0.0, 0.06};
  Servo servo(device, {});
  servo.publish(box_scene());
  servo.tick(kPeriod);
  realtime::RealtimeGuard guard;
  Pose goal = Pose::Identity();
  for (int i = 0; i < 500; ++i) {
    goal.translation().z() = i % 100 < 50 ? -0.03 : 0.0;
    servo.carry(goal);
    servo.tick(kPeriod);
  }
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0U);
  EXPECT_EQ(guard.frees(), 0U);
  EXPECT_EQ(guard.locks(), 0U);
}

}  // namespace
}  // namespace icome::haptics
