#include "devices/driver/driver_link.h"

#include <algorithm>
#include <cmath>

namespace icome::devices {
namespace {

constexpr double kFastest = 20.0;        // m/s, faster than any hand that holds a device
constexpr double kSlack = 0.005;         // m, error of a reading beside that
constexpr int kLastingReadings = 4;      // odd readings in a row that agree, and so are no spike
constexpr double kFarthest = 10.0;       // workspace radii from the origin
constexpr double kFarthestBeside = 1.0;  // m, beyond those

void count(std::atomic<std::uint64_t>& counter) {
  counter.store(counter.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

/// Could a hand have come from one place to the other in that time, ns?
bool within_reach(const PointerState& from, const PointerState& to, std::int64_t time) {
  const double seconds = std::max(0.0, static_cast<double>(time) * 1e-9);
  return (to.position - from.position).norm() <= kFastest * seconds + kSlack;
}

}  // namespace

DriverLink::DriverLink(const DeviceInfo& info)
    : workspace_radius_(info.workspace_radius),
      max_force_(info.max_force),
      expected_max_force_(info.max_force) {}

DeviceStatus DriverLink::read(PointerState& state) {
  if (!connected()) return DeviceStatus::Lost;
  if (!readings_.update()) return DeviceStatus::Stalled;
  const Reading& newest = readings_.read();
  state = newest.state;
  // A jump counts although its own reading may have been replaced by newer ones.
  state.jumped = state.jumped || newest.jumps != jumps_seen_;
  jumps_seen_ = newest.jumps;
  return DeviceStatus::Ok;
}

DeviceStatus DriverLink::write(const Vector3& force, std::int64_t now) {
  asked_.publish({force, now});
  return connected() ? DeviceStatus::Ok : DeviceStatus::Lost;
}

void DriverLink::connect(const DeviceInfo& info) {
  max_force_ = std::min(expected_max_force_, info.max_force);
  last_time_ = 0;
  odd_readings_ = 0;
  jump_told_ = false;
  ramp_ = 0.0;
  stopped_ = true;
  ++jumps_;
  tell({});
  connected_.store(true, std::memory_order_release);
}

void DriverLink::disconnect(const std::string& why) {
  connected_.store(false, std::memory_order_release);
  tell(why);
}

bool DriverLink::makes_sense(const PointerState& reading) {
  if (!reading.position.allFinite() || !reading.velocity.allFinite() ||
      !reading.orientation.coeffs().allFinite() || !std::isfinite(reading.grip)) {
    count(not_finite_);
    return false;
  }
  if (reading.position.norm() > kFarthest * workspace_radius_ + kFarthestBeside) {
    count(far_away_);
    return false;
  }
  return true;
}

/// True for a reading that no hand could have come to, until some in a row agree that the tip is there.
bool DriverLink::is_spike(const PointerState& reading, std::int64_t now) {
  if (last_time_ == 0 || within_reach(last_, reading, now - last_time_)) {
    odd_readings_ = 0;
    return false;
  }
  const bool agrees = odd_readings_ > 0 && within_reach(odd_, reading, now - odd_time_);
  odd_readings_ = agrees ? odd_readings_ + 1 : 1;
  odd_ = reading;
  odd_time_ = now;
  return odd_readings_ < kLastingReadings;
}

void DriverLink::pass(const PointerState& reading, std::int64_t now) {
  if (!makes_sense(reading)) return;
  jump_told_ = jump_told_ || reading.jumped;
  if (is_spike(reading, now)) return count(spikes_);
  if (odd_readings_ > 0 || jump_told_) {
    odd_readings_ = 0;
    jump_told_ = false;
    ++jumps_;
    ramp_ = 0.0;  // a hand that is somewhere else is not met by the full force there
  }
  last_ = reading;
  last_time_ = now;
  Reading& next = readings_.write_slot();
  next.state = reading;
  // The servo's orientation is a rotation, also where a device rounds it to few digits.
  const double length = reading.orientation.norm();
  next.state.orientation =
      length > 1e-6 && length < 1e6 ? reading.orientation.normalized() : Quaternion::Identity();
  // A driver's velocity above that of any hand would make damping a blow.
  const double speed = reading.velocity.norm();
  if (speed > kFastest) next.state.velocity *= kFastest / speed;
  next.jumps = jumps_;
  readings_.publish();
  count(passed_);
}

Vector3 DriverLink::force(std::int64_t now) {
  asked_.update();
  const Asked& asked = asked_.read();
  const double seconds = static_cast<double>(now - force_time_) * 1e-9;
  force_time_ = now;
  if (asked.time == 0 || now - asked.time > kWatchdog) {
    if (!stopped_) count(watchdog_stops_);
    stopped_ = true;
    ramp_ = 0.0;
    return Vector3::Zero();
  }
  stopped_ = false;
  if (!asked.force.allFinite()) return Vector3::Zero();
  // The ramp's step is as long as the watchdog's time at most, as a longer pause is no part of a ramp.
  ramp_ = std::min(1.0, ramp_ + std::clamp(seconds, 0.0, 1e-9 * kWatchdog) / kRamp);
  const Vector3 force = ramp_ * asked.force;
  const double length = force.norm();
  return length > max_force_ ? Vector3(force * (max_force_ / length)) : force;
}

void DriverLink::tell(const std::string& condition) {
  const std::lock_guard lock(condition_guard_);
  condition_ = condition;
}

LinkCounts DriverLink::counts() const {
  const auto value = [](const std::atomic<std::uint64_t>& counter) {
    return counter.load(std::memory_order_relaxed);
  };
  return {value(passed_), value(not_finite_), value(far_away_), value(spikes_), value(watchdog_stops_)};
}

std::string DriverLink::condition() const {
  const std::lock_guard lock(condition_guard_);
  return condition_;
}

}  // namespace icome::devices
