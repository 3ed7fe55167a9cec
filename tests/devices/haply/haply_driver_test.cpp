#include "devices/haply/haply_driver.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <thread>

#include "devices/device_profiles.h"
#include "devices/haply/haply_back_end.h"
#include "devices/haply/haply_bench.h"
#include "realtime/guard/guard.h"

namespace icome::devices {
namespace {

using fakes::ArmFault;
using fakes::FakeInverseService;
using fakes::FakeServiceSettings;
using fakes::ServiceFault;
using suite::holds_soon;

std::unique_ptr<DrivenDevice> haply_at(const FakeInverseService& fake) {
  auto device = open_haply_at(settings_for(fake));
  EXPECT_TRUE(device) << device.error().message;
  return device ? std::move(*device) : nullptr;
}

TEST(HaplyDriver, KnownPoses) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  EXPECT_EQ(device->info().name, "Haply Inverse3 049D") << "of two people need to know which";
  EXPECT_EQ(device->info().max_force, 5.0);
  const Vector3 middle = HaplySettings().middle;
  struct Pose {
    Vector3 service, ours;  // m, from the middle
  };
  for (const Pose& pose :
       {Pose{{0.05, 0, 0}, {0.05, 0, 0}}, Pose{{0, -0.05, 0}, {0, 0, 0.05}},
        Pose{{0, 0, -0.05}, {0, -0.05, 0}}, Pose{{-0.02, 0.03, 0.04}, {-0.02, 0.04, -0.03}}}) {
    fake.aim(middle + pose.service);
    EXPECT_TRUE(haply_reads_soon(*device, [&](const PointerState& state) {
      return (state.position - pose.ours).norm() < 1e-4 && state.velocity.norm() < 0.01;
    })) << pose.ours.transpose();
  }
}

TEST(HaplyDriver, AnotherStandIsASetting) {
  FakeInverseService fake;
  HaplySettings settings = settings_for(fake);
  settings.axes = Quaternion::Identity();
  settings.middle = Vector3(0.01, 0.02, 0.03);
  const auto device = open_haply_at(settings);
  ASSERT_TRUE(device);
  fake.aim({0.04, -0.1, 0.2});
  EXPECT_TRUE(haply_reads_soon(**device, [](const PointerState& state) {
    return (state.position - Vector3(0.03, -0.12, 0.17)).norm() < 1e-4;
  }));
}

TEST(HaplyDriver, AForceUpwardsIsFeltUpwards) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  EXPECT_TRUE(holds_soon([&] {
    device->write({0.5, 1.0, -1.5});
    return (fake.held() - Vector3(0.5, 1.5, 1.0)).norm() < 1e-5;
  })) << fake.held().transpose();
}

TEST(HaplyDriver, AWirelessVerseGripTurnsAndPresses) {
  FakeServiceSettings with;
  with.wired_grip = with.wireless_grip = true;
  FakeInverseService fake(with);
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  fake.hold_grips(Quaternion(Eigen::AngleAxisd(M_PI / 2, Vector3::UnitZ())), 0b110);
  EXPECT_TRUE(haply_reads_soon(*device, [](const PointerState& state) {
    return state.buttons == 0b110 &&
           (state.orientation * Vector3(0, 0, -1)).isApprox(Vector3(-1, 0, 0), 1e-9);
  }));
  fake.hold_grips(Quaternion::Identity(), 0);
  EXPECT_TRUE(haply_reads_soon(*device, [](const PointerState& state) {
    return state.buttons == 0 && state.orientation.isApprox(Quaternion::Identity());
  }));
}

TEST(HaplyDriver, AWiredVerseGripTurnsAndPresses) {
  FakeServiceSettings with;
  with.wired_grip = true;
  FakeInverseService fake(with);
  fake.hold_grips(Quaternion(Eigen::AngleAxisd(M_PI, Vector3::UnitX())), 0b01);
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  EXPECT_TRUE(haply_reads_soon(*device, [](const PointerState& state) {
    return state.buttons == 0b01 && (state.orientation * Vector3(0, 0, -1)).isApprox(Vector3(0, 0, 1), 1e-9);
  }));
  fake.hold_grips(Quaternion::Identity(), 0b10);
  EXPECT_TRUE(haply_reads_soon(*device, [](const PointerState& state) { return state.buttons == 0b10; }));
}

