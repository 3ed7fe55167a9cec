#include "devices/openhaptics/open_haptics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <thread>
#include <tuple>

#include "devices/fakes/fake_hd.h"
#include "devices/fakes/loaded_fake.h"
#include "devices/library_suite.h"
#include "devices/openhaptics/hd_library.h"

namespace icome::devices {
namespace {

using fakes::EnvironmentValue;
using fakes::FakeHd;
using fakes::FakeUnit;
using fakes::UnitFault;
using suite::held_until;
using suite::holds_soon;
using Mode = OpenHapticsSettings::Mode;

class OpenHapticsFake : public testing::Test {
 protected:
  OpenHapticsFake() { fake_->set_up(1, "Touch"); }
  ~OpenHapticsFake() override {
    EXPECT_EQ(fake_->misuses, 0) << "calls in a wrong order, or about a device that is not open";
    EXPECT_FALSE(fake_->scheduler_runs);
  }

  static std::unique_ptr<Driver> driver(Mode mode, std::string_view name = "") {
    return open_haptics_driver(name, {.mode = mode});
  }
  static std::string failure_to_open(std::string_view name = "") {
    const auto device = kOpenHaptics.open(name);
    return device ? "" : device.error().message;
  }
  FakeUnit& unit(int device = 0) { return fake_->devices[std::size_t(device)].unit; }

  suite::Rig rig(Mode mode) {
    return {suite::driven(driver(mode)),
            [this](const Vector3& place) { unit().aim(place); },
            [this] { return unit().strongest(); },
            [this] { return unit().held().norm(); },
            [this] { return unit().given(); },
            [this](bool in) { unit().plug(in); },
            [this](fakes::ArmFault fault) { unit().fail(fault); },
            [this] { unit().watch(); },
            [this] { return unit().marks(); }};
  }

  fakes::LoadedFake<FakeHd> fake_{"fake_hd", "ICOME_LIBHD"};
};

/// Tests of both ways to make frames.
class OpenHaptics : public OpenHapticsFake, public testing::WithParamInterface<Mode> {};
INSTANTIATE_TEST_SUITE_P(, OpenHaptics, testing::Values(Mode::Drives, Mode::Follows),
                         [](const auto& it) { return it.param == Mode::Drives ? "Drives" : "Follows"; });

TEST_P(OpenHaptics, KnownPosesInMetres) {
  FakeUnit::Sample pose;
  pose.position = {0.01, 0.02, -0.03};  // right, up, away from the user: 10, 20, -30 mm
  pose.velocity = {0.1, 0.2, 0.3};
  // A quarter turn about the axis that points to the user: right becomes up.
  pose.rotation = Eigen::AngleAxisd(M_PI / 2.0, Vector3::UnitZ()).toRotationMatrix();
  unit().pose(pose);
  unit().press(0b11);
  const auto device = suite::patient(driver(GetParam()));
  ASSERT_TRUE(device);
  PointerState seen;
  ASSERT_TRUE(held_until(*device, Vector3::Zero(), [&](const PointerState& state) {
    seen = state;
    return true;
  }));
  EXPECT_TRUE(seen.position.isApprox(Vector3(0.01, 0.02, -0.03), 1e-12)) << seen.position.transpose();
  EXPECT_TRUE(seen.velocity.isApprox(Vector3(0.1, 0.2, 0.3), 1e-12)) << seen.velocity.transpose();
  EXPECT_EQ(seen.buttons, 0b11U);
  const Vector3 right = seen.orientation * Vector3::UnitX();
  EXPECT_NEAR((right - Vector3::UnitY()).norm(), 0.0, 1e-12) << right.transpose();
}

TEST_P(OpenHaptics, ForceInNewtons) {
  unit().pose({});
  const auto device = suite::patient(driver(GetParam()));
  ASSERT_TRUE(device);
  EXPECT_TRUE(held_until(*device, {0.5, 1.0, -1.5}, [&](const auto&) {
    return (unit().held() - Vector3(0.5, 1.0, -1.5)).norm() < 1e-9;
  })) << unit().held().transpose();
}

TEST_P(OpenHaptics, MotorsAreReadiedAndLetGo) {
  const FakeHd::Device& there = fake_->devices[0];
  {
    const auto device = suite::patient(driver(GetParam()));
    ASSERT_TRUE(device);
    EXPECT_TRUE(there.is_open && there.has_force && there.has_ramp && there.has_clamp);
    EXPECT_TRUE(fake_->scheduler_runs);
    ASSERT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.5; }));
  }
  EXPECT_FALSE(there.is_open);
  EXPECT_FALSE(there.has_force);
  EXPECT_FALSE(fake_->scheduler_runs);
  EXPECT_EQ(unit().held().norm(), 0.0);
}

