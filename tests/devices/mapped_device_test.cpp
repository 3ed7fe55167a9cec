#include "devices/mapped_device.h"

#include <gtest/gtest.h>

#include <deque>
#include <limits>
#include <numbers>

namespace icome::devices {
namespace {

/// A device that gives the readings of the test, and keeps the force that it was told.
class ToldDevice final : public PointerDevice {
 public:
  const DeviceInfo& info() const override { return info_; }
  DeviceStatus read(PointerState& state) override {
    if (states.empty()) return DeviceStatus::Stalled;
    state = states.front();
    states.pop_front();
    return DeviceStatus::Ok;
  }
  DeviceStatus write(const Vector3& written) override {
    force = written;
    return DeviceStatus::Ok;
  }
  std::string condition() const override { return "warm"; }

  std::deque<PointerState> states;
  Vector3 force = Vector3::Zero();

 private:
  DeviceInfo info_ = {.name = "told",
                      .workspace_radius = 0.1,
                      .max_force = 4.0,
                      .continuous_force = 2.0,
                      .nominal_stiffness = 1000.0,
                      .effective_mass = 0.1};
};

PointerState at(const Vector3& place, std::uint32_t buttons = 0) {
  PointerState state;
  state.position = place;
  state.buttons = buttons;
  return state;
}

class MappedDeviceTest : public testing::Test {
 protected:
  void map(const DeviceMapping& mapping) {
    auto device = std::make_unique<ToldDevice>();
    told_ = device.get();
    mapped_ = std::make_unique<MappedDevice>(std::move(device), mapping);
  }

  PointerState read(const PointerState& raw) {
    told_->states.push_back(raw);
    EXPECT_EQ(mapped_->read(state_), DeviceStatus::Ok);
    return state_;
  }

  ToldDevice* told_ = nullptr;
  std::unique_ptr<MappedDevice> mapped_;
  PointerState state_;
};

TEST_F(MappedDeviceTest, TurnsMovesAndScales) {
  // Force Dimension's axes: x to the user, y right, z up.
  DeviceMapping mapping;
  mapping.centre = {0.01, 0.0, 0.0};
  mapping.ours_from_device = Quaternion((base::Matrix3() << 0, 1, 0, 0, 0, 1, 1, 0, 0).finished());
  mapping.scale = 2.0;
  map(mapping);
  PointerState raw = at({0.02, 0.03, 0.04});
  raw.velocity = {0.1, 0.2, 0.3};
  raw.orientation = Quaternion(Eigen::AngleAxisd(0.5, Vector3::UnitZ()));  // about its up
  const PointerState ours = read(raw);
  EXPECT_TRUE(ours.position.isApprox(Vector3(0.06, 0.08, 0.02)));
  EXPECT_TRUE(ours.velocity.isApprox(Vector3(0.4, 0.6, 0.2)));
  EXPECT_NEAR(ours.orientation.angularDistance(Quaternion(Eigen::AngleAxisd(0.5, Vector3::UnitY()))), 0.0,
              1e-9);
  mapped_->write({1.0, 2.0, 3.0});
  EXPECT_TRUE(told_->force.isApprox(Vector3(3.0, 1.0, 2.0)));
  EXPECT_EQ(mapped_->condition(), "warm");
}

TEST_F(MappedDeviceTest, ItsAbilitiesAreThoseOfTheTip) {
  map({.scale = 2.0, .workspace_radius = 0.08, .max_force = 1.5});
  EXPECT_DOUBLE_EQ(mapped_->info().workspace_radius, 0.16);
  EXPECT_DOUBLE_EQ(mapped_->info().max_force, 1.5);
  EXPECT_DOUBLE_EQ(mapped_->info().continuous_force, 1.5);
  EXPECT_DOUBLE_EQ(mapped_->info().nominal_stiffness, 500.0);
  EXPECT_DOUBLE_EQ(mapped_->info().effective_mass, 0.05);
  map({.max_force = 100.0});
  EXPECT_DOUBLE_EQ(mapped_->info().max_force, 4.0) << "no profile makes a device stronger";
}

TEST_F(MappedDeviceTest, NeverGivesMoreThanTheMappingSays) {
  map({.max_force = 1.5});
  mapped_->write({0.0, 3.0, -4.0});
  EXPECT_TRUE(told_->force.isApprox(Vector3(0.0, 0.9, -1.2)));
  mapped_->write({0.5, 0.0, 0.0});
  EXPECT_EQ(told_->force, Vector3(0.5, 0.0, 0.0));
  mapped_->write({std::numeric_limits<double>::quiet_NaN(), 1.0, 0.0});
  EXPECT_EQ(told_->force, Vector3::Zero());
  mapped_->write({1e200, 1e200, 0.0});
  EXPECT_LE(told_->force.norm(), 1.5);
}

TEST_F(MappedDeviceTest, AClutchLeavesTheTipWhereItIs) {
  map({.clutch_button = 1});
  EXPECT_EQ(read(at({0.05, 0, 0})).position.x(), 0.05);
  PointerState held = read(at({0.05, 0, 0}, 2));
  EXPECT_TRUE(held.parked);
  held = read(at({0.01, 0, 0}, 2));
  EXPECT_EQ(held.position.x(), 0.05);
  EXPECT_TRUE(held.velocity.isZero());
  const PointerState back = read(at({0.0, 0, 0}));
  EXPECT_EQ(back.position.x(), 0.05);
  EXPECT_FALSE(back.parked);
  EXPECT_TRUE(back.jumped) << "contacts are left";
  EXPECT_NEAR(read(at({0.02, 0, 0})).position.x(), 0.07, 1e-15);
  EXPECT_FALSE(state_.jumped);
}

TEST_F(MappedDeviceTest, KeepsTheOldStateWithoutANewReading) {
  map({.scale = 3.0});
  read(at({0.01, 0, 0}));
  EXPECT_EQ(mapped_->read(state_), DeviceStatus::Stalled);
  EXPECT_DOUBLE_EQ(state_.position.x(), 0.03);
}

}  // namespace
}  // namespace icome::devices