TEST(HaplyDriver, TheForceIsCalledWhatTheVersionCallsIt) {
  struct Case {
    const char* version;
    ForceField setting;
    bool by_vector;
  };
  for (const Case& one :
       {Case{"3.5.0", ForceField::ByVersion, true}, Case{"3.4.2", ForceField::ByVersion, false},
        Case{"3.10.1", ForceField::ByVersion, true}, Case{"", ForceField::ByVersion, true},
        Case{"3.5.0", ForceField::Values, false}, Case{"3.1.0", ForceField::Vector, true}}) {
    SCOPED_TRACE(one.version);
    FakeServiceSettings of_version;
    of_version.version = one.version;
    FakeInverseService fake(of_version);
    HaplySettings settings = settings_for(fake);
    settings.force_field = one.setting;
    const auto device = open_haply_at(settings);
    ASSERT_TRUE(device);
    EXPECT_TRUE(holds_soon([&] { return (one.by_vector ? fake.vectors() : fake.values()) > 3; }));
    EXPECT_EQ(one.by_vector ? fake.values() : fake.vectors(), 0u);
    EXPECT_EQ(fake.misunderstood(), 0u);
  }
}

TEST(HaplyDriver, ItSaysWhoItIsFirst) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  ASSERT_TRUE(holds_soon([&] { return !fake.first_message().empty(); }));
  const auto first = nlohmann::json::parse(fake.first_message());
  EXPECT_EQ(first["session"]["configure"]["profile"]["name"], "ICOME");
}

TEST(HaplyDriver, WithoutAServiceItSaysWhereToGetIt) {
  FakeInverseService fake;
  HaplySettings settings = settings_for(fake);
  settings.service.host = "localhost";  // also by IPv6, where nobody is either
  fake.stop();
  const auto device = open_haply_at(settings);
  ASSERT_FALSE(device);
  const std::string& why = device.error().message;
  for (const std::string& words : std::initializer_list<std::string>{
           "Inverse Service", "localhost:" + std::to_string(fake.port()), "haply.co", "ICOME_HAPLY"})
    EXPECT_NE(why.find(words), std::string::npos) << why;
  settings.service.host = "no-such-host.invalid";
  EXPECT_NE(open_haply_at(settings).error().message.find("its name is not known"), std::string::npos);
}

TEST(HaplyDriver, AServiceThatSaysNothingIsGivenUpInTime) {
  FakeInverseService fake;
  fake.set_fault(ServiceFault::Garbage);
  auto device = open_haply_at(settings_for(fake));
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().message.find("makes no sense"), std::string::npos) << device.error().message;
}

TEST(HaplyDriver, WithoutADeviceItSaysSo) {
  FakeServiceSettings two;
  two.devices = {"049D", "0555"};
  FakeInverseService fake(two);
  auto other = open_haply_at(settings_for(fake), "1234");
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("no Inverse3 \"1234\"; there is 049D, 0555"), std::string::npos)
      << other.error().message;
  FakeServiceSettings none;
  none.devices.clear();
  FakeInverseService empty(none);
  const auto device = open_haply_at(settings_for(empty));
  ASSERT_FALSE(device);
  EXPECT_NE(device.error().message.find("no Inverse3 is connected"), std::string::npos)
      << device.error().message;
}

TEST(HaplyDriver, OneOfTwoByItsId) {
  FakeServiceSettings two;
  two.devices = {"049D", "0555"};
  FakeInverseService fake(two);
  const auto second = open_haply_at(settings_for(fake), "0555");
  ASSERT_TRUE(second) << second.error().message;
  const auto first = open_haply_at(settings_for(fake), "049d");
  ASSERT_TRUE(first) << first.error().message;
  fake.aim(HaplySettings().middle + Vector3(0.03, 0, 0));
  EXPECT_TRUE(haply_reads_soon(**first, [](const PointerState& state) { return state.position.x() > 0.02; }));
  EXPECT_TRUE(
      haply_reads_soon(**second, [](const PointerState& state) { return state.position.norm() < 1e-6; }));
}