/// Tests of two devices, also with a library that has one current device for all threads.
class TwoOpenHaptics : public OpenHapticsFake, public testing::WithParamInterface<std::tuple<Mode, bool>> {
 protected:
  TwoOpenHaptics() {
    fake_->set_up(2, "Touch");
    fake_->is_per_process = std::get<1>(GetParam());
  }
  static std::unique_ptr<suite::PatientDevice> opened(std::string_view name) {
    return suite::patient(driver(std::get<0>(GetParam()), name));
  }
  bool right_is_held(suite::PatientDevice& right) {
    return held_until(right, {0.0, 2.0, 0.0}, [&](const auto&) { return unit(1).held().y() > 1.99; });
  }
};
INSTANTIATE_TEST_SUITE_P(, TwoOpenHaptics,
                         testing::Combine(testing::Values(Mode::Drives, Mode::Follows), testing::Bool()),
                         [](const auto& it) {
                           return std::string(std::get<0>(it.param) == Mode::Drives ? "Drives" : "Follows") +
                                  (std::get<1>(it.param) ? "OneForAllThreads" : "OneForEachThread");
                         });

TEST_P(TwoOpenHaptics, ByName) {
  FakeUnit::Sample pose;
  pose.position = {0.03, 0.0, 0.0};
  unit(1).pose(pose);
  ASSERT_TRUE(kOpenHaptics.list()[0].present);
  auto left = opened("Left");
  const auto right = opened("Right");
  ASSERT_TRUE(left && right);
  EXPECT_TRUE(held_until(*right, {0.0, 2.0, 0.0}, [&](const PointerState& state) {
    return state.position.isApprox(Vector3(0.03, 0.0, 0.0), 1e-12) && unit(1).held().norm() > 1.9;
  }));
  EXPECT_EQ(unit(0).strongest(), 0.0);
  EXPECT_EQ(failure_to_open("Right"),
            "hd:Right is in use by this program already; disconnect it there first");
  EXPECT_EQ(failure_to_open(""), "hd:Left is in use by this program already; disconnect it there first")
      << "the default one, seen as such before";
  left.reset();
  EXPECT_TRUE(fake_->scheduler_runs) << "the other one needs it";
  EXPECT_TRUE(held_until(*right, {0.0, -2.0, 0.0}, [&](const auto&) { return unit(1).held().y() < -1.9; }));
}

TEST_P(TwoOpenHaptics, OneGivesNoForceWhileTheOtherIsOpened) {
  unit(1).pose({});
  const auto right = opened("Right");
  ASSERT_TRUE(right && right_is_held(*right));
  fake_->opening_time = 1.2;  // longer than a scheduler may stand still
  unit(1).watch();
  std::unique_ptr<suite::PatientDevice> left;
  std::thread opening([&] { left = opened("Left"); });
  ASSERT_TRUE(holds_soon([&] { return fake_->is_opening.load(); }));
  while (fake_->is_opening) {
    const double held = unit(1).held().norm();
    EXPECT_TRUE(held == 0.0 || !fake_->is_opening) << held << " N";
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  opening.join();
  ASSERT_TRUE(left);
  EXPECT_TRUE(right_is_held(*right)) << "it goes on by itself";
  EXPECT_EQ(unit(1).marks().weakest, 0.0);
  EXPECT_LT(unit(1).marks().steepest, 0.1) << "N, a blow instead of a ramp";
  EXPECT_EQ(unit(0).strongest(), 0.0);
  fake_->opening_time = 0.0;
}

TEST_P(TwoOpenHaptics, LookingAtOneLeavesTheOtherAlone) {
  const EnvironmentValue names("ICOME_HD_NAMES", "Right");
  unit(1).pose({});
  const auto right = opened("Right");
  ASSERT_TRUE(right && right_is_held(*right));
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(kOpenHaptics.list()[0].present);
  EXPECT_TRUE(right_is_held(*right));
  EXPECT_EQ(unit(0).strongest(), 0.0);
}

TEST_P(OpenHaptics, WarningsAreCountedAndTold) {
  const auto device = suite::driven(driver(GetParam()));
  ASSERT_TRUE(device);
  unit().fail(UnitFault::Hot);
  EXPECT_TRUE(holds_soon([&] { return device->condition().find("motors are hot") != std::string::npos; }));
  unit().fail(UnitFault::TooStrong);
  EXPECT_TRUE(holds_soon([&] { return device->condition().find("More force") != std::string::npos; }));
  EXPECT_GT(suite::times_told(device->condition()), 0) << device->condition();
  EXPECT_TRUE(held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.01; }))
      << "warnings end nothing";
  unit().fail(UnitFault::None);
  EXPECT_TRUE(holds_soon([&] { return device->condition().empty(); })) << "it is over";
}

