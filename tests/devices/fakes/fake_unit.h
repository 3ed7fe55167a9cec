#pragma once
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <random>
#include <string>
#include <thread>

#include "base/clock.h"
#include "base/vector.h"
#include "devices/fakes/fake_arm.h"

namespace icome::devices::fakes {

/// Faults of a fake library's device, beside the faults of a reading (ArmFault).
enum class UnitFault : std::uint8_t {
  None,
  Hostile,    // every reading has one fault or another, at random, now and then a gap of 100 ms
  Saturated,  // warning: motors at their limit
  TimeGuard,  // warning: asked for too soon
  Hot,        // warning: warm motors
  TooStrong,  // warning: more than the greatest force
  Broken,     // fault of the device
  Unknown,    // an error of no known kind
};

struct UnitSettings {
  ArmSettings arm = {};
  double transfer = 0.0;        // s that a reading takes on its way
  double dropouts = 0.0;        // share of readings that never come: the last one again
  double counted_period = 0.0;  // s that pass from reading to reading; 0: the clock's time
  double circle = 0.0;          // m, radius of the circle on which the hand moves, once a second
};

/// One device of a fake library: an arm in the device's own axes, which a test steers. Any thread.
class FakeUnit {
 public:
  struct Sample {
    base::Vector3 position = base::Vector3::Zero();      // m
    base::Vector3 velocity = base::Vector3::Zero();      // m/s
    base::Matrix3 rotation = base::Matrix3::Identity();  // device_from_stylus
  };

  // The test's.
  void set_up(const UnitSettings& settings) {
    const std::lock_guard lock(guard_);
    settings_ = settings;
    arm_ = FakeArm(settings.arm);
    begin_ = base::steady_nanoseconds();
    counted_ = 0;
    pose_ = last_ = frozen_ = read_ = Sample();
    is_posed_ = false;
    is_plugged_ = true;
    fault_ = UnitFault::None;
    buttons_ = 0;
    grip_degrees_ = 0.0;
    strongest_posed_ = 0.0;
    held_ = base::Vector3::Zero();
    held_since_ = begin_;
    pushes_ = 0;
  }
  /// Holds it at a place, whatever the forces; then nothing here takes memory.
  void pose(const Sample& pose) {
    const std::lock_guard lock(guard_);
    pose_ = pose;
    is_posed_ = true;
  }
  void aim(const base::Vector3& target) {
    const std::lock_guard lock(guard_);
    arm_.aim(target);
  }
  void press(unsigned buttons) {
    const std::lock_guard lock(guard_);
    buttons_ = buttons;
  }
  void squeeze(double degrees) {
    const std::lock_guard lock(guard_);
    grip_degrees_ = degrees;
  }
  void plug(bool in) {
    const std::lock_guard lock(guard_);
    is_plugged_ = in;
    if (!in) drop_force();
  }
  void fail(ArmFault fault) {
    const std::lock_guard lock(guard_);
    arm_.fail(fault);
  }
  void fail(UnitFault fault) {
    const std::lock_guard lock(guard_);
    fault_ = fault;
  }
  /// The strongest force that it was ever told to give, N; infinite for one that is not a number.
  double strongest() const {
    const std::lock_guard lock(guard_);
    return std::max(strongest_posed_, arm_.strongest());
  }
  /// The force that it was told last, N, own axes.
  base::Vector3 held() const {
    const std::lock_guard lock(guard_);
    return held_;
  }
  /// Time of the last change of the force that it was told, ns.
  std::int64_t held_since() const {
    const std::lock_guard lock(guard_);
    return held_since_;
  }
  /// Number of times that it was told a force.
  std::uint64_t pushes() const {
    const std::lock_guard lock(guard_);
    return pushes_;
  }
  /// Marks of the forces that it was told since watch().
  void watch() {
    const std::lock_guard lock(guard_);
    trace_.begin();
  }
  ForceTrace::Marks marks() const {
    const std::lock_guard lock(guard_);
    return trace_.marks();
  }
  /// Energy that its motors gave so far, J.
  double given() const {
    const std::lock_guard lock(guard_);
    return arm_.given();
  }

  // The library's.
  bool is_plugged() const {
    const std::lock_guard lock(guard_);
    return is_plugged_;
  }
  UnitFault fault() const {
    const std::lock_guard lock(guard_);
    return fault_;
  }
  unsigned buttons() const {
    const std::lock_guard lock(guard_);
    return buttons_;
  }
  double grip_degrees() const {
    const std::lock_guard lock(guard_);
    return grip_degrees_;
  }
  /// The velocity of the last reading, m/s.
  base::Vector3 last_velocity() const {
    const std::lock_guard lock(guard_);
    return read_.velocity;
  }
  Sample read() {
    double wait = 0.0;
    const Sample sample = [&] {
      const std::lock_guard lock(guard_);
      wait = settings_.transfer;
      return read_ = take(wait);
    }();
    if (wait > 0.0) std::this_thread::sleep_for(std::chrono::duration<double>(wait));
    return sample;
  }
  void push(const base::Vector3& force) {
    const std::lock_guard lock(guard_);
    ++pushes_;
    trace_.add(force.norm(), base::steady_nanoseconds());
    if (force != held_) held_since_ = base::steady_nanoseconds();
    held_ = force;
    if (is_posed_)
      strongest_posed_ = std::max(strongest_posed_,
                                  force.allFinite() ? force.norm() : std::numeric_limits<double>::infinity());
    else
      arm_.push(force, time());
  }