// Failures: the device is lost, people are told, and it comes back by itself.

void expect_haply_back(DrivenDevice& device) {
  EXPECT_TRUE(haply_reads_soon(device)) << device.condition();
  EXPECT_TRUE(holds_soon([&] { return device.condition().empty(); })) << device.condition();
}

TEST(HaplyFailures, AServiceThatStopsAnswering) {
  FakeInverseService fake;
  HaplySettings settings = settings_for(fake);
  settings.patience = 0.1;
  const auto device = open_haply_at(settings);
  ASSERT_TRUE(device);
  fake.set_fault(ServiceFault::Silent);
  ASSERT_TRUE(haply_is_lost_soon(**device));
  EXPECT_TRUE(haply_tells_soon(**device, "does not answer in time"));
  EXPECT_TRUE(holds_soon([&] { return fake.held().isZero(0.0); }));
  fake.set_fault(ServiceFault::None);
  EXPECT_TRUE(haply_reads_soon(**device));
}

TEST(HaplyFailures, AConnectionThatEnds) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  ASSERT_TRUE(haply_reads_soon(*device));
  fake.hang_up();
  ASSERT_TRUE(haply_is_lost_soon(*device));
  expect_haply_back(*device);
}

TEST(HaplyFailures, AServiceThatIsRestarted) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  ASSERT_TRUE(haply_reads_soon(*device));
  fake.stop();
  ASSERT_TRUE(haply_is_lost_soon(*device));
  EXPECT_TRUE(haply_tells_soon(*device, "Inverse Service"));
  fake.start();
  expect_haply_back(*device);
}

TEST(HaplyFailures, AnswersThatMakeNoSense) {
  for (const ServiceFault fault :
       {ServiceFault::Garbage, ServiceFault::Truncated, ServiceFault::WrongTypes}) {
    SCOPED_TRACE(int(fault));
    FakeInverseService fake;
    HaplySettings settings = settings_for(fake);
    settings.patience = 0.3;
    const auto device = open_haply_at(settings);
    ASSERT_TRUE(device) << device.error().message;
    ASSERT_TRUE(haply_reads_soon(**device));
    fake.aim(settings.middle + Vector3(0.05, 0, 0));  // a place that does not change is not told
    fake.set_fault(fault);
    ASSERT_TRUE(haply_is_lost_soon(**device));
    EXPECT_TRUE(haply_tells_soon(**device, "nothing that makes sense")) << (*device)->condition();
    fake.set_fault(ServiceFault::None);
    EXPECT_TRUE(haply_reads_soon(**device));
  }
}

TEST(HaplyFailures, AFewAnswersThatMakeNoSenseAreLeftOut) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  fake.fail(ArmFault::NotANumber);
  EXPECT_TRUE(haply_tells_soon(*device, "make no sense and are left out"));
  EXPECT_TRUE(holds_soon([&] {
    PointerState state;
    return device->read(state) == DeviceStatus::Stalled;
  }));
  fake.fail(ArmFault::None);
  EXPECT_TRUE(haply_reads_soon(*device));
  EXPECT_EQ(device->counts().not_finite, 0u);
}

TEST(HaplyFailures, AnEnormousAnswer) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  ASSERT_TRUE(haply_reads_soon(*device));
  fake.answer_by(WebSocket::kMostBytes + 1);
  ASSERT_TRUE(haply_is_lost_soon(*device));
  expect_haply_back(*device);
  fake.answer_by(WebSocket::kMostBytes / 2);
  EXPECT_TRUE(haply_reads_soon(*device));
}

TEST(HaplyFailures, ADeviceThatIsUnpluggedWhetherOrNotThereAreEvents) {
  for (const bool events : {true, false}) {
    SCOPED_TRACE(events);
    FakeServiceSettings with;
    with.events = events;
    FakeInverseService fake(with);
    HaplySettings settings = settings_for(fake);
    settings.patience = 0.5;
    const auto device = open_haply_at(settings);
    ASSERT_TRUE(device) << device.error().message;
    ASSERT_TRUE(haply_reads_soon(**device));
    fake.plug(false);
    ASSERT_TRUE(haply_is_lost_soon(**device));
    EXPECT_TRUE(haply_tells_soon(**device, "no longer lists the Inverse3 049D"));
    fake.plug(true);
    EXPECT_TRUE(haply_reads_soon(**device));
  }
}