TEST_P(OpenHaptics, WithoutCalibrationThereIsNoForce) {
  const auto device = suite::driven(driver(GetParam()));
  ASSERT_TRUE(device);
  struct Lack {
    unsigned state;
    const char* words;
  };
  for (const Lack& lack : {Lack{0x5002, "No force: it is not calibrated; put the stylus into the inkwell"},
                           Lack{0x5001, "No force: it wants to be calibrated; run the setup program"}}) {
    ASSERT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.9; }));
    fake_->calibration = lack.state;
    EXPECT_TRUE(held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) {
      return device->condition().find(lack.words) != std::string::npos && unit().held().norm() == 0.0;
    })) << device->condition();
    unit().watch();
    fake_->calibration = 0x5000;
    ASSERT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.9; }));
    EXPECT_LT(unit().marks().steepest, 0.1) << "N, a blow instead of a ramp";
  }
  EXPECT_TRUE(holds_soon([&] { return device->condition().empty(); })) << device->condition();
}

TEST_F(OpenHapticsFake, ADeviceByTwoNamesIsOpenedOnce) {
  const EnvironmentValue names("ICOME_HD_NAMES", "Left");
  const auto before = kOpenHaptics.list();
  ASSERT_EQ(before.size(), 2u);
  EXPECT_EQ(before[0].identity, before[1].identity);
  const auto device = suite::driven(driver(Mode::Drives));
  ASSERT_TRUE(device);
  EXPECT_EQ(device->identity(), before[1].identity);
  EXPECT_EQ(failure_to_open("Left"), "hd is in use by this program already; disconnect it there first");
  EXPECT_TRUE(kOpenHaptics.list()[1].present);
}

TEST_P(OpenHaptics, FailuresAreSentences) {
  const auto device = suite::driven(driver(GetParam()));
  ASSERT_TRUE(device);
  const auto told_of = [&](const char* sentence) {
    PointerState state;
    EXPECT_TRUE(holds_soon([&] { return device->read(state) == DeviceStatus::Lost; }));
    EXPECT_TRUE(holds_soon([&] { return device->condition() == sentence; })) << device->condition();
    EXPECT_EQ(unit().held().norm(), 0.0);
    unit().fail(UnitFault::None);
    unit().plug(true);
    EXPECT_TRUE(holds_soon([&] { return device->read(state) == DeviceStatus::Ok; })) << device->condition();
  };
  unit().fail(UnitFault::Broken);
  told_of("Touch (fake) reports a fault (device fault); switch it off and on again");
  unit().plug(false);
  told_of("The connection to Touch (fake) is lost (communication error); check its cable and power");
  unit().fail(UnitFault::Unknown);
  EXPECT_TRUE(holds_soon([&] {
    return device->condition().find("reports errors") != std::string::npos ||
           device->condition().find("does not work") != std::string::npos;
  }));
}

TEST_F(OpenHapticsFake, ASchedulerThatStandsStillIsASentence) {
  const auto device = suite::driven(driver(Mode::Drives));
  ASSERT_TRUE(device);
  ASSERT_TRUE(held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.01; }));
  fake_->scheduler_hangs = true;
  PointerState state;
  ASSERT_TRUE(holds_soon([&] { return device->read(state) == DeviceStatus::Lost; }));
  EXPECT_EQ(unit().held().norm(), 0.0);
  EXPECT_TRUE(
      holds_soon([&] { return device->condition().find("scheduler stands still") != std::string::npos; }));
  fake_->scheduler_hangs = false;
  EXPECT_TRUE(holds_soon([&] { return device->read(state) == DeviceStatus::Ok; }));
}