 private:
  double time() const {
    if (settings_.counted_period > 0.0) return settings_.counted_period * double(counted_);
    return 1e-9 * double(base::steady_nanoseconds() - begin_);
  }

  /// Without power motors give nothing.
  void drop_force() {
    held_ = base::Vector3::Zero();
    held_since_ = base::steady_nanoseconds();
    if (!is_posed_) arm_.push(held_, time());
  }

  Sample take(double& wait) {
    ++counted_;
    if (is_posed_) {
      Sample pose = pose_;
      pose.position.x() += counted_ % 2 == 0 ? 1e-15 : 0.0;  // no hand is quite still
      return pose;
    }
    if (settings_.dropouts > 0.0 && share() < settings_.dropouts) return last_;
    const double now = time();
    if (settings_.circle > 0.0) {
      const double angle = 2.0 * M_PI * now;
      arm_.aim(settings_.circle * base::Vector3(std::cos(angle), std::sin(angle), 0.0));
    }
    const FakeArm::Reading reading = arm_.read(now);
    last_ = {reading.position, reading.velocity, base::Matrix3::Identity()};
    return fault_ == UnitFault::Hostile ? hostile(wait) : last_;
  }

  /// A reading with a fault, after the last one.
  Sample hostile(double& wait) {
    constexpr std::uint64_t kGapEvery = 200'000;  // readings
    if (counted_ % kGapEvery == 0) wait += 0.1;
    Sample sample = last_;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    switch (random_() % 12) {
      case 0:
        sample.position[random_() % 3] = nan;
        break;
      case 1:
        sample.velocity[random_() % 3] = nan;
        break;
      case 2:
        sample.position[random_() % 3] = std::numeric_limits<double>::infinity();
        break;
      case 3:
        sample.velocity[random_() % 3] = -std::numeric_limits<double>::infinity();
        break;
      case 4:
        sample.rotation.setConstant(nan);
        break;
      case 5:
        sample.rotation.setZero();
        break;
      case 6:
        sample.position += base::Vector3::Constant(share() - 0.5);
        break;
      case 7:
        sample.position *= std::pow(10.0, 300.0 * share());
        break;
      case 8:
        sample.velocity = base::Vector3::Constant(1e6 * (share() - 0.5));
        break;
      case 9:
        sample = frozen_;
        break;
      default:  // no fault
        break;
    }
    if (random_() % 1000 == 0) frozen_ = last_;
    return sample;
  }

  double share() { return std::uniform_real_distribution<double>()(random_); }

  mutable std::mutex guard_;
  UnitSettings settings_;
  FakeArm arm_;
  std::int64_t begin_ = base::steady_nanoseconds();
  std::uint64_t counted_ = 0;  // readings
  Sample pose_;
  Sample last_;    // without a fault
  Sample frozen_;  // the reading that it stands still at
  Sample read_;    // given last
  bool is_posed_ = false;
  bool is_plugged_ = true;
  UnitFault fault_ = UnitFault::None;
  unsigned buttons_ = 0;
  double grip_degrees_ = 0.0;
  double strongest_posed_ = 0.0;  // N
  base::Vector3 held_ = base::Vector3::Zero();
  std::int64_t held_since_ = base::steady_nanoseconds();
  std::uint64_t pushes_ = 0;
  ForceTrace trace_;
  std::mt19937 random_{20};
};

/// Settings and faults from the environment, for programs that load a fake library: PREFIX_LATENCY_US,
/// PREFIX_QUANTUM_UM, PREFIX_TRANSFER_US, PREFIX_DROPOUTS (share), PREFIX_CIRCLE_MM, PREFIX_FAULT
/// (not-a-number, infinite, jump, frozen, displaced, hostile, saturated, time-guard, hot, too-strong, broken,
/// unknown).
class FakeEnvironment {
 public:
  explicit FakeEnvironment(std::string prefix) : prefix_(std::move(prefix)) {}

  std::string text(const std::string& name, const std::string& otherwise) const {
    const char* value = std::getenv((prefix_ + name).c_str());
    return value != nullptr ? value : otherwise;
  }
  double number(const std::string& name, double otherwise) const {
    const std::string value = text(name, "");
    return value.empty() ? otherwise : std::strtod(value.c_str(), nullptr);
  }

  void set_up(FakeUnit& unit) const {
    UnitSettings settings;
    settings.arm.force_latency = 1e-6 * number("_LATENCY_US", 0.0);
    settings.arm.quantum = 1e-6 * number("_QUANTUM_UM", 0.0);
    settings.transfer = 1e-6 * number("_TRANSFER_US", 0.0);
    settings.dropouts = number("_DROPOUTS", 0.0);
    settings.circle = 1e-3 * number("_CIRCLE_MM", 0.0);
    unit.set_up(settings);
    const std::string fault = text("_FAULT", "");
    constexpr const char* kArmFaults[] = {"", "not-a-number", "infinite", "jump", "frozen", "displaced"};
    for (int i = 1; i < 6; ++i) {
      if (fault == kArmFaults[i]) unit.fail(ArmFault(i));
    }
    constexpr const char* kUnitFaults[] = {"",    "hostile",    "saturated", "time-guard",
                                           "hot", "too-strong", "broken",    "unknown"};
    for (int i = 1; i < 8; ++i) {
      if (fault == kUnitFaults[i]) unit.fail(UnitFault(i));
    }
  }

 private:
  std::string prefix_;
};

}  // namespace icome::devices::fakes
