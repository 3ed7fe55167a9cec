#include "session/probe/device_test.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numbers>

#include "base/clock.h"
#include "base/random.h"
#include "devices/simulated/simulated_device.h"

namespace icome::session {
namespace {

using devices::DeviceStatus;
using devices::PointerState;

bool on(double, double) { return true; }

/// A mass that forces reach after a delay, with readings that are noisy, all by the real clock.
class LateMass final : public devices::PointerDevice {
 public:
  LateMass(double delay, double noise) : delay_(delay), noise_(noise) {}

  const devices::DeviceInfo& info() const override { return info_; }
  DeviceStatus read(PointerState& state) override {
    const double now = 1e-9 * double(base::steady_nanoseconds());
    for (; time_ < now; time_ += kStep) {
      while (!sent_.empty() && sent_.front().first + delay_ <= time_) {
        force_ = sent_.front().second;
        sent_.pop_front();
      }
      // A loose grip.
      speed_ += kStep / 0.2 * (force_ - 6.0 * speed_ - 100.0 * place_);
      place_ += kStep * speed_;
    }
    state.position = {noise_ * error(), place_ + noise_ * error(), noise_ * error()};
    return DeviceStatus::Ok;
  }
  DeviceStatus write(const Vector3& force) override {
    sent_.emplace_back(1e-9 * double(base::steady_nanoseconds()), force.y());
    return DeviceStatus::Ok;
  }

 private:
  static constexpr double kStep = 2e-5;                                                  // s
  double error() { return random_.uniform(-std::numbers::sqrt3, std::numbers::sqrt3); }  // deviation 1
  devices::DeviceInfo info_ = {.name = "late mass"};
  double delay_, noise_;
  base::Random random_{3};
  std::deque<std::pair<double, double>> sent_;
  double time_ = 1e-9 * double(base::steady_nanoseconds());
  double force_ = 0.0, speed_ = 0.0, place_ = 0.0;
};

TEST(DeviceTest, MeasuresNoiseAtRest) {
  LateMass device(0.0, 30e-6);
  const auto result = test_device(device, {.seconds = 0.5}, on);
  ASSERT_TRUE(result);
  EXPECT_GT(result->readings, 50u);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(result->noise[axis], 30e-6, 8e-6);
  EXPECT_FALSE(result->force);
  EXPECT_GE(result->interval_ms.p99, result->interval_ms.median);
}

TEST(DeviceTest, ADeviceThatIsLedAboutTellsNoNoiseAndNoDelay) {
  devices::SimulatedSettings settings;
  settings.trajectory = [](double t) -> Vector3 {
    return {0.03 * std::cos(2.0 * M_PI * t), 0.03 * std::sin(2.0 * M_PI * t), 0.0};
  };
  devices::SimulatedDevice moving(std::move(settings));
  const auto led = test_device(moving, {.seconds = 0.5, .force = 0.5}, on);
  ASSERT_TRUE(led && led->force);
  EXPECT_FALSE(led->was_still);
  EXPECT_GT(led->moved, 0.02);
  EXPECT_FALSE(led->force->delay);
  LateMass device(0.0, 30e-6);
  const auto held = test_device(device, {.seconds = 0.5}, on);
  ASSERT_TRUE(held);
  EXPECT_TRUE(held->was_still);
  EXPECT_LT(held->moved, 1e-3);
}

// The machine may hold the loop up at any time, so only much more delay than there is would be wrong.
TEST(DeviceTest, TellsALateDeviceFromAQuickOne) {
  LateMass quick(0.0, 0.0);
  LateMass late(0.02, 0.0);
  const auto soon = test_device(quick, {.seconds = 0.1, .force = 0.5}, on);
  const auto later = test_device(late, {.seconds = 0.1, .force = 0.5}, on);
  ASSERT_TRUE(soon && later && soon->force && later->force);
  EXPECT_LE(later->force->strongest, 0.5 + 1e-9);
  EXPECT_GT(later->force->moved, 1e-3);
  ASSERT_TRUE(soon->force->delay && later->force->delay);
  EXPECT_GT(*later->force->delay, *soon->force->delay + 0.01);
  EXPECT_LT(*soon->force->delay, 0.015);
}

TEST(DeviceTest, SaysThatADeviceGaveNothing) {
  devices::SimulatedDevice device;
  device.inject(devices::SimulatedFailure::Unplugged);
  const auto result = test_device(device, {.seconds = 0.1}, on);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("no reading"), std::string::npos);
}

TEST(DeviceTest, EndsWhenItIsAskedTo) {
  devices::SimulatedDevice device;
  const auto result =
      test_device(device, {.seconds = 100.0}, [](double seconds, double) { return seconds < 0.1; });
  ASSERT_TRUE(result);
  EXPECT_LT(result->ticks.back().t, 50.0);
}

TEST(DeviceTest, FindsTheRangeOfAHand) {
  devices::SimulatedSettings settings;
  settings.trajectory = [](double t) -> Vector3 {
    return {0.01 + 0.05 * std::sin(20.0 * t), 0.03 * std::sin(20.0 * t), 0.02 * std::cos(20.0 * t)};
  };
  devices::SimulatedDevice device(settings);
  const auto range = find_range(device, 1000.0, 1.0, on);
  ASSERT_TRUE(range);
  EXPECT_NEAR(range->centre().x(), 0.01, 0.01);
  EXPECT_GT(range->high.x() - range->low.x(), 0.03);
}

}  // namespace
}  // namespace icome::session
