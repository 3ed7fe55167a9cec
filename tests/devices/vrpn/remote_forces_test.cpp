#include "devices/vrpn/remote_forces.h"

#include <gtest/gtest.h>

#include <limits>

#include "realtime/guard/guard.h"

namespace icome::devices::vrpn {
namespace {

constexpr std::int64_t kMs = 1'000'000;  // ns

/// A floor at a height, as a client would send it.
Plane floor_at(double height, double spring = 0.5, std::int32_t recovery = 1) {
  Plane plane;
  plane.normal = {0, 1, 0};
  plane.offset = -height;
  plane.spring = spring;
  plane.recovery = recovery;
  return plane;
}

/// The first plane of the client in the first slot, felt by a tip.
class Felt {
 public:
  void set(Plane plane) {
    ASSERT_TRUE(tidy(plane, settings_));
    wanted_.clients[0].planes[0] = {plane, ++revision_};
  }
  /// Another client comes into the slot, with its first plane.
  void set_by_another(Plane plane) {
    wanted_.clients[0] = {wanted_.clients[0].client + 1, {}, {}};
    revision_ = 0;
    set(plane);
  }
  void set(ForceField field) {
    ASSERT_TRUE(tidy(field, settings_));
    wanted_.clients[0].field = field;
  }
  Vector3 at(double height, double speed = 0.0, const Vector3& along = Vector3::Zero()) {
    PointerState state;
    state.position = {0, height, 0};
    state.velocity = Vector3(0, speed, 0) + along;
    return in(state);
  }
  Vector3 jumped_to(double height) {
    PointerState state;
    state.position = {0, height, 0};
    state.jumped = true;
    return in(state);
  }

 private:
  Vector3 in(const PointerState& state) {
    now_ += kMs;
    return forces_.force(wanted_, state, now_);
  }

