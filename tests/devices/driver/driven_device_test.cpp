#include "devices/driver/driven_device.h"

#include <gtest/gtest.h>

#include <mutex>

#include "devices/driver_suite.h"

namespace icome::devices {
namespace {

using fakes::ArmFault;
using fakes::FakeArm;

/// An arm on a loop of its own, at 1 kHz, that can be unplugged.
struct ArmOnATable {
  std::mutex guard;
  FakeArm arm;
  bool plugged = true;
  std::int64_t start = base::steady_nanoseconds();

  double now() const { return 1e-9 * double(base::steady_nanoseconds() - start); }
};

class ArmDriver final : public Driver {
 public:
  explicit ArmDriver(std::shared_ptr<ArmOnATable> table) : table_(std::move(table)) {}

  base::Result<DeviceInfo> open() override {
    const std::lock_guard lock(table_->guard);
    if (!table_->plugged) return base::fail("arm: it is not plugged in");
    DeviceInfo info;
    info.name = "arm";
    return info;
  }

  std::string run(DriverLink& link, const std::atomic<bool>& stop) override {
    while (!stop) {
      const std::int64_t now = base::steady_nanoseconds();
      const Vector3 force = link.force(now);
      {
        const std::lock_guard lock(table_->guard);
        if (!table_->plugged) return "The arm was unplugged.";
        const FakeArm::Reading reading = table_->arm.read(table_->now());
        table_->arm.push(force, table_->now());
        PointerState state;
        state.position = reading.position;
        state.velocity = reading.velocity;
        link.pass(state, now);
      }
      realtime::sleep_until(now + 1'000'000);
    }
    return {};
  }

  void close() override {
    const std::lock_guard lock(table_->guard);
    table_->arm.push(Vector3::Zero(), table_->now());
  }

 private:
  std::shared_ptr<ArmOnATable> table_;
};

class DrivenDeviceTest : public testing::Test {
 public:
  DrivenDeviceTest() {
    auto device = DrivenDevice::create(std::make_unique<ArmDriver>(table), {.retry = 0.02});
    rig.device = std::move(*device);
    rig.aim = [this](const Vector3& place) {
      const std::lock_guard lock(table->guard);
      table->arm.aim(place);
    };
    rig.strongest = [this] {
      const std::lock_guard lock(table->guard);
      return table->arm.strongest();
    };
    rig.held = [this] {
      const std::lock_guard lock(table->guard);
      table->arm.read(table->now());
      return table->arm.held().norm();
    };
    rig.given = [this] {
      const std::lock_guard lock(table->guard);
      return table->arm.given();
    };
    rig.plug = [this](bool plugged) {
      const std::lock_guard lock(table->guard);
      table->plugged = plugged;
    };
    rig.fail = [this](ArmFault fault) {
      const std::lock_guard lock(table->guard);
      table->arm.fail(fault);
    };
  }

  std::shared_ptr<ArmOnATable> table = std::make_shared<ArmOnATable>();
  suite::Rig rig;
};

TEST_F(DrivenDeviceTest, FeelsTheFloor) { suite::feels_the_floor(rig); }
TEST_F(DrivenDeviceTest, IsPassive) { suite::is_passive(rig); }
TEST_F(DrivenDeviceTest, ComesBack) { suite::comes_back(rig); }
TEST_F(DrivenDeviceTest, IsWatched) { suite::is_watched(rig); }
TEST_F(DrivenDeviceTest, StandsFaults) { suite::stands_faults(rig); }

TEST_F(DrivenDeviceTest, HasNoForceLeftWhenItIsGone) {
  {
    suite::Touching touching(rig);
    rig.aim({0, suite::Touching::kFloor - 0.01, 0});
    ASSERT_TRUE(touching.until([this](const auto&) { return rig.held() > 0.5; }));
  }
  rig.device.reset();
  EXPECT_TRUE(suite::holds_soon([this] { return rig.held() == 0.0; }));
}

TEST(DrivenDevice, SaysWhyItCannotBeOpened) {
  auto table = std::make_shared<ArmOnATable>();
  table->plugged = false;
  const auto device = DrivenDevice::create(std::make_unique<ArmDriver>(table));
  ASSERT_FALSE(device);
  EXPECT_EQ(device.error().message, "arm: it is not plugged in");
}

}  // namespace
}  // namespace icome::devices
