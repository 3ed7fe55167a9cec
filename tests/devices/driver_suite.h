#pragma once
// Tests that every back-end with forces passes through its fake: a whole servo touches a floor with it.
// Nothing here counts on the machine to keep time: conditions are waited for, and bounds hold however late a
// tick comes.
#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <thread>

#include "base/clock.h"
#include "devices/fakes/fake_arm.h"
#include "devices/pointer_device.h"
#include "haptics/contact/haptic_scene.h"
#include "haptics/servo/servo.h"
#include "haptics/shapes/primitive_shape.h"
#include "realtime/this_thread.h"
#include "repeats.h"

namespace icome::devices::suite {

/// A device of a back-end, and the fake behind it. All vectors in our axes (x right, y up, z to the user), m
/// and N; called from the test's thread while the driver runs.
struct Rig {
  std::unique_ptr<PointerDevice> device;
  std::function<void(const Vector3&)> aim;    // the place that the fake's hand pulls to
  std::function<double()> strongest;          // N, the strongest force that ever reached the motors
  std::function<double()> held;               // N, that the motors hold now
  std::function<double()> given;              // J, the motors' work so far
  std::function<void(bool)> plug;             // unplugged and plugged in again
  std::function<void(fakes::ArmFault)> fail;  // faults of readings
};

constexpr auto kPatience = std::chrono::seconds(30);

/// Lets no ordinary thread delay the calling one as long as it lives, where the system permits that: a servo
/// whose ticks come more than the watchdog's time apart never gets its force to the hand.
class Undelayed {
 public:
  Undelayed() {
    pthread_getschedparam(pthread_self(), &policy_, &before_);
    static_cast<void>(realtime::ask_for_realtime_priority(50));
  }
  ~Undelayed() { pthread_setschedparam(pthread_self(), policy_, &before_); }
  Undelayed(const Undelayed&) = delete;
  Undelayed& operator=(const Undelayed&) = delete;