TEST(HaplyFailures, LeavingDoesNotWaitForAServiceThatSaysNothing) {
  FakeInverseService fake;
  HaplySettings settings = settings_for(fake);
  settings.patience = 60.0;
  auto device = open_haply_at(settings);
  ASSERT_TRUE(device);
  ASSERT_TRUE(haply_reads_soon(**device));
  fake.set_fault(ServiceFault::Silent);
  const std::int64_t begin = base::steady_nanoseconds();
  device->reset();
  EXPECT_LT(base::steady_nanoseconds() - begin, 30'000'000'000);
  EXPECT_TRUE(holds_soon([&] { return fake.held().isZero(0.0); }));
}

TEST(HaplyFailures, AnAnswerThatDoesNotComeLeavesNoForceBehind) {
  FakeInverseService fake;
  const auto device = haply_at(fake);  // which waits for 20 s
  ASSERT_TRUE(device);
  ASSERT_TRUE(haply_holds_until(*device, {1, 0, 0}, [&] { return fake.commanded().norm() > 0.5; }));
  fake.set_fault(ServiceFault::Silent);
  const std::int64_t begin = base::steady_nanoseconds();
  // Also while the servo has new forces.
  EXPECT_TRUE(haply_holds_until(*device, {1, 0, 0}, [&] { return fake.commanded().isZero(0.0); }));
  EXPECT_LT(base::steady_nanoseconds() - begin, 15'000'000'000);
  PointerState state;
  EXPECT_NE(device->read(state), DeviceStatus::Lost);
}

TEST(HaplyFailures, LeavingGivesNoForce) {
  FakeInverseService fake;
  auto device = haply_at(fake);
  ASSERT_TRUE(device);
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(haply_holds_until(*device, {1, 0, 0}, [&] { return fake.commanded().norm() > 0.1; }));
    device.reset();
    EXPECT_TRUE(holds_soon([&] { return fake.commanded().isZero(0.0); }));
    device = haply_at(fake);
    ASSERT_TRUE(device);
  }
}

/// A driver, and the link that a test asks for forces.
struct LinkedHaply {
  explicit LinkedHaply(const FakeInverseService& fake) : driver(settings_for(fake)) {
    const auto info = driver.open();
    EXPECT_TRUE(info) << info.error().message;
    link.connect(*info);
  }
  /// One exchange, with a force that never gets too old.
  bool exchange(const Vector3& force) {
    constexpr std::int64_t kMinute = 60'000'000'000;  // ns
    link.write(force, base::steady_nanoseconds() + kMinute);
    return driver.exchange(link);
  }

  HaplyDriver driver;
  DriverLink link{*find_device_profile("Haply Inverse3")};
};

TEST(HaplyFailures, AnswersThatComeLateAllAtOnceMakeNoLaterOneLate) {
  FakeInverseService fake;
  const Vector3 middle = HaplySettings().middle;
  fake.pin(middle);
  LinkedHaply haply(fake);
  for (int repeat = 0; repeat < 10; ++repeat) {
    ASSERT_TRUE(holds_soon([&] { return haply.exchange({1, 0, 0}) && fake.commanded().norm() > 0.1; }));
    fake.set_fault(ServiceFault::Frozen);
    std::thread waiting([&] { EXPECT_TRUE(haply.exchange({1, 0, 0})); });
    EXPECT_TRUE(holds_soon([&] { return fake.commanded().isZero(0.0); }));
    fake.set_fault(ServiceFault::None);
    waiting.join();
    const double x = repeat % 2 == 0 ? 0.001 : -0.001;  // m
    fake.pin(middle + Vector3(x, 0, 0));
    ASSERT_TRUE(haply.exchange({1, 0, 0}));
    PointerState state;
    ASSERT_EQ(haply.link.read(state), DeviceStatus::Ok);
    EXPECT_NEAR(state.position.x(), x, 1e-9) << "the answer before";
    EXPECT_LT(fake.commanded().norm(), 0.1) << "N, a blow instead of a ramp";
  }
}

TEST(HaplyFailures, LeavingDoesNotWaitForAConnectionThatIsTried) {
  FakeInverseService fake;
  HaplySettings settings = settings_for(fake);
  settings.connect_patience = 60.0;
  auto device = open_haply_at(settings);
  ASSERT_TRUE(device);
  ASSERT_TRUE(haply_reads_soon(**device));
  fake.set_fault(ServiceFault::Deaf);
  fake.hang_up();
  ASSERT_TRUE(haply_is_lost_soon(**device));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));  // it is looked for by now
  const std::int64_t begin = base::steady_nanoseconds();
  device->reset();
  EXPECT_LT(base::steady_nanoseconds() - begin, 20'000'000'000);
}

