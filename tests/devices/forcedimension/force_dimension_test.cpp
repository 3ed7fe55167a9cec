#include "devices/forcedimension/force_dimension.h"

#include <gtest/gtest.h>

#include <cmath>

#include "devices/fakes/fake_dhd.h"
#include "devices/fakes/loaded_fake.h"
#include "devices/library_suite.h"

namespace icome::devices {
namespace {

using fakes::EnvironmentValue;
using fakes::FakeDhd;
using fakes::FakeUnit;
using fakes::UnitFault;
using suite::held_until;
using suite::holds_soon;

class ForceDimension : public testing::Test {
 protected:
  ForceDimension() { fake_->set_up(1, "omega.7"); }
  ~ForceDimension() override { EXPECT_EQ(fake_->misuses, 0) << "calls about a device that is not open"; }

  static std::unique_ptr<Driver> driver(std::string_view address = "",
                                        const ForceDimensionSettings& settings = {}) {
    auto driver = force_dimension_driver(address, settings);
    EXPECT_TRUE(driver);
    return std::move(*driver);
  }
  static std::string failure_to_open(std::string_view address = "") {
    const auto device = kForceDimension.open(address);
    return device ? "" : device.error().message;
  }
  FakeUnit& unit(int device = 0) { return fake_->devices[std::size_t(device)].unit; }

  suite::Rig rig() {
    // Ours from its own: right is y, up is z, to the user is x.
    return {suite::driven(driver()),
            [this](const Vector3& place) {
              unit().aim({place.z(), place.x(), place.y()});
            },
            [this] { return unit().strongest(); },
            [this] { return unit().held().norm(); },
            [this] { return unit().given(); },
            [this](bool in) { unit().plug(in); },
            [this](fakes::ArmFault fault) { unit().fail(fault); },
            [this] { unit().watch(); },
            [this] { return unit().marks(); }};
  }

