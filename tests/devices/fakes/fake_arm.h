#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <limits>

#include "base/vector.h"

namespace icome::devices::fakes {

/// A fake device's arm and the hand that holds it, in SI units and the device's own axes.
struct ArmSettings {
  double mass = 0.15;             // kg, arm and hand
  double friction = 0.5;          // N s/m, of the arm's bearings
  double hand_stiffness = 300.0;  // N/m, pulls towards the place that the hand aims for
  double hand_damping = 5.0;      // N s/m
  double force_latency = 0.0;     // s from a command to the motors
  double quantum = 0.0;           // m, of the encoders; 0: exact
};

/// Faults of a reading.
enum class ArmFault : std::uint8_t {
  None,
  NotANumber,
  Infinite,
  Jump,  // to and fro, from one reading to the next
  Frozen,
  Displaced,  // all readings are half a metre away
};

/// Marks of the forces that a device was told, one after the other, since begin(). Not thread-safe.
class ForceTrace {
 public:
  struct Marks {
    double weakest = std::numeric_limits<double>::infinity();  // N
    double steepest = 0.0;                                     // N, greatest growth from one to the next
    int falls = 0;                                             // from more than 0.5 N to none at once
    std::int64_t longest_gap = 0;                              // ns, from one to the next
  };

  void begin() { marks_ = {}; }
  const Marks& marks() const { return marks_; }
  /// A force of so many N was told now, ns.
  void add(double force, std::int64_t now) {
    marks_.weakest = std::min(marks_.weakest, force);
    marks_.steepest = std::max(marks_.steepest, force - last_);
    if (last_ > 0.5 && force == 0.0) ++marks_.falls;
    if (last_time_ != 0) marks_.longest_gap = std::max(marks_.longest_gap, now - last_time_);
    last_ = force;
    last_time_ = now;
  }

 private:
  Marks marks_;
  double last_ = 0.0;           // N
  std::int64_t last_time_ = 0;  // ns, 0: none so far
};

/// The physical model behind the fakes: a mass with friction, held by a spring and a damper, pushed by the
/// forces that the program sends. It shares nothing with devices::SimulatedDevice, which it is there to stand
/// beside. Not thread-safe.
class FakeArm {
 public:
  struct Reading {
    base::Vector3 position = base::Vector3::Zero();  // m
    base::Vector3 velocity = base::Vector3::Zero();  // m/s
  };

  explicit FakeArm(const ArmSettings& settings = {}) : settings_(settings) {}

  /// The place that the hand aims for from now on, m.
  void aim(const base::Vector3& target) { target_ = target; }
  void fail(ArmFault fault) { fault_ = fault; }

  /// Commands a force (N) at a time (s), not before the last one's.
  void push(const base::Vector3& force, double time) {
    strongest_ =
        std::max(strongest_, force.allFinite() ? force.norm() : std::numeric_limits<double>::infinity());
    commands_.push_back({time + settings_.force_latency, force});
  }

  /// Lets time go on until `time`, s, and reads the arm.
  Reading read(double time) {
    while (now_ + kStep <= time) step();
    return with_fault();
  }

  /// The strongest force that was ever commanded, N; infinite for one that is not a number.
  double strongest() const { return strongest_; }
  /// The force that the motors hold, N.
  const base::Vector3& held() const { return held_; }
  /// Energy that the motors have given to the arm so far, J: the work of their force.
  double given() const { return given_; }

 private:
  static constexpr double kStep = 5e-5;  // s
  struct Command {
    double due = 0.0;  // s
    base::Vector3 force = base::Vector3::Zero();
  };

  void step() {
    while (!commands_.empty() && commands_.front().due <= now_) {
      held_ = commands_.front().force;
      commands_.pop_front();
    }
    const base::Vector3 hand =
        settings_.hand_stiffness * (target_ - position_) - settings_.hand_damping * velocity_;
    velocity_ += kStep / settings_.mass * (hand + held_ - settings_.friction * velocity_);
    given_ += kStep * held_.dot(velocity_);
    position_ += kStep * velocity_;
    now_ += kStep;
  }

  Reading with_fault() {
    Reading reading{quantised(position_), velocity_};
    switch (fault_) {
      case ArmFault::None:
        last_ = reading;
        break;
      case ArmFault::Frozen:
        reading = last_;
        break;
      case ArmFault::NotANumber:
        reading.position.x() = std::nan("");
        break;
      case ArmFault::Infinite:
        reading.velocity.y() = std::numeric_limits<double>::infinity();
        break;
      case ArmFault::Jump:
        reading.position.z() += jump_ = -jump_;
        break;
      case ArmFault::Displaced:
        reading.position.z() += 0.5;
        break;
    }
    return reading;
  }

  base::Vector3 quantised(const base::Vector3& place) const {
    if (settings_.quantum <= 0.0) return place;
    return settings_.quantum * (place / settings_.quantum).array().round().matrix();
  }

  ArmSettings settings_;
  base::Vector3 target_ = base::Vector3::Zero();
  base::Vector3 position_ = base::Vector3::Zero();
  base::Vector3 velocity_ = base::Vector3::Zero();
  base::Vector3 held_ = base::Vector3::Zero();
  std::deque<Command> commands_;
  Reading last_;
  ArmFault fault_ = ArmFault::None;
  double jump_ = 0.15;  // m
  double now_ = 0.0;    // s
  double strongest_ = 0.0;
  double given_ = 0.0;
};

}  // namespace icome::devices::fakes