/// Waits until the device says so and gives no force, while one is asked for.
bool haply_withholds_soon(FakeInverseService& fake, DrivenDevice& device, const std::string& words) {
  PointerState state;
  return holds_soon([&] {
    device.read(state);
    device.write({0, 1, 0});
    return device.condition().find("No force: " + words) != std::string::npos && fake.commanded().isZero(0.0);
  });
}

/// Does it push again, from none?
void expect_haply_ramp(FakeInverseService& fake, DrivenDevice& device) {
  EXPECT_TRUE(haply_holds_until(device, {0, 1, 0}, [&] { return fake.commanded().norm() > 0.9; }))
      << device.condition();
  EXPECT_LT(fake.marks().steepest, 0.1) << "N, a blow instead of a ramp";
}

TEST(HaplyDriver, WithoutWhatItNeedsItGivesNoForce) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  struct Lack {
    bool calibrated, powered, ready;
    const char* words;
  };
  for (const Lack& lack : {Lack{false, true, true, "it is not calibrated"},
                           Lack{true, false, false, "it has no power; plug in its power supply"},
                           Lack{true, true, false, "it is not ready yet"}}) {
    SCOPED_TRACE(lack.words);
    ASSERT_TRUE(haply_holds_until(*device, {0, 1, 0}, [&] { return fake.commanded().norm() > 0.9; }));
    fake.set_status(lack.calibrated, lack.powered, lack.ready);
    EXPECT_TRUE(haply_withholds_soon(fake, *device, lack.words)) << device->condition();
    fake.watch();
    fake.set_status(true, true, true);
    expect_haply_ramp(fake, *device);
  }
  EXPECT_TRUE(holds_soon([&] { return device->condition().empty(); })) << device->condition();
}

void say_haply_event(FakeInverseService& fake, const char* name, const char* level, const char* message) {
  fake.say_event(std::string("{\"name\":\"") + name + R"(","category":"device","level":")" + level +
                 R"(","data":{"device_family":"inverse","device_id":"049D"},"message":")" + message + "\"}");
}

TEST(HaplyDriver, ASafetyStopLastsUntilItIsOver) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  const char* const stopped = "its safety stop has been triggered (\"stall\")";
  // The channel is open at some time; until then nobody hears.
  PointerState state;
  EXPECT_TRUE(holds_soon([&] {
    say_haply_event(fake, "device-safety-triggered", "warning", "stall");
    device->read(state);
    device->write({0, 1, 0});
    return device->condition().find(stopped) != std::string::npos && fake.commanded().isZero(0.0);
  })) << device->condition();
  say_haply_event(fake, "device-battery-low", "warning", "more news");
  EXPECT_TRUE(haply_withholds_soon(fake, *device, stopped)) << "other news do not end it";
  fake.watch();
  say_haply_event(fake, "device-safety-triggered", "info", "over");
  expect_haply_ramp(fake, *device);
  say_haply_event(fake, "device-safety-triggered", "error", "stall");
  EXPECT_TRUE(haply_withholds_soon(fake, *device, stopped));
  fake.set_status(true, false, true);
  const std::uint64_t before = fake.messages();
  EXPECT_TRUE(holds_soon([&] { return fake.messages() > before + 50; })) << "it has heard of that";
  EXPECT_TRUE(haply_withholds_soon(fake, *device, stopped));
  fake.watch();
  fake.set_status(true, true, true);
  expect_haply_ramp(fake, *device);
}