TEST_F(OpenHapticsFake, ACallThatHangsIsASentence) {
  for (const FakeHd::Call call : {FakeHd::Call::BeginFrame, FakeHd::Call::EndFrame}) {
    SCOPED_TRACE(int(call));
    const auto device = suite::driven(driver(Mode::Drives));
    ASSERT_TRUE(device);
    ASSERT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.1; }));
    const std::int64_t begin = base::steady_nanoseconds();
    fake_->hangs_in = call;
    EXPECT_TRUE(holds_soon([&] {
      device->write({1.0, 0.0, 0.0});
      return device->condition().find("stands still") != std::string::npos ||
             device->condition().find("does not end") != std::string::npos;
    }));
    EXPECT_LT(base::steady_nanoseconds() - begin, 10'000'000'000);
    PointerState state;
    EXPECT_EQ(device->read(state), DeviceStatus::Lost);
    fake_->hangs_in = FakeHd::Call::None;
    EXPECT_TRUE(holds_soon([&] { return unit().held().norm() == 0.0; })) << "it goes on without the servo";
    EXPECT_TRUE(holds_soon([&] { return device->read(state) == DeviceStatus::Ok; })) << device->condition();
  }
}

TEST_F(OpenHapticsFake, ACallThatHangsDoesNotKeepFromLeaving) {
  for (const FakeHd::Call call : {FakeHd::Call::BeginFrame, FakeHd::Call::EndFrame}) {
    SCOPED_TRACE(int(call));
    auto device = suite::driven(driver(Mode::Drives));
    ASSERT_TRUE(device);
    ASSERT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.1; }));
    fake_->hangs_in = call;
    const std::int64_t begin = base::steady_nanoseconds();
    device.reset();
    EXPECT_LT(base::steady_nanoseconds() - begin, 10'000'000'000);
    EXPECT_EQ(failure_to_open(),
              "a call of OpenHaptics does not end; unplug the PHANToM or Touch, and restart the program");
    fake_->hangs_in = FakeHd::Call::None;
    EXPECT_TRUE(holds_soon([&] { return unit().held().norm() == 0.0; })) << "it goes on with what is gone";
    EXPECT_TRUE(kOpenHaptics.list()[0].present) << "it is closed at last";
  }
}

TEST_F(OpenHapticsFake, AnOldErrorIsNoneOfScheduling) {
  fake_->is_per_process = true;
  const auto owned = driver(Mode::Drives);
  const auto info = owned->open();
  ASSERT_TRUE(info);
  fake_.function<void(unsigned long)>("hdSetSchedulerRate")(1);  // leaves an error
  DriverLink link(*info);
  link.connect(*info);
  std::atomic<bool> stop = false;
  std::string why;
  std::thread thread([&] { why = owned->run(link, stop); });
  EXPECT_TRUE(holds_soon([&] { return link.counts().passed > 10; }));
  stop = true;
  thread.join();
  owned->close();
  EXPECT_EQ(why, "");
}

TEST_F(OpenHapticsFake, ASchedulerThatRefusesIsASentence) {
  for (const auto answer : {FakeHd::Scheduling::Refused, FakeHd::Scheduling::Complains}) {
    SCOPED_TRACE(int(answer));
    fake_->scheduling = answer;
    const auto owned = driver(Mode::Drives);
    const auto info = owned->open();
    ASSERT_TRUE(info);
    DriverLink link(*info);
    link.connect(*info);
    EXPECT_EQ(owned->run(link, false),
              "Touch (fake) does not work any more (scheduler full); switch it off and on again");
    EXPECT_TRUE(holds_soon([&] { return fake_->callbacks == 0; })) << "it is called with what is gone";
    owned->close();
    fake_->scheduling = FakeHd::Scheduling::Fine;
    const auto device = suite::driven(driver(Mode::Drives));
    ASSERT_TRUE(device);
    EXPECT_TRUE(
        held_until(*device, {1.0, 0.0, 0.0}, [&](const auto&) { return unit().held().norm() > 0.1; }));
  }
}