 private:
  int policy_ = SCHED_OTHER;
  sched_param before_{};
};

/// Waits until a condition holds; false when it never does.
inline bool holds_soon(const std::function<bool()>& condition) {
  const Undelayed undelayed;  // conditions write forces
  const auto end = std::chrono::steady_clock::now() + kPatience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

/// A servo with a floor, whose top is 10 mm below the middle of the device's workspace.
class Touching {
 public:
  static constexpr double kFloor = -0.01;      // m, y
  static constexpr double kStiffness = 400.0;  // N/m

  explicit Touching(Rig& rig) : rig_(rig), servo_(*rig.device, settings()) { servo_.publish(floor()); }

  /// Ticks until a condition holds, once a millisecond where the machine keeps up; false when it never does.
  bool until(const std::function<bool(const haptics::TickReport&)>& condition) {
    const auto end = std::chrono::steady_clock::now() + kPatience;
    while (std::chrono::steady_clock::now() < end) {
      if (condition(tick())) return true;
    }
    return false;
  }

  const haptics::TickReport& tick() {
    realtime::sleep_until(std::max(last_ + kPeriod, base::steady_nanoseconds()));
    const std::int64_t now = base::steady_nanoseconds();
    const double dt = last_ == 0 ? 1e-9 * kPeriod : 1e-9 * double(now - last_);
    last_ = now;
    const Vector3 before = servo_.last().force;
    const haptics::TickReport& report = servo_.tick(dt);
    const double grown = report.force.norm() - before.norm();
    fastest_ = std::max(fastest_, grown / std::min(dt, 0.01));
    return report;
  }

  void ticks(int count) {
    for (int i = 0; i < count; ++i) tick();
  }

  /// The fastest growth of the force so far, N/s.
  double fastest() const { return fastest_; }

 private:
  static constexpr std::int64_t kPeriod = 1'000'000;  // ns

  static haptics::ServoSettings settings() {
    haptics::ServoSettings settings;
    settings.limiter.max_rate = 2000.0;
    return settings;
  }

  static std::shared_ptr<const haptics::HapticScene> floor() {
    haptics::HapticObject object;
    object.id = {1, 1};
    object.shape = std::make_shared<haptics::PrimitiveShape>(*geometry::parse_primitive("box:0.6x0.2x0.6"));
    object.world_from_object.translation().y() = kFloor - 0.1;
    object.surface.stiffness = kStiffness;
    return haptics::HapticScene::compile({object});
  }

  Undelayed undelayed_;
  Rig& rig_;
  haptics::Servo servo_;
  std::int64_t last_ = 0;  // ns, of the last tick; 0 before the first
  double fastest_ = 0.0;
};

/// A hand that presses on the floor is held up, within the device's limits, and without steps of the force.
inline void feels_the_floor(Rig& rig) {
  Touching touching(rig);
  rig.aim({0, 0, 0});
  ASSERT_TRUE(touching.until([](const auto& report) { return report.status == DeviceStatus::Ok; }));
  rig.aim({0, Touching::kFloor - 0.01, 0});
  EXPECT_TRUE(touching.until([](const auto& report) {
    return report.contact.touching && report.force.y() > 0.5;
  })) << "the floor is not felt; tip "
      << touching.tick().tip.transpose();
  EXPECT_TRUE(touching.until([&](const auto&) { return rig.held() > 0.5; })) << "the motors do not get it";
  EXPECT_LE(rig.strongest(), rig.device->info().max_force * (1.0 + 1e-6));
  EXPECT_LE(touching.fastest(), 2000.0 * (1.0 + 1e-6));
}

/// The work, J, of the motors while a hand goes into the floor and out again.
inline double work_of_a_press(Rig& rig, Touching& touching) {
  rig.aim({0, 0, 0});
  EXPECT_TRUE(touching.until([](const auto& report) { return report.tip.y() > 0.3 * Touching::kFloor; }));
  touching.ticks(100);
  const double before = rig.given();
  rig.aim({0, Touching::kFloor - 0.008, 0});
  EXPECT_TRUE(touching.until([](const auto& report) { return report.force.y() > 0.5; }));
  touching.ticks(100);
  rig.aim({0, 0, 0});
  EXPECT_TRUE(touching.until([](const auto& report) { return report.tip.y() > 0.5 * Touching::kFloor; }));
  return rig.given() - before;
}

/// While a hand goes into the floor and out again the motors give no more work than they take: a virtual
/// floor has no energy of its own. Where the machine stands still meanwhile, the watchdog takes the force
/// away and gives it back, which costs the energy that the spring holds; so the best of some presses counts.
inline void is_passive(Rig& rig) {
  constexpr double kNothing = 5e-4;  // J, of 5 mJ that the floor's spring holds
  Touching touching(rig);
  ASSERT_TRUE(touching.until([](const auto& report) { return report.status == DeviceStatus::Ok; }));
  double least = work_of_a_press(rig, touching);
  for (int press = 0; press < 20 && least > kNothing; ++press)
    least = std::min(least, work_of_a_press(rig, touching));
  EXPECT_LE(least, kNothing) << "J, more than the hand put in";
}

/// Unplugged, the servo is told and there is no force; plugged in again it goes on by itself, gently.
inline void comes_back(Rig& rig) {
  Touching touching(rig);
  rig.aim({0, Touching::kFloor - 0.01, 0});
  ASSERT_TRUE(touching.until([](const auto& report) { return report.force.y() > 0.5; }));
  rig.plug(false);
  ASSERT_TRUE(touching.until([](const auto& report) { return report.status == DeviceStatus::Lost; }));
  EXPECT_EQ(touching.tick().force.norm(), 0.0);
  EXPECT_TRUE(holds_soon([&] { return !rig.device->condition().empty(); })) << "nobody is told why";
  rig.plug(true);
  ASSERT_TRUE(touching.until([](const auto& report) { return report.status == DeviceStatus::Ok; }));
  EXPECT_LT(touching.tick().force.norm(), 0.5) << "a blow instead of a ramp";
  EXPECT_TRUE(touching.until([](const auto& report) { return report.force.y() > 0.5; }));
  EXPECT_LE(rig.strongest(), rig.device->info().max_force * (1.0 + 1e-6));
}

/// The last force of a servo whose thread stands still is taken away.
inline void is_watched(Rig& rig) {
  Touching touching(rig);
  rig.aim({0, Touching::kFloor - 0.01, 0});
  ASSERT_TRUE(touching.until([&](const auto& report) { return report.force.y() > 0.5 && rig.held() > 0.2; }));
  EXPECT_TRUE(holds_soon([&] { return rig.held() == 0.0; })) << "the motors keep " << rig.held() << " N";
}

/// Readings that make no sense give no force above the limits, and the device is usable after them.
inline void stands_faults(Rig& rig) {
  Touching touching(rig);
  rig.aim({0, Touching::kFloor - 0.005, 0});
  ASSERT_TRUE(touching.until([](const auto& report) { return report.force.y() > 0.3; }));
  using fakes::ArmFault;
  for (const ArmFault fault : {ArmFault::NotANumber, ArmFault::Infinite, ArmFault::Jump, ArmFault::Frozen}) {
    rig.fail(fault);
    touching.ticks(repeats(200));
    rig.fail(ArmFault::None);
    EXPECT_TRUE(touching.until([](const auto& report) { return report.status == DeviceStatus::Ok; }));
  }
  EXPECT_LE(rig.strongest(), rig.device->info().max_force * (1.0 + 1e-6));
  EXPECT_TRUE(touching.until([](const auto& report) { return report.contact.touching; }));
}

}  // namespace icome::devices::suite