  fakes::LoadedFake<FakeDhd> fake_{"fake_dhd", "ICOME_LIBDHD"};
};

TEST_F(ForceDimension, KnownPosesInOurAxes) {
  FakeUnit::Sample pose;
  pose.position = {0.01, 0.02, 0.03};  // to the user, right, up
  pose.velocity = {0.1, 0.2, 0.3};
  pose.rotation = Eigen::AngleAxisd(M_PI / 2.0, Vector3::UnitZ()).toRotationMatrix();
  unit().pose(pose);
  unit().press(0b101);
  const auto device = suite::patient(driver());
  ASSERT_TRUE(device);
  PointerState seen;
  ASSERT_TRUE(held_until(*device, Vector3::Zero(), [&](const PointerState& state) {
    seen = state;
    return true;
  }));
  EXPECT_TRUE(seen.position.isApprox(Vector3(0.02, 0.03, 0.01), 1e-12)) << seen.position.transpose();
  EXPECT_TRUE(seen.velocity.isApprox(Vector3(0.2, 0.3, 0.1), 1e-12)) << seen.velocity.transpose();
  EXPECT_EQ(seen.buttons, 0b101U);
  // A quarter turn about the axis that points up, from its right (our x) away from the user (our -z).
  const Vector3 right = seen.orientation * Vector3::UnitX();
  EXPECT_NEAR((right - Vector3(0, 0, -1)).norm(), 0.0, 1e-12) << right.transpose();
  EXPECT_NEAR((seen.orientation * Vector3::UnitY() - Vector3::UnitY()).norm(), 0.0, 1e-12);
}

TEST_F(ForceDimension, ForceInItsAxes) {
  unit().pose({});
  const auto device = suite::patient(driver());
  ASSERT_TRUE(device);
  // 1 N to the right, 2 up, 3 to the user.
  EXPECT_TRUE(held_until(*device, {1.0, 2.0, 3.0}, [&](const auto&) {
    return (unit().held() - Vector3(3.0, 1.0, 2.0)).norm() < 1e-9;
  })) << unit().held().transpose();
  EXPECT_EQ(fake_->devices[0].other_motors, 0.0) << "of wrist and gripper";
}

TEST_F(ForceDimension, OtherAxesAreASetting) {
  FakeUnit::Sample pose;
  pose.position = {0.01, 0.02, 0.03};
  unit().pose(pose);
  ForceDimensionSettings settings;
  settings.axes = "x-zy";
  const auto device = suite::patient(driver("", settings));
  ASSERT_TRUE(device);
  EXPECT_TRUE(held_until(*device, {1.0, 2.0, 3.0}, [&](const PointerState& state) {
    return state.position.isApprox(Vector3(0.01, -0.03, 0.02), 1e-12) &&
           (unit().held() - Vector3(1.0, 3.0, -2.0)).norm() < 1e-9;
  }));
}

TEST_F(ForceDimension, GripIsItsGrippersAngle) {
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  const auto grip_becomes = [&](double grip) {
    return held_until(*device, Vector3::Zero(),
                      [&](const PointerState& state) { return std::abs(state.grip - grip) < 1e-12; });
  };
  EXPECT_TRUE(grip_becomes(1.0)) << "closed";
  unit().squeeze(15.0);
  EXPECT_TRUE(grip_becomes(0.5));
  unit().squeeze(-30.0);
  EXPECT_TRUE(grip_becomes(0.0)) << "open, for the left hand";
  unit().squeeze(45.0);
  EXPECT_TRUE(grip_becomes(0.0)) << "wide open";
}

TEST_F(ForceDimension, WithoutAGripperThereIsNoGrip) {
  fake_->set_up(1, "omega.3");
  unit().squeeze(0.0);
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  EXPECT_TRUE(held_until(*device, {1.0, 0.0, 0.0}, [&](const PointerState& state) {
    return state.grip == 0.0 && unit().held().norm() > 0.01;
  }));
}

TEST_F(ForceDimension, ProfilesByName) {
  EXPECT_EQ(force_dimension_profile("omega.331").name, "omega.x");
  EXPECT_EQ(force_dimension_profile("delta.3").max_force, 20.0);
  EXPECT_EQ(force_dimension_profile("Novint FALCON").workspace_radius, 0.04);
  EXPECT_EQ(force_dimension_profile("sigma.7 (right-handed)").nominal_stiffness, 4000.0);
  EXPECT_EQ(force_dimension_profile("lambda.7").workspace_radius, 0.1125);
  const DeviceInfo unknown = force_dimension_profile("something else");
  EXPECT_EQ(unknown.max_force, 8.0);
  EXPECT_EQ(unknown.workspace_radius, 0.04);
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  EXPECT_EQ(device->info().name, "omega.7 (fake)");
  EXPECT_EQ(device->info().max_force, 12.0);
}

TEST_F(ForceDimension, MotorsAreReadiedAndStopped) {
  const FakeDhd::Device& there = fake_->devices[0];
  {
    const auto device = suite::patient(driver());
    ASSERT_TRUE(device);
    EXPECT_TRUE(there.is_open && there.has_force && there.has_gravity);
    ASSERT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.5; }));
  }
  EXPECT_FALSE(there.is_open);
  EXPECT_FALSE(there.has_force);
  EXPECT_EQ(there.stops, 1);
  EXPECT_EQ(unit().held().norm(), 0.0);
  ForceDimensionSettings settings;
  settings.gravity_compensation = false;
  const auto device = suite::patient(driver("", settings));
  ASSERT_TRUE(device);
  EXPECT_FALSE(there.has_gravity);
}

TEST_F(ForceDimension, WithoutTheLibraryPeopleAreToldWhatToInstall) {
  {
    const EnvironmentValue variable("ICOME_LIBDHD", "/nowhere/libdhd.so");
    EXPECT_EQ(
        failure_to_open(),
        "ICOME_LIBDHD is set to /nowhere/libdhd.so, where there is no library of Force Dimension; correct "
        "or unset it");
  }
  const EnvironmentValue variable("ICOME_LIBDHD", nullptr);
  const std::string why = failure_to_open();
  if (why.empty()) GTEST_SKIP() << "Force Dimension's own library is on this system";
  EXPECT_NE(why.find("there is no libdhd.so, libdhd.so.3, libdrd.so"), std::string::npos) << why;
  EXPECT_NE(why.find("install the Force Dimension SDK"), std::string::npos) << why;
  const auto entries = kForceDimension.list();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].name, "dhd");
  EXPECT_FALSE(entries[0].present);
  EXPECT_EQ(entries[0].why, why);
}