  RemoteForceSettings settings_;
  RemoteForces forces_{settings_};
  WantedForces wanted_;
  std::uint64_t revision_ = 0;
  std::int64_t now_ = 0;
};

TEST(VrpnForces, APlaneIsASpringOnItsBackOnly) {
  Felt felt;
  felt.set(floor_at(0.02));
  EXPECT_EQ(felt.at(0.05), Vector3::Zero());
  EXPECT_NEAR(felt.at(0.018).y(), 1.0, 1e-9) << "500 N/m, 2 mm";
  EXPECT_EQ(felt.at(0.018).x(), 0.0);
  EXPECT_EQ(felt.at(0.0201), Vector3::Zero());
}

TEST(VrpnForces, DampingBrakesAndNeverPulls) {
  Felt felt;
  Plane plane = floor_at(0.0);
  plane.damper = 0.002;  // 2 N s/m
  felt.set(plane);
  felt.at(0.01);
  EXPECT_NEAR(felt.at(-0.002, -0.1).y(), 1.2, 1e-9);
  EXPECT_NEAR(felt.at(-0.002, 0.1).y(), 0.8, 1e-9);
  EXPECT_EQ(felt.at(-0.002, 10.0).y(), 0.0) << "out faster than the spring";
}

TEST(VrpnForces, FrictionIsAgainstTheMotionAlongThePlane) {
  Felt felt;
  Plane plane = floor_at(0.0);
  plane.dynamic_friction = 0.5;
  felt.set(plane);
  felt.at(0.01);
  EXPECT_NEAR(felt.at(-0.002, 0.0, {0.2, 0, 0}).x(), -0.5, 1e-9);
  EXPECT_NEAR(felt.at(-0.002, 0.0, {0.001, 0, 0}).x(), -0.05, 1e-9) << "next to none at rest";
}

TEST(VrpnForces, APlaneUnderTheTipComesWithinItsRecoveryCycles) {
  Felt felt;
  felt.set(floor_at(0.004, 0.5, 10));
  EXPECT_EQ(felt.at(0.0).y(), 0.0) << "it begins at the tip";
  double last = 0.0;
  for (int i = 0; i < 10; ++i) {
    const double force = felt.at(0.0).y();
    EXPECT_NEAR(force - last, 0.2, 1e-6);
    last = force;
  }
  EXPECT_NEAR(felt.at(0.0).y(), 2.0, 1e-6);
  // The plane moves 2 mm up: again within 10 cycles, from where it was.
  felt.set(floor_at(0.006, 0.5, 10));
  EXPECT_NEAR(felt.at(0.0).y(), 2.0, 1e-6);
  EXPECT_NEAR(felt.at(0.0).y(), 2.1, 1e-6);
  for (int i = 0; i < 9; ++i) felt.at(0.0);
  EXPECT_NEAR(felt.at(0.0).y(), 3.0, 1e-6);
}

TEST(VrpnForces, ATipFarBehindANewPlaneIsNotThrownOut) {
  Felt felt;
  felt.set(floor_at(0.05));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(felt.at(0.0), Vector3::Zero());
  EXPECT_EQ(felt.at(0.045), Vector3::Zero()) << "still behind it, though near";
  felt.at(0.06);
  EXPECT_NEAR(felt.at(0.049).y(), 0.5, 1e-9) << "having been in front it is a wall";
}

TEST(VrpnForces, APlaneOfANewClientIsNoChangeOfItsPredecessors) {
  Felt felt;
  felt.set(floor_at(0.0));
  EXPECT_EQ(felt.at(0.001), Vector3::Zero());
  // The predecessor's plane was 1 mm below the tip, and begins nothing here: the new one begins at the tip.
  felt.set_by_another(floor_at(0.005, 0.5, 10));
  EXPECT_EQ(felt.at(0.001).y(), 0.0);
  EXPECT_NEAR(felt.at(0.001).y(), 0.2, 1e-6) << "4 mm at 500 N/m in 10 cycles";
  // Each client's planes are counted from one; this one is deep behind its own.
  felt.set_by_another(floor_at(0.05));
  for (int i = 0; i < 20; ++i) EXPECT_EQ(felt.at(0.001), Vector3::Zero());
}

TEST(VrpnForces, ATipThatJumpedIsNotThrownOut) {
  Felt felt;
  felt.set(floor_at(0.0, 0.5, 10));
  EXPECT_EQ(felt.at(0.01), Vector3::Zero());
  EXPECT_EQ(felt.jumped_to(-0.004), Vector3::Zero()) << "the plane begins at the tip";
  EXPECT_NEAR(felt.at(-0.004).y(), 0.2, 1e-6);
  EXPECT_EQ(felt.jumped_to(-0.05), Vector3::Zero());
  EXPECT_EQ(felt.at(-0.05), Vector3::Zero()) << "far behind it";
}

TEST(VrpnForces, TakenAwayThereIsNothing) {
  Felt felt;
  felt.set(floor_at(0.0));
  felt.at(0.01);
  EXPECT_GT(felt.at(-0.002).y(), 0.5);
  felt.set(Plane());
  EXPECT_EQ(felt.at(-0.002), Vector3::Zero());
}

TEST(VrpnForces, AFieldPushesWithinItsRadius) {
  Felt felt;
  ForceField field;
  field.force = {0.5, 0, 0};
  field.jacobian(1, 1) = -100.0;
  field.radius = 0.02;
  felt.set(field);
  EXPECT_TRUE(felt.at(0.01).isApprox(Vector3(0.5, -1.0, 0)));
  EXPECT_EQ(felt.at(0.021), Vector3::Zero());
  felt.set(ForceField());
  EXPECT_EQ(felt.at(0.01), Vector3::Zero());
}

TEST(VrpnForces, BoundsOfWhatMayBeAskedFor) {
  const RemoteForceSettings settings;
  Plane plane = floor_at(0.0, 1e6);
  plane.normal = {0, 2, 0};
  plane.offset = -0.5;
  plane.damper = 1e9;
  plane.recovery = -5;
  ASSERT_TRUE(tidy(plane, settings));
  EXPECT_EQ(plane.normal, Vector3(0, 1, 0));
  EXPECT_EQ(plane.offset, -0.25);
  EXPECT_EQ(plane.spring, settings.max_stiffness);
  EXPECT_EQ(plane.damper, settings.max_damping);
  EXPECT_EQ(plane.recovery, 1);
  plane.offset = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(tidy(plane, settings));
  ForceField field;
  field.force = {1e30, 0, 0};
  field.radius = 1.0;
  ASSERT_TRUE(tidy(field, settings));
  EXPECT_NEAR(field.force.norm(), settings.max_force, 1e-6);
  field.jacobian(0, 2) = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(tidy(field, settings));
}

TEST(VrpnForces, AReadingThatIsNoNumberGivesNoForce) {
  Felt felt;
  felt.set(floor_at(0.0));
  felt.at(0.01);
  EXPECT_EQ(felt.at(std::numeric_limits<double>::quiet_NaN()), Vector3::Zero());
}

TEST(VrpnForces, NothingIsAllocated) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "sanitizers have the allocator";
  Felt felt;
  felt.set(floor_at(0.01));
  realtime::RealtimeGuard guard;
  felt.at(0.0);
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0U);
}

}  // namespace
}  // namespace icome::devices::vrpn
