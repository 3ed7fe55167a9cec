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
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/clock.h"
#include "devices/driver/driven_device.h"
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
  // Marks of the forces that the motors were told since watch(). Both may be empty.
  std::function<void()> watch;
  std::function<fakes::ForceTrace::Marks()> marks;

  /// Times that the watchdog took the forces away.
  std::uint64_t watchdog_stops() const {
    const auto* driven = dynamic_cast<const DrivenDevice*>(device.get());
    return driven != nullptr ? driven->counts().watchdog_stops : 0;
  }
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

  explicit Touching(Rig& rig) : servo_(*rig.device, settings()) { servo_.publish(floor()); }

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
    longest_ = std::max(longest_, last_ == 0 ? 0 : now - last_);
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
  /// The longest time from one tick to the next since the last call, ns.
  std::int64_t take_longest() { return std::exchange(longest_, 0); }

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
  haptics::Servo servo_;
  std::int64_t last_ = 0;     // ns, of the last tick; 0 before the first
  std::int64_t longest_ = 0;  // ns
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

/// The work, J, of the motors while a hand goes into the floor and out again; nothing where the machine stood
/// still meanwhile: then motors hold an old force, or the watchdog takes it away and with it the energy that
/// the spring holds.
inline std::optional<double> work_of_a_press(Rig& rig, Touching& touching) {
  constexpr std::int64_t kStandsStill = 4'000'000;  // ns
  rig.aim({0, 0, 0});
  EXPECT_TRUE(touching.until([](const auto& report) { return report.tip.y() > 0.3 * Touching::kFloor; }));
  touching.ticks(100);
  const double before = rig.given();
  const std::uint64_t stops = rig.watchdog_stops();
  if (rig.watch) rig.watch();
  touching.take_longest();
  rig.aim({0, Touching::kFloor - 0.008, 0});
  EXPECT_TRUE(touching.until([](const auto& report) { return report.force.y() > 0.5; }));
  touching.ticks(100);
  rig.aim({0, 0, 0});
  EXPECT_TRUE(touching.until([](const auto& report) { return report.tip.y() > 0.5 * Touching::kFloor; }));
  const double work = rig.given() - before;
  const auto marks = rig.marks ? rig.marks() : fakes::ForceTrace::Marks();
  const bool counts = rig.watchdog_stops() == stops && touching.take_longest() < kStandsStill &&
                      marks.falls == 0 && marks.longest_gap < kStandsStill;
  return counts ? std::optional<double>(work) : std::nullopt;
}

/// The median work, J, of the motors in five presses; nothing where the machine stands still in most.
inline std::optional<double> median_work(Rig& rig) {
  constexpr std::size_t kPresses = 5;
  Touching touching(rig);
  EXPECT_TRUE(touching.until([](const auto& report) { return report.status == DeviceStatus::Ok; }));
  std::vector<double> works;
  for (int press = 0; press < 60 && works.size() < kPresses && !testing::Test::HasFailure(); ++press) {
    if (const auto work = work_of_a_press(rig, touching)) works.push_back(*work);
  }
  if (works.size() < kPresses) return std::nullopt;
  std::sort(works.begin(), works.end());
  return works[kPresses / 2];
}

constexpr double kPassiveWork = 5e-4;  // J, of 5 mJ that the floor's spring holds

/// While a hand goes into the floor and out again the motors give no more work than they take: a virtual
/// floor has no energy of its own.
inline void is_passive(Rig& rig) {
  const auto work = median_work(rig);
  if (testing::Test::HasFailure()) return;
  if (!work) GTEST_SKIP() << "the machine stands still in nearly each press";
  EXPECT_LE(*work, kPassiveWork) << "J, more than the hand put in";
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

/// A tip that is somewhere else all at once, and stays there, is not met by the force that was asked for
/// before: it begins at none and grows with the ramp, whoever asks for it.
inline void ramps_after_a_jump(Rig& rig, fakes::ArmFault to) {
  constexpr double kForce = 1.0;  // N
  constexpr double kStep =
      kForce * 1e-9 * DriverLink::kWatchdog / DriverLink::kRamp;  // N, the ramp's longest
  bool jumped = false;
  const auto holds = [&] {
    PointerState state;
    if (rig.device->read(state) == DeviceStatus::Ok) jumped = jumped || state.jumped;
    rig.device->write({kForce, 0, 0});
    return rig.held() > 0.99 * kForce;
  };
  // Where the machine stands still the watchdog takes forces away too, and after a pause of the readings a
  // hand could have come as far, so that the link sees no jump: then it is tried again.
  bool goes_on = false;
  for (int tries = 0; tries < 20; ++tries) {
    ASSERT_TRUE(holds_soon(holds));
    const std::uint64_t stops = rig.watchdog_stops();
    rig.watch();
    jumped = false;
    rig.fail(to);
    const auto end = base::steady_nanoseconds() + 500'000'000;
    ASSERT_TRUE(holds_soon([&] { return holds() && base::steady_nanoseconds() > end; }));
    const bool judged = jumped && rig.watchdog_stops() == stops;
    if (!judged || rig.marks().weakest >= 2.0 * kStep) {
      goes_on = goes_on || judged;
      rig.fail(fakes::ArmFault::None);
      continue;
    }
    EXPECT_LT(rig.marks().steepest, 1.01 * kStep) << "a blow instead of a ramp";
    return;
  }
  EXPECT_FALSE(goes_on) << "the force goes on";
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
  EXPECT_TRUE(touching.until([](const auto& report) { return report.contact.touching; }));
  rig.aim({0, 0, 0});
  if (rig.marks) ramps_after_a_jump(rig, ArmFault::Displaced);
  rig.fail(ArmFault::None);
  EXPECT_LE(rig.strongest(), rig.device->info().max_force * (1.0 + 1e-6));
}

}  // namespace icome::devices::suite
