#include "devices/vrpn/vrpn_driver.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "devices/driver/driven_device.h"
#include "devices/driver_suite.h"
#include "devices/fakes/fake_vrpn.h"
#include "devices/vrpn/vrpn_back_end.h"
#include "devices/vrpn/vrpn_head.h"

namespace icome::devices {
namespace {

using fakes::FakeVrpn;
using suite::holds_soon;

std::unique_ptr<PointerDevice> opened(const std::string& address) {
  auto parsed = VrpnAddress::parse(address);
  EXPECT_TRUE(parsed);
  auto device = DrivenDevice::create(std::make_unique<VrpnDriver>(*parsed), {.retry = 0.02});
  EXPECT_TRUE(device) << device.error().message;
  return device ? std::move(*device) : nullptr;
}

class VrpnSuite : public testing::Test {
 protected:
  void SetUp() override {
    rig_.device = opened(fake_.address());
    ASSERT_NE(rig_.device, nullptr);
    rig_.aim = [this](const Vector3& place) { fake_.aim(place); };
    rig_.strongest = [this] { return fake_.strongest(); };
    rig_.held = [this] { return fake_.held(); };
    rig_.given = [this] { return fake_.given(); };
    rig_.plug = [this](bool in) { fake_.switch_on(in); };
    rig_.fail = [this](fakes::ArmFault fault) { fake_.fail(fault); };
  }
  FakeVrpn fake_;
  suite::Rig rig_;
};

TEST_F(VrpnSuite, FeelsTheFloor) { suite::feels_the_floor(rig_); }
TEST_F(VrpnSuite, IsPassive) { suite::is_passive(rig_); }
TEST_F(VrpnSuite, ComesBack) { suite::comes_back(rig_); }
TEST_F(VrpnSuite, IsWatched) { suite::is_watched(rig_); }
TEST_F(VrpnSuite, StandsFaults) { suite::stands_faults(rig_); }

/// Reads until the newest state fulfils the condition; false when it never does.
bool reads_soon(PointerDevice& device, const std::function<bool(const PointerState&)>& condition) {
  PointerState state;
  return holds_soon([&] { return device.read(state) == DeviceStatus::Ok && condition(state); });
}

TEST(VrpnDriver, PoseAndButtonsComeAsTheServerHasThem) {
  FakeVrpn fake;
  const auto device = opened(fake.address());
  ASSERT_NE(device, nullptr);
  EXPECT_EQ(device->info().max_force, 3.3);
  fake.aim({0.01, -0.02, 0.03});
  EXPECT_TRUE(reads_soon(*device, [](const PointerState& state) {
    return state.position.isApprox(Vector3(0.01, -0.02, 0.03), 1e-3);
  }));
  fake.press(0b101);
  EXPECT_TRUE(reads_soon(*device, [](const PointerState& state) { return state.buttons == 0b101; }));
  fake.press(0b001);
  EXPECT_TRUE(reads_soon(*device, [](const PointerState& state) { return state.buttons == 0b001; }));
}

TEST(VrpnDriver, AForceFieldGivesTheForceToo) {
  FakeVrpn fake;
  const auto device = opened(fake.address() + "?forces=fields");
  ASSERT_NE(device, nullptr);
  PointerState state;
  EXPECT_TRUE(holds_soon([&] {
    device->read(state);
    device->write({0, 1.0, 0});
    return fake.held() > 0.5;
  }));
  EXPECT_TRUE(holds_soon([&] { return fake.held() == 0.0; })) << "nobody writes any more";
}

TEST(VrpnDriver, WithoutForcesWhereTheAddressSaysSo) {
  FakeVrpn fake;
  const auto device = opened(fake.address() + "?forces=none");
  ASSERT_NE(device, nullptr);
  EXPECT_EQ(device->info().max_force, 0.0);
}

TEST(VrpnDriver, AbsenceIsToldInASentence) {
  int port = 0;
  {
    const FakeVrpn fake;
    port = fake.port();
    VrpnDriver other(*VrpnAddress::parse("Arm@127.0.0.1:" + std::to_string(port)));
    const auto refused = other.open();
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("no device 'Arm'; it has Pointer0"), std::string::npos)
        << refused.error().message;
  }
  VrpnDriver driver(*VrpnAddress::parse("Pointer0@127.0.0.1:" + std::to_string(port)));
  const auto refused = driver.open();
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("no VRPN server answers at 127.0.0.1:"), std::string::npos)
      << refused.error().message;
}

TEST(VrpnHead, TurnsAndMovesFromItsFirstPose) {
  VrpnServerSettings settings;
  settings.port = 0;
  auto server = VrpnServer::create(settings);
  ASSERT_TRUE(server) << server.error().message;
  PointerState state;
  const Quaternion mounted(Eigen::AngleAxisd(1.0, Vector3(1, 2, 3).normalized()));
  state.position = {0.5, 1.7, 2.0};
  state.orientation = mounted;
  auto head = tl::expected<std::unique_ptr<VrpnHead>, base::Error>(tl::unexpected(base::Error{"not yet"}));
  std::atomic<bool> stop = false;
  realtime::LatestValue<PointerState> poses(state);
  std::thread feeder([&] {
    while (!stop) {
      poses.update();
      (*server)->feed(poses.read(), Vector3::Zero());
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  });
  head = VrpnHead::create("Pointer0@" + (*server)->listening());
  Pose pose = Pose::Identity();
  if (head) {
    EXPECT_TRUE(holds_soon([&] { return (*head)->read(pose) == DeviceStatus::Ok; }));
    EXPECT_TRUE(pose.isApprox(Pose::Identity(), 1e-9));
    // A look to the left, and a step to the right, whatever way the tracker is mounted.
    const Quaternion left(Eigen::AngleAxisd(0.5, Vector3::UnitY()));
    state.orientation = left * mounted;
    state.position.x() += 0.2;
    poses.publish(state);
    EXPECT_TRUE(holds_soon([&] {
      return (*head)->read(pose) == DeviceStatus::Ok &&
             Quaternion(pose.linear()).angularDistance(left) < 1e-9 &&
             pose.translation().isApprox(Vector3(0.2, 0, 0), 1e-9);
    }));
  }
  stop = true;
  feeder.join();
  EXPECT_TRUE(head) << head.error().message;
}

TEST(VrpnBackEnd, ListsTrackersThatReportAndOpensThem) {
  FakeVrpn fake;
  setenv("ICOME_VRPN", ("127.0.0.1:" + std::to_string(fake.port())).c_str(), 1);
  const BackEnd back_end = vrpn_back_end();
  const auto entries = back_end.list();
  ASSERT_EQ(entries.size(), 1U);
  EXPECT_EQ(entries[0].name, "vrpn:" + fake.address());
  EXPECT_EQ(entries[0].family, "pointer");
  EXPECT_EQ(entries[0].backend, "vrpn");
  EXPECT_TRUE(entries[0].present);
  EXPECT_TRUE(back_end.open(fake.address()));
  EXPECT_TRUE(back_end.open("")) << "the first there is";
  fake.switch_on(false);
  const auto absent = back_end.list();
  ASSERT_EQ(absent.size(), 1U);
  EXPECT_FALSE(absent[0].present);
  EXPECT_NE(absent[0].why.find("no VRPN server answers at 127.0.0.1"), std::string::npos) << absent[0].why;
  const auto none = back_end.open("");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message, absent[0].why);
  unsetenv("ICOME_VRPN");
}

}  // namespace
}  // namespace icome::devices