TEST(HaplyDriver, OneIsNeverOpenedTwice) {
  FakeServiceSettings two;
  two.devices = {"049D", "0555"};
  FakeInverseService fake(two);
  const auto first = haply_at(fake);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->identity(), "haply:049D");
  const auto again = open_haply_at(settings_for(fake), "049d");
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().message, "haply:049D is in use by this program already; disconnect it there first");
  auto second = open_haply_at(settings_for(fake));
  ASSERT_TRUE(second) << second.error().message;
  EXPECT_EQ((*second)->identity(), "haply:0555") << "the first that is free";
  EXPECT_FALSE(open_haply_at(settings_for(fake)));
  second->reset();
  EXPECT_TRUE(open_haply_at(settings_for(fake), "0555")) << "it is free again";
}

TEST(HaplyDriver, EventsAreTold) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  const auto say = [&](const char* name, const char* level, const char* data, const char* message) {
    fake.say_event(std::string("{\"name\":\"") + name + R"(","category":"device","level":")" + level +
                   "\",\"data\":" + data + ",\"message\":\"" + message + "\"}");
  };
  const char* const ours = R"({"device_family":"inverse","device_id":"049D"})";
  // The channel is open at some time; until then nobody hears.
  EXPECT_TRUE(holds_soon([&] {
    say("device-safety-triggered", "warning", ours, R"(stall \u001b[31m detected)");
    return device->condition().find("safety stop has been triggered") != std::string::npos;
  }));
  EXPECT_NE(device->condition().find("stall \\u001b[31m detected"), std::string::npos) << device->condition();
  say("device-safety-triggered", "error", R"({"device_id":"0555"})", "another one");
  fake.say_event("this is no event");
  say("device-connected", "info", ours, "");
  EXPECT_TRUE(holds_soon([&] { return device->condition().empty(); })) << device->condition();
  say("device-battery-low", "warning", R"({"device_family":"wireless_verse_grip","device_id":"8A21"})",
      "battery at 5 %");
  EXPECT_TRUE(haply_tells_soon(*device, "A VerseGrip: \"battery at 5 %\""));
  // An event says that the device is disconnected, but the service still lists it.
  say("device-disconnected", "warning", ours, "");
  EXPECT_TRUE(holds_soon([&] { return device->condition().empty(); })) << device->condition();
  EXPECT_TRUE(haply_reads_soon(*device));
}

TEST(HaplyDriver, NoForceAboveTheProfileReachesTheService) {
  FakeInverseService fake;
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  EXPECT_TRUE(holds_soon([&] {
    device->write({3, 3, 3});
    return fake.held().norm() > 4.9;
  }));
  for (const Vector3& force : {Vector3(100, 0, 0), Vector3(-7, 7, 7), Vector3(1e300, -1e300, 0),
                               Vector3(std::nan(""), 1, 1), Vector3(0, INFINITY, 0)}) {
    const std::uint64_t before = fake.messages();
    EXPECT_TRUE(holds_soon([&] {
      device->write(force);
      return fake.messages() > before + 50;
    }));
  }
  EXPECT_LE(fake.strongest(), 5.0 * (1.0 + 1e-6));
  EXPECT_LE(fake.strongest_component(), 5.0);
}

TEST(HaplyDriver, AnExchangeTakesNoMemory) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "a sanitizer needs the memory functions";
  FakeServiceSettings with;
  with.wireless_grip = true;
  FakeInverseService fake(with);
  HaplyDriver driver(settings_for(fake));
  const auto info = driver.open();
  ASSERT_TRUE(info) << info.error().message;
  DriverLink link(*info);
  link.connect(*info);
  const auto exchange = [&](int count) {
    for (int i = 0; i < count; ++i) {
      link.write({0.001 * i, 1, 0}, base::steady_nanoseconds());
      ASSERT_TRUE(driver.exchange(link));
    }
  };
  exchange(100);
  realtime::RealtimeGuard guard;
  exchange(300);
  guard.stop();
  EXPECT_EQ(guard.allocations(), 0u);
  EXPECT_EQ(guard.frees(), 0u);
  EXPECT_EQ(guard.locks(), 0u);
  EXPECT_GT(link.counts().passed, 300u);
  driver.close();
}