TEST_F(ForceDimension, AnotherLibraryIsToldApart) {
  const EnvironmentValue variable("ICOME_LIBDHD", fakes::fake_path("fake_hd"));
  const std::string why = failure_to_open();
  EXPECT_NE(why.find("libfake_hd.so has no function dhdGetDeviceCount"), std::string::npos) << why;
}

TEST_F(ForceDimension, NoDeviceIsASentence) {
  fake_->set_up(0, "omega.7");
  EXPECT_NE(failure_to_open().find("no device of Force Dimension or Novint answers; plug it in"),
            std::string::npos)
      << failure_to_open();
  const auto entries = kForceDimension.list();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_FALSE(entries[0].present);
  EXPECT_NE(entries[0].why.find("no device answers"), std::string::npos);
}

TEST_F(ForceDimension, ADeviceThatDoesNotStartIsASentence) {
  unit().fail(UnitFault::Broken);
  EXPECT_EQ(failure_to_open(), "dhd:0 cannot be opened: firmware error");
  const auto entries = kForceDimension.list();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_FALSE(entries[0].present);
  EXPECT_NE(entries[0].why.find("cannot be opened"), std::string::npos);
}

TEST_F(ForceDimension, AddressesThatNameNothing) {
  for (const char* address : {"x", "-1", "1x", "100", "0 "})
    EXPECT_NE(failure_to_open(address).find("names no device; write dhd, or dhd:0"), std::string::npos);
  EXPECT_EQ(failure_to_open("3"), "there is no dhd:3; devices that are plugged in: 1");
}

TEST_F(ForceDimension, EachDeviceIsOpenOnce) {
  fake_->set_up(2, "omega.7");
  FakeUnit::Sample pose;
  pose.position = {0.0, 0.03, 0.0};
  unit(1).pose(pose);
  const auto first = suite::patient(driver());
  const auto second = suite::patient(driver());
  ASSERT_TRUE(first && second);
  EXPECT_TRUE(held_until(*second, {0.0, 2.0, 0.0}, [&](const PointerState& state) {
    return state.position.isApprox(Vector3(0.03, 0.0, 0.0), 1e-12) && unit(1).held().norm() > 1.9;
  }));
  EXPECT_EQ(unit(0).strongest(), 0.0);
  EXPECT_EQ(failure_to_open(), "dhd:0 is in use by this program already; disconnect it there first");
  EXPECT_EQ(failure_to_open("1"), "dhd:1 is in use by this program already; disconnect it there first");
  const auto entries = kForceDimension.list();
  ASSERT_EQ(entries.size(), 2U);
  EXPECT_EQ(entries[1].name, "dhd:1");
  EXPECT_EQ(entries[1].why, "omega.7 (fake)");
  EXPECT_EQ(entries[1].identity, "dhd:1");
  EXPECT_EQ(second->info().name, "omega.7 (fake) (dhd:1)") << "people need to know which";
  EXPECT_TRUE(entries[1].present);
}

TEST_F(ForceDimension, ListingClosesWhatItOpened) {
  fake_->set_up(3, "delta.3");
  EXPECT_EQ(kForceDimension.list().size(), 3U);
  for (const FakeDhd::Device& device : fake_->devices) EXPECT_FALSE(device.is_open);
}

TEST_F(ForceDimension, WarningsAreCountedAndTold) {
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  unit().fail(UnitFault::Saturated);
  EXPECT_TRUE(held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) {
    return device->condition().find("saturated") != std::string::npos;
  }));
  const int saturations = suite::times_told(device->condition());
  EXPECT_GT(saturations, 0) << device->condition();
  EXPECT_TRUE(holds_soon([&] { return suite::times_told(device->condition()) > saturations + 10; }));
  unit().fail(UnitFault::TimeGuard);
  EXPECT_TRUE(holds_soon([&] { return device->condition().find("time guard") != std::string::npos; }));
  EXPECT_GT(suite::times_told(device->condition()), 0) << device->condition();
  EXPECT_TRUE(held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.01; }))
      << "warnings end nothing";
  unit().fail(UnitFault::None);
  EXPECT_TRUE(holds_soon([&] { return device->condition().empty(); })) << "it is over";
}

