#include "session/probe/device_sharing.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "devices/fakes/plain_vrpn_client.h"
#include "devices/simulated/simulated_device.h"

namespace icome::session {
namespace {

using base::Vector3;
using devices::fakes::PlainClient;
using VrpnKind = devices::vrpn::Kind;

/// What a shared device was told, which lives longer than the device.
struct Watched {
  std::atomic<double> force_y = 0.0;  // N, as written last
  std::atomic<bool> lost = false;
};

/// A simulated hand at rest, which may be unplugged.
class WatchedDevice final : public devices::PointerDevice {
 public:
  WatchedDevice(Watched& watched, const Vector3& place) : watched_(watched), hand_(at(place)) {
    hand_.set_target(place);
  }
  const devices::DeviceInfo& info() const override { return hand_.info(); }
  devices::DeviceStatus read(devices::PointerState& state) override {
    hand_.inject(watched_.lost ? devices::SimulatedFailure::Unplugged : devices::SimulatedFailure::None);
    return hand_.read(state);
  }
  devices::DeviceStatus write(const Vector3& force) override {
    watched_.force_y = force.y();
    return hand_.write(force);
  }

 private:
  static devices::SimulatedSettings at(const Vector3& place) {
    devices::SimulatedSettings settings;
    settings.start = place;
    return settings;
  }
  Watched& watched_;
  devices::SimulatedDevice hand_;
};

class DeviceSharingTest : public testing::Test {
 protected:
  void SetUp() override {
    std::vector<std::unique_ptr<devices::PointerDevice>> all;
    all.push_back(std::make_unique<WatchedDevice>(watched_[0], Vector3(0.01, 0.0, 0.0)));
    all.push_back(std::make_unique<WatchedDevice>(watched_[1], Vector3(0.02, 0.0, 0.0)));
    devices::VrpnServerSettings settings;
    settings.port = 0;
    settings.names = {"Left", "Right"};
    auto sharing = DeviceSharing::create(std::move(all), settings, 1000.0);
    ASSERT_TRUE(sharing) << sharing.error().message;
    sharing_ = std::move(*sharing);
    const std::string place = sharing_->server().listening();
    port_ = std::stoi(place.substr(place.find(':') + 1));
  }
  /// A floor 2 mm above the hands: 0.4 N at 200 N/m, less as they give way.
  static devices::vrpn::Payload floor() {
    devices::vrpn::Plane plane;
    plane.normal = {0, 1, 0};
    plane.offset = -0.002;
    plane.spring = 0.2;
    return pack(plane);
  }
  static bool happens(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }

  std::array<Watched, 2> watched_;
  std::unique_ptr<DeviceSharing> sharing_;
  int port_ = 0;
};

TEST_F(DeviceSharingTest, ProgramsSeeEachDevice) {
  PlainClient client(port_);
  client.greet("Left");
  const auto is_at = [](double x) {
    return [x](std::string_view payload) {
      return std::abs(devices::vrpn::read_pos_quat(payload)->position.x() - x) < 1e-4;
    };
  };
  EXPECT_TRUE(client.hears(VrpnKind::PosQuat, is_at(0.01), "Left"));
  EXPECT_TRUE(client.hears(VrpnKind::PosQuat, is_at(0.02), "Right"));
  EXPECT_EQ(sharing_->devices(), 2U);
}

TEST_F(DeviceSharingTest, ForcesOfAProgramAreFeltOnItsDeviceUntilItLeaves) {
  {
    PlainClient client(port_);
    client.greet("Right");
    client.say(VrpnKind::Plane, floor());
    EXPECT_TRUE(happens([&] { return watched_[1].force_y > 0.1; }));
    EXPECT_TRUE(client.hears(
        VrpnKind::Force,
        [](std::string_view payload) {
          const devices::vrpn::Payload none = devices::vrpn::Payload().put(Vector3(0, 0, 0));
          return payload != none.bytes();
        },
        "Right"));
    EXPECT_EQ(watched_[0].force_y, 0.0);
  }
  EXPECT_TRUE(happens([&] { return watched_[1].force_y == 0.0; }));
}

TEST_F(DeviceSharingTest, ADeviceThatIsLostHasNoForceAndComesBack) {
  PlainClient client(port_);
  client.greet("Left");
  client.say(VrpnKind::Plane, floor());
  ASSERT_TRUE(happens([&] { return watched_[0].force_y > 0.1; }));
  watched_[0].lost = true;
  EXPECT_TRUE(happens([&] { return watched_[0].force_y == 0.0; }));
  EXPECT_TRUE(client.hears(
      VrpnKind::PosQuat, [](std::string_view) { return true; }, "Right"))
      << "the other goes on";
  watched_[0].lost = false;
  EXPECT_TRUE(happens([&] { return watched_[0].force_y > 0.1; }));
}

TEST_F(DeviceSharingTest, ItEndsWithoutForcesAndSaysFarewell) {
  PlainClient client(port_);
  client.greet("Left");
  client.say(VrpnKind::Plane, floor());
  ASSERT_TRUE(happens([&] { return watched_[0].force_y > 0.1; }));
  sharing_.reset();
  EXPECT_EQ(watched_[0].force_y, 0.0);
  EXPECT_TRUE(client.is_closed());
}

TEST_F(DeviceSharingTest, WhatCannotBeginIsTold) {
  devices::VrpnServerSettings settings;
  settings.port = port_;
  EXPECT_FALSE(DeviceSharing::create({}, settings, 1000.0)) << "the port is taken";
  settings.port = 0;
  EXPECT_FALSE(DeviceSharing::create({}, settings, 1.0)) << "no rate of a loop";
}

}  // namespace
}  // namespace icome::session
