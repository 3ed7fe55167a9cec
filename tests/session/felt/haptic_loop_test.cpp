// The servo's thread in a session.
#include "session/felt/haptic_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

#include "haptics/contact_world.h"
#include "realtime/guard/guard.h"
#include "session/sessions.h"

namespace icome::session {
namespace {

using base::Vector3;

std::vector<std::unique_ptr<devices::PointerDevice>> list(std::unique_ptr<devices::PointerDevice> device) {
  std::vector<std::unique_ptr<devices::PointerDevice>> devices;
  devices.push_back(std::move(device));
  return devices;
}

template <typename IsSo>
void wait_until(const IsSo& is_so) {
  while (!is_so()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::shared_ptr<const haptics::HapticScene> box_scene() {
  return haptics::HapticScene::compile(
      {haptics::object(1, haptics::shape_of(haptics::primitive("box:0.1x0.1x0.1")))});
}

TEST(HapticLoop, TellsWhereThePointersAreAndWhatTheyFeel) {
  auto devices = list(hand_at({0.0, 0.0, 0.06}));
  devices.push_back(hand_at({0.2, 0.0, 0.0}));
  auto* first = static_cast<devices::SimulatedDevice*>(devices[0].get());
  DisplayFeed display(2);
  HapticLoop loop(std::move(devices), {}, display);
  EXPECT_EQ(loop.view(0).time, 0);
  loop.felt().publish(box_scene());
  ASSERT_TRUE(loop.start(false));
  first->set_target({0.0, 0.0, 0.04});
  wait_until([&] {
    loop.update();
    return loop.view(0).touching && loop.view(0).force.z() > 1.0 && loop.view(1).time != 0;
  });
  EXPECT_EQ(loop.view(0).status, devices::DeviceStatus::Ok);
  EXPECT_EQ(loop.view(0).touched, (base::ObjectId{1, 1}));
  EXPECT_NEAR(loop.view(0).scp.z(), 0.05, 1e-6);
  EXPECT_LT(loop.view(0).tip.z(), 0.05);
  EXPECT_FALSE(loop.view(1).touching);
  EXPECT_NEAR((loop.view(1).tip - Vector3(0.2, 0.0, 0.0)).norm(), 0.0, 1e-12);
  EXPECT_EQ(loop.view(1).scp, loop.view(1).tip);
}

TEST(HapticLoop, SamplesTheForceSome200TimesASecond) {
  auto devices = list(hand_at({0.0, 0.0, 0.06}));
  auto* hand = static_cast<devices::SimulatedDevice*>(devices[0].get());
  DisplayFeed display(1);
  HapticLoop loop(std::move(devices), {}, display);
  loop.felt().publish(box_scene());
  ASSERT_TRUE(loop.start(false));
  hand->set_target({0.0, 0.0, 0.04});
  std::vector<ForceSample> samples;
  wait_until([&] {
    for (const ForceSample& it : loop.take_forces()) samples.push_back(it);
    return !samples.empty() && samples.back().touching && samples.back().force > 1.0;
  });
  loop.stop();
  for (const ForceSample& it : loop.take_forces()) samples.push_back(it);
  EXPECT_EQ(samples.size(), loop.ticks() / 5);
  for (std::size_t i = 1; i < samples.size(); ++i) EXPECT_GT(samples[i].time, samples[i - 1].time);
  EXPECT_FALSE(samples.front().touching);
  EXPECT_EQ(samples.front().force, 0.0F);
}

TEST(HapticLoop, CountsHowOftenADeviceWasLostInTheViewItself) {
  auto devices = list(hand_at({0.0, 0.0, 0.0}));
  auto* hand = static_cast<devices::SimulatedDevice*>(devices[0].get());
  hand->inject(devices::SimulatedFailure::Unplugged);  // from the first tick on
  DisplayFeed display(1);
  HapticLoop loop(std::move(devices), {}, display);
  ASSERT_TRUE(loop.start(false));
  for (std::uint64_t i = 1; i <= 3; ++i) {
    wait_until([&] {
      loop.update();
      return loop.view(0).losses == i;
    });
    EXPECT_EQ(loop.view(0).status, devices::DeviceStatus::Lost);  // of the same tick
    hand->inject(devices::SimulatedFailure::None);
    wait_until([&] {
      loop.update();
      return loop.view(0).status == devices::DeviceStatus::Ok;
    });
    EXPECT_EQ(loop.view(0).losses, i);
    hand->inject(devices::SimulatedFailure::Unplugged);
  }
}

/// Watches over the thread that reads it: from one of its readings to another.
class GuardedDevice final : public devices::PointerDevice {
 public:
  static constexpr int kFrom = 100, kTo = 600;

  const devices::DeviceInfo& info() const override { return info_; }
  devices::DeviceStatus read(devices::PointerState& state) override {
    ++reads_;
    if (reads_ == kFrom) guard_.emplace();
    if (reads_ == kTo) {
      guard_->stop();
      done.store(true, std::memory_order_release);
    }
    state.position = {0.0, 0.0, 0.06 - 0.02 * std::abs(std::sin(0.05 * reads_))};
    return reads_ % 50 == 0 ? devices::DeviceStatus::Lost : devices::DeviceStatus::Ok;
  }
  devices::DeviceStatus write(const Vector3&) override { return devices::DeviceStatus::Ok; }

  std::atomic<bool> done = false;
  const realtime::RealtimeGuard& guard() const { return *guard_; }

 private:
  devices::DeviceInfo info_;
  int reads_ = 0;
  std::optional<realtime::RealtimeGuard> guard_;
};

TEST(HapticLoop, TakesNoMemoryAndNoLocksWhileAllOthersAreBusy) {
  if (!realtime::RealtimeGuard::available()) GTEST_SKIP() << "sanitizers need these functions themselves";
  auto devices = list(std::make_unique<GuardedDevice>());
  auto* device = static_cast<GuardedDevice*>(devices[0].get());
  DisplayFeed display(1);
  HapticLoop loop(std::move(devices), {}, display);
  ASSERT_TRUE(loop.start(false));
  // Scenes come and go, main looks, the display looks, the workspace is carried about.
  std::atomic<bool> stop = false;
  std::thread eye([&] {
    while (!stop.load()) display.is_due();
  });
  base::Pose place = base::Pose::Identity();
  wait_until([&] {
    loop.felt().publish(box_scene());
    place.translation().x() = place.translation().x() > 0.01 ? 0.0 : place.translation().x() + 1e-3;
    loop.carry(0, place);
    loop.update();
    return device->done.load(std::memory_order_acquire);
  });
  stop.store(true);
  eye.join();
  loop.stop();
  EXPECT_EQ(device->guard().allocations(), 0U);
  EXPECT_EQ(device->guard().frees(), 0U);
  EXPECT_EQ(device->guard().locks(), 0U);
}

TEST(HapticLoop, RefusesARateThatNoDeviceHas) {
  DisplayFeed display(1);
  haptics::ServoSettings settings;
  settings.rate_hz = 10.0;
  HapticLoop loop(list(hand_at(Vector3::Zero())), settings, display);
  EXPECT_FALSE(loop.start(false));
  loop.stop();
}

}  // namespace
}  // namespace icome::session