TEST_F(OpenHapticsFake, ProfilesByModelAndItsOwnLimits) {
  EXPECT_EQ(open_haptics_profile("PHANTOM Omni").name, "Omni");
  EXPECT_EQ(open_haptics_profile("PHANToM Desktop").name, "PHANToM Desktop");
  EXPECT_EQ(open_haptics_profile("Premium 1.5 High Force").name, "PHANToM Premium 1.5");
  EXPECT_EQ(open_haptics_profile("PHANToM PREMIUM 3.0").name, "PHANToM Premium 3.0");
  EXPECT_EQ(open_haptics_profile("Premium 1.0").name, "PHANToM Premium 1");
  EXPECT_EQ(open_haptics_profile("Touch X").name, "PHANToM Desktop");
  EXPECT_EQ(open_haptics_profile("something else").name, "Omni");
  fake_->max_force = 2.5;
  const auto device = suite::driven(driver(Mode::Drives));
  ASSERT_TRUE(device);
  const DeviceInfo& info = device->info();
  EXPECT_EQ(info.name, "Touch (fake)");
  EXPECT_EQ(info.max_force, 2.5) << "its own is lower";
  EXPECT_EQ(info.continuous_force, 0.88);
  EXPECT_EQ(info.nominal_stiffness, 500.0) << "0.5 N/mm";
  EXPECT_DOUBLE_EQ(info.workspace_radius, 0.08) << "half of 160 mm";
  EXPECT_EQ(info.effective_mass, 0.045);
}

TEST_F(OpenHapticsFake, LimitsThatMakeNoSenseAreIgnored) {
  for (const double limit : {0.0, -3.0, std::nan(""), 50.0}) {
    fake_->max_force = limit;
    const auto device = suite::driven(driver(Mode::Drives));
    ASSERT_TRUE(device);
    EXPECT_EQ(device->info().max_force, 3.3) << "of the profile";
  }
}

TEST_F(OpenHapticsFake, WithoutTheLibraryPeopleAreToldWhatToInstall) {
  {
    const EnvironmentValue variable("ICOME_LIBHD", "/nowhere/libHD.so");
    EXPECT_EQ(failure_to_open(),
              "ICOME_LIBHD is set to /nowhere/libHD.so, where there is no library of OpenHaptics (PHANToM, "
              "Touch); correct or unset it");
  }
  const EnvironmentValue variable("ICOME_LIBHD", nullptr);
  const auto entries = kOpenHaptics.list();
  ASSERT_EQ(entries.size(), 1U);
  if (entries[0].present) GTEST_SKIP() << "OpenHaptics is on this system";
  EXPECT_EQ(entries[0].name, "hd");
  EXPECT_EQ(entries[0].family, "pointer");
  EXPECT_EQ(entries[0].backend, "openhaptics");
  EXPECT_NE(entries[0].why.find("there is no libHD.so, libHD.so.3.5"), std::string::npos) << entries[0].why;
  EXPECT_NE(entries[0].why.find("or set ICOME_LIBHD to the path of the library"), std::string::npos);
}

TEST_F(OpenHapticsFake, AnotherLibraryIsToldApart) {
  const EnvironmentValue variable("ICOME_LIBHD", fakes::fake_path("fake_dhd"));
  const std::string why = failure_to_open();
  EXPECT_NE(why.find("libfake_dhd.so has no function hdInitDevice"), std::string::npos) << why;
}

TEST_F(OpenHapticsFake, NoDeviceIsASentence) {
  unit().plug(false);
  EXPECT_EQ(failure_to_open(),
            "no PHANToM or Touch answers (communication error); plug it in, switch it on, and try the test "
            "program of its driver; where only root may use a Touch, put this udev rule into "
            "/etc/udev/rules.d/70-icome-hd.rules and plug the device in again: SUBSYSTEMS==\"usb\", "
            "ATTRS{idVendor}==\"2988\", TAG+=\"uaccess\"");
  EXPECT_NE(failure_to_open("Middle").find("answers by the name of Middle (invalid value)"),
            std::string::npos);
  EXPECT_FALSE(kOpenHaptics.list()[0].present);
}

TEST_F(OpenHapticsFake, ListsTheDefaultDeviceAndThoseOfTheEnvironment) {
  fake_->set_up(2, "Touch");
  const EnvironmentValue names("ICOME_HD_NAMES", "Right,,Middle");
  const auto open_one = suite::driven(driver(Mode::Drives));
  const auto entries = kOpenHaptics.list();
  ASSERT_EQ(entries.size(), 3U);
  EXPECT_EQ(entries[0].name, "hd");
  EXPECT_EQ(entries[0].why, "Touch (fake) of a fake of 3D Systems, serial number FAKE-0001");
  EXPECT_EQ(entries[1].name, "hd:Right");
  EXPECT_TRUE(entries[1].present);
  EXPECT_FALSE(fake_->devices[1].is_open) << "only looked at";
  EXPECT_EQ(entries[2].name, "hd:Middle");
  EXPECT_FALSE(entries[2].present);
}