TEST_F(ForceDimension, ALostConnectionIsASentence) {
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  unit().plug(false);
  PointerState state;
  ASSERT_TRUE(holds_soon([&] { return device->read(state) == DeviceStatus::Lost; }));
  ASSERT_TRUE(holds_soon([&] { return !device->condition().empty(); }));
  EXPECT_EQ(
      device->condition(),
      "The connection to omega.7 (fake) is lost (communication error); plug it in and switch it on again");
}

TEST_F(ForceDimension, SettingsFromTheEnvironment) {
  EXPECT_EQ(force_dimension_settings()->rate, 4000.0);
  const EnvironmentValue rate("ICOME_DHD_RATE", "1000");
  const EnvironmentValue axes("ICOME_DHD_AXES", "xyz");
  const EnvironmentValue gravity("ICOME_DHD_GRAVITY", "off");
  const EnvironmentValue grip("ICOME_DHD_GRIP_DEGREES", "25.5");
  const auto settings = force_dimension_settings();
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->rate, 1000.0);
  EXPECT_EQ(settings->axes, "xyz");
  EXPECT_FALSE(settings->gravity_compensation);
  EXPECT_EQ(settings->grip_open, 25.5);
  const auto refused = [](const char* variable, const char* value) {
    const EnvironmentValue wrong(variable, value);
    const auto result = force_dimension_settings();
    EXPECT_FALSE(result) << variable;
    EXPECT_NE(failure_to_open().find(variable), std::string::npos);
  };
  refused("ICOME_DHD_AXES", "xzy");
  refused("ICOME_DHD_GRAVITY", "maybe");
  refused("ICOME_DHD_RATE", "nan");
  refused("ICOME_DHD_RATE", "8000");
  refused("ICOME_DHD_GRIP_DEGREES", "30 degrees");
}

TEST_F(ForceDimension, AnEmptyVariableIsNone) {
  const EnvironmentValue axes("ICOME_DHD_AXES", "");
  const EnvironmentValue rate("ICOME_DHD_RATE", "");
  const auto settings = force_dimension_settings();
  ASSERT_TRUE(settings) << settings.error().message;
  EXPECT_EQ(settings->axes, ForceDimensionSettings().axes);
}

TEST_F(ForceDimension, TakesTheForceAwayWhenTheServoStandsStill) {
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  suite::takes_the_force_away(*device, unit());
}

TEST_F(ForceDimension, StandsAMillionHostileReadings) {
  unit().set_up({.counted_period = 0.00025});
  ForceDimensionSettings settings;
  settings.rate = suite::kUnpaced;
  const auto device = suite::patient(driver("", settings));
  ASSERT_TRUE(device);
  suite::stands_a_million_readings(*device, unit());
}

TEST_F(ForceDimension, ServosPartIsRealTimeSafe) {
  const auto device = suite::driven(driver());
  ASSERT_TRUE(device);
  suite::is_real_time_safe(*device);
}

TEST_F(ForceDimension, ExchangeTakesNoMemory) {
  const auto owned = driver();
  suite::exchanges_without_memory(*owned, unit());
}

TEST_F(ForceDimension, ForcesAreDelayedAndReadingsRoundedAndDropped) {
  unit().set_up({.arm = {.force_latency = 0.002, .quantum = 0.00001}, .transfer = 0.0001, .dropouts = 0.2});
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  suite::feels_the_floor(it);
}

TEST_F(ForceDimension, FeelsTheFloor) {
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  suite::feels_the_floor(it);
}
TEST_F(ForceDimension, IsPassive) {
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  suite::is_passive(it);
}
TEST_F(ForceDimension, AFloorThatComesLateIsNotPassive) {
  unit().set_up({.arm = {.force_latency = 0.02}});
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  const auto work = suite::median_work(it);
  if (!work) GTEST_SKIP() << "the machine stands still in each press";
  EXPECT_GT(*work, suite::kPassiveWork) << "the suite does not see it";
}
TEST_F(ForceDimension, ComesBack) {
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  suite::comes_back(it);
}
TEST_F(ForceDimension, IsWatched) {
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  suite::is_watched(it);
}
TEST_F(ForceDimension, StandsFaults) {
  suite::Rig it = rig();
  ASSERT_TRUE(it.device);
  suite::stands_faults(it);
}

}  // namespace
}  // namespace icome::devices