TEST(HaplyDriver, ALateServiceIsFollowed) {
  FakeServiceSettings late;
  late.latency = 0.005;
  FakeInverseService fake(late);
  const auto device = haply_at(fake);
  ASSERT_TRUE(device);
  fake.aim(HaplySettings().middle + Vector3(0.02, 0, 0));
  EXPECT_TRUE(
      haply_reads_soon(*device, [](const PointerState& state) { return state.position.x() > 0.019; }));
}

class HaplySuite : public testing::Test {
 protected:
  HaplySuite() {
    HaplySettings settings = settings_for(fake_);
    settings.patience = 1.0;
    auto device = open_haply_at(settings);
    EXPECT_TRUE(device) << device.error().message;
    rig_.device = std::move(*device);
    const Vector3 middle = settings.middle;
    rig_.aim = [this, middle](const Vector3& place) {
      fake_.aim(middle + Vector3(place.x(), -place.z(), place.y()));
    };
    rig_.strongest = [this] { return fake_.strongest(); };
    rig_.held = [this] { return fake_.held().norm(); };
    rig_.given = [this] { return fake_.given(); };
    rig_.plug = [this](bool in) { fake_.plug(in); };
    rig_.fail = [this](ArmFault fault) { fake_.fail(fault); };
    rig_.watch = [this] { fake_.watch(); };
    rig_.marks = [this] { return fake_.marks(); };
  }

  FakeInverseService fake_;
  suite::Rig rig_;
};

TEST_F(HaplySuite, FeelsTheFloor) { suite::feels_the_floor(rig_); }
TEST_F(HaplySuite, IsPassive) { suite::is_passive(rig_); }
TEST_F(HaplySuite, ComesBack) { suite::comes_back(rig_); }
TEST_F(HaplySuite, IsWatched) { suite::is_watched(rig_); }
TEST_F(HaplySuite, StandsFaults) { suite::stands_faults(rig_); }

class HaplyEnvironment : public testing::Test {
 protected:
  ~HaplyEnvironment() override {
    unsetenv("ICOME_HAPLY");
    unsetenv("ICOME_HAPLY_OPTIONS");
  }
  static void set(const FakeInverseService& fake) {
    setenv("ICOME_HAPLY", ("127.0.0.1:" + std::to_string(fake.port())).c_str(), 1);
    setenv("ICOME_HAPLY_OPTIONS",
           ("patience=20 connect=20 events=" + std::to_string(fake.events_port())).c_str(), 1);
  }
};

TEST_F(HaplyEnvironment, DevicesAreListedAndOpened) {
  FakeServiceSettings two;
  two.devices = {"049D", "0555"};
  two.wireless_grip = true;
  FakeInverseService fake(two);
  set(fake);
  const BackEnd back_end = haply_back_end();
  const auto entries = back_end.list();
  ASSERT_EQ(entries.size(), 2u) << entries.front().why;
  EXPECT_EQ(entries[0].name, "haply:049D");
  EXPECT_EQ(entries[0].family, "pointer");
  EXPECT_EQ(entries[0].backend, "haply");
  EXPECT_TRUE(entries[0].present);
  EXPECT_EQ(entries[0].why, "Haply Inverse3 with VerseGrip 8A21, Inverse Service 3.5.0-fake");
  EXPECT_EQ(entries[1].name, "haply:0555");
  EXPECT_EQ(entries[1].identity, "haply:0555");
  EXPECT_TRUE(back_end.open(""));
  EXPECT_TRUE(back_end.open("0555"));
  EXPECT_FALSE(back_end.open("0556"));
}

TEST_F(HaplyEnvironment, WhatIsMissingIsOneEntry) {
  FakeInverseService fake;
  set(fake);
  fake.stop();
  const BackEnd back_end = haply_back_end();
  const auto entries = back_end.list();
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].name, "haply");
  EXPECT_FALSE(entries[0].present);
  EXPECT_NE(entries[0].why.find("install it"), std::string::npos) << entries[0].why;
  setenv("ICOME_HAPLY", "here:there", 1);
  EXPECT_NE(back_end.list().at(0).why.find("HOST:PORT"), std::string::npos);
  EXPECT_FALSE(back_end.open(""));
}

}  // namespace
}  // namespace icome::devices