TEST_F(OpenHapticsFake, SettingsFromTheEnvironment) {
  const EnvironmentValue mode("ICOME_HD_MODE", "follows");
  const EnvironmentValue rate("ICOME_HD_RATE", "2000");
  const auto settings = open_haptics_settings();
  ASSERT_TRUE(settings);
  EXPECT_EQ(settings->mode, Mode::Follows);
  EXPECT_EQ(settings->rate, 2000.0);
  const EnvironmentValue wrong("ICOME_HD_MODE", "leads");
  EXPECT_EQ(failure_to_open(), "ICOME_HD_MODE is \"leads\"; set it to drives or follows, or unset it");
  const EnvironmentValue right("ICOME_HD_MODE", "drives");
  const EnvironmentValue fast("ICOME_HD_RATE", "1e6");
  EXPECT_EQ(failure_to_open(), "ICOME_HD_RATE is \"1e6\"; set it to a number from 500 to 4000, or unset it");
}

TEST_P(OpenHaptics, TakesTheForceAwayWhenTheServoStandsStill) {
  const auto device = suite::driven(driver(GetParam()));
  ASSERT_TRUE(device);
  suite::takes_the_force_away(*device, unit());
}

TEST_P(OpenHaptics, StandsAMillionHostileReadings) {
  unit().set_up({.counted_period = 0.001});
  fake_->scheduler_waits = GetParam() == Mode::Follows;  // a scheduler that makes no frames does not hurry
  const auto device = suite::patient(open_haptics_driver("", {.mode = GetParam(), .rate = suite::kUnpaced}));
  ASSERT_TRUE(device);
  suite::stands_a_million_readings(*device, unit());
}

TEST_P(OpenHaptics, ServosPartIsRealTimeSafe) {
  const auto device = suite::driven(driver(GetParam()));
  ASSERT_TRUE(device);
  suite::is_real_time_safe(*device);
}

TEST_F(OpenHapticsFake, FollowingTakesNoMemory) {
  const auto owned = driver(Mode::Follows);
  suite::exchanges_without_memory(*owned, unit());
}

/// Counts the memory that the scheduler's thread takes and frees, from one call to a later one.
struct SchedulerGuard {
  std::optional<realtime::RealtimeGuard> guard;
  std::atomic<int> calls = 0;
  std::uint64_t taken = 0;

  static unsigned call(void* context) {
    auto& it = *static_cast<SchedulerGuard*>(context);
    if (it.calls == 0) it.guard.emplace();
    if (++it.calls < 500) return 1;
    it.guard->stop();
    it.taken = it.guard->allocations() + it.guard->frees();
    return 0;
  }
};

TEST_F(OpenHapticsFake, BeingDrivenTakesNoMemory) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "the sanitizer needs malloc for itself";
  unit().pose({});
  const auto device = suite::driven(driver(Mode::Drives));
  ASSERT_TRUE(device);
  SchedulerGuard watch;
  fake_.function<void(unsigned (*)(void*), void*, std::uint16_t)>("hdScheduleSynchronous")(
      &SchedulerGuard::call, &watch, 0);
  EXPECT_EQ(watch.calls, 500);
  EXPECT_EQ(watch.taken, 0U);
}

TEST_P(OpenHaptics, FeelsTheFloor) {
  suite::Rig it = rig(GetParam());
  ASSERT_TRUE(it.device);
  suite::feels_the_floor(it);
}
TEST_P(OpenHaptics, IsPassive) {
  suite::Rig it = rig(GetParam());
  ASSERT_TRUE(it.device);
  suite::is_passive(it);
}
TEST_P(OpenHaptics, ComesBack) {
  suite::Rig it = rig(GetParam());
  ASSERT_TRUE(it.device);
  suite::comes_back(it);
}
TEST_P(OpenHaptics, IsWatched) {
  suite::Rig it = rig(GetParam());
  ASSERT_TRUE(it.device);
  suite::is_watched(it);
}
TEST_P(OpenHaptics, StandsFaults) {
  suite::Rig it = rig(GetParam());
  ASSERT_TRUE(it.device);
  suite::stands_faults(it);
}

}  // namespace
}  // namespace icome::devices
