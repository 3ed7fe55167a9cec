#include "devices/driver/driver_link.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/clock.h"
#include "devices/device_news.h"

namespace icome::devices {
namespace {

constexpr double kFastest = 20.0;        // m/s, faster than any hand that holds a device
constexpr double kSlack = 0.005;         // m, error of a reading beside that
constexpr int kLastingReadings = 4;      // odd readings in a row that agree, and so are no spike
constexpr double kFarthest = 10.0;       // workspace radii from the origin
constexpr double kFarthestBeside = 1.0;  // m, beyond those
constexpr double kPushes = 0.2;          // N, above which a hand that is pushed moves a little

constexpr std::int64_t kTellSilence = 1'000'000'000;    // ns without a reading after which people are told
constexpr std::int64_t kCountRefusals = 1'000'000'000;  // ns
constexpr int kFewRefusals = 2 * kLastingReadings;      // in that time, as a jump that lasts makes some
constexpr int kRefusedShare = 20;                       // one in so many is worth telling
constexpr std::int64_t kTellRefusals = 5'000'000'000;   // ns
constexpr std::int64_t kTellReturn = 3'000'000'000;     // ns

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
  // A servo that did not look while the device was away finds the last reading of before.
  if (newest.connection != connection_.load(std::memory_order_acquire)) return DeviceStatus::Stalled;
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
  force_time_ = 0;
  stopped_ = true;
  given_.setZero();
  moved_time_ = window_begin_ = refused_until_ = 0;
  ++jumps_;
  troubles_.store(0, std::memory_order_relaxed);
  pushes_since_.store(0, std::memory_order_relaxed);
  {
    const std::lock_guard lock(condition_guard_);
    withheld_why_.clear();
    told_.clear();
  }
  connection_.fetch_add(1, std::memory_order_release);
  connected_.store(true, std::memory_order_release);
}

void DriverLink::disconnect(const std::string& why) {
  {
    const std::lock_guard lock(condition_guard_);
    lost_why_ = why;
  }
  // Only now, so that whoever sees that it is lost also finds why.
  connected_.store(false, std::memory_order_release);
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

/// Does a reading reach the servo?
bool DriverLink::is_taken(const PointerState& reading, std::int64_t now) {
  if (!makes_sense(reading)) return false;
  jump_told_ = jump_told_ || reading.jumped;
  if (!is_spike(reading, now)) return true;
  count(spikes_);
  return false;
}

void DriverLink::pass(const PointerState& reading, std::int64_t now) {
  const bool taken = is_taken(reading, now);
  watch_refusals(!taken, now);
  if (!taken) return;
  if (odd_readings_ > 0 || jump_told_) {
    odd_readings_ = 0;
    jump_told_ = false;
    ++jumps_;
    // The force that is asked for still belongs to the place before.
    ramp_ = 0.0;
  }
  watch_stillness(reading, given_, now);
  trouble(Trouble::Silent, false);
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
  next.connection = connection_.load(std::memory_order_relaxed);
  readings_.publish();
  count(passed_);
}

void DriverLink::leave_out(std::int64_t now) {
  count(left_out_);
  watch_refusals(true, now);
}

/// People are told once a good share of the readings is refused; one now and then is nothing to tell.
void DriverLink::watch_refusals(bool refused, std::int64_t now) {
  if (window_begin_ == 0 || now < window_begin_) window_begin_ = now;
  ++window_readings_;
  window_refused_ += refused ? 1 : 0;
  if (now - window_begin_ >= kCountRefusals) {
    if (window_refused_ > kFewRefusals && window_refused_ > window_readings_ / kRefusedShare)
      refused_until_ = now + kTellRefusals;
    window_begin_ = now;
    window_readings_ = window_refused_ = 0;
  }
  trouble(Trouble::Refuses, now < refused_until_);
}

/// Readings that stay the same while the device pushes are none: a hand always moves a little. Once they are
/// known to stand still the force waits for another one.
void DriverLink::watch_stillness(const PointerState& reading, const Vector3& given, std::int64_t now) {
  if (may_keep_still_) return;
  const bool same = last_time_ != 0 && reading.position == last_.position &&
                    reading.velocity == last_.velocity &&
                    reading.orientation.coeffs() == last_.orientation.coeffs();
  const bool in_a_row = last_time_ != 0 && now - last_time_ <= kSilence;
  const bool stood_still = (troubles_.load(std::memory_order_relaxed) & Trouble::Still) != 0;
  if (!same || (!stood_still && (!in_a_row || given.norm() < kPushes))) moved_time_ = now;
  trouble(Trouble::Still, now - moved_time_ > kFrozen || (stood_still && same));
}

/// Notes that a trouble lasts, or that it is over.
void DriverLink::trouble(Trouble which, bool lasts) {
  constexpr unsigned kTakesForce = Trouble::Withheld | Trouble::Silent | Trouble::Still;
  const unsigned before = lasts ? troubles_.fetch_or(which) : troubles_.fetch_and(~unsigned(which));
  if (!lasts && (before & which & kTakesForce) != 0 && ((before & ~unsigned(which)) & kTakesForce) == 0)
    pushes_since_.store(base::steady_nanoseconds(), std::memory_order_relaxed);
}

void DriverLink::withhold(const std::string& why) {
  {
    const std::lock_guard lock(condition_guard_);
    if (why == withheld_why_) return;
    withheld_why_ = why;
  }
  trouble(Trouble::Withheld, !why.empty());
}

bool DriverLink::may_push(std::int64_t now) {
  const std::int64_t silence = last_time_ == 0 ? 0 : now - last_time_;
  if (silence > kTellSilence) trouble(Trouble::Silent, true);
  const unsigned troubles = troubles_.load(std::memory_order_relaxed);
  return silence <= kSilence && (troubles & (Trouble::Withheld | Trouble::Still)) == 0;
}

void DriverLink::take_force_away() {
  if (!stopped_) count(watchdog_stops_);
  stopped_ = true;
  ramp_ = 0.0;
}

Vector3 DriverLink::force(std::int64_t now) {
  given_ = allowed_force(now);
  return given_;
}

Vector3 DriverLink::allowed_force(std::int64_t now) {
  asked_.update();
  const Asked& asked = asked_.read();
  const double seconds = force_time_ == 0 ? 0.0 : static_cast<double>(now - force_time_) * 1e-9;
  force_time_ = now;
  if (!may_push(now)) {
    stopped_ = true;
    ramp_ = 0.0;
    return Vector3::Zero();
  }
  if (asked.time == 0 || now - asked.time > kWatchdog) {
    take_force_away();
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
  told_ = condition;
}

LinkCounts DriverLink::counts() const {
  const auto value = [](const std::atomic<std::uint64_t>& counter) {
    return counter.load(std::memory_order_relaxed);
  };
  return {value(passed_), value(not_finite_), value(far_away_),
          value(spikes_), value(left_out_),   value(watchdog_stops_)};
}

std::string DriverLink::condition() const {
  const std::lock_guard lock(condition_guard_);
  if (!connected()) return lost_why_;
  const unsigned troubles = troubles_.load(std::memory_order_relaxed);
  const std::int64_t pushes_since = pushes_since_.load(std::memory_order_relaxed);
  std::string all;
  const auto add = [&all](const std::string& line) {
    if (!line.empty()) all += (all.empty() ? "" : "\n") + line;
  };
  const auto add_no_force = [&](const std::string& why) { add(std::string(kNoForce) + why); };
  if (!withheld_why_.empty()) add_no_force(withheld_why_);
  if ((troubles & Trouble::Silent) != 0)
    add_no_force(
        "it tells nothing new of its place; see that it is switched on and that nothing is in its way");
  if ((troubles & Trouble::Still) != 0)
    add_no_force(
        "what it tells of its place stays the same while it pushes; move it, or else unplug it and plug it "
        "in "
        "again");
  if ((troubles & (Trouble::Withheld | Trouble::Silent | Trouble::Still)) == 0 && pushes_since != 0 &&
      base::steady_nanoseconds() - pushes_since < kTellReturn)
    add("It gives forces again, which grow from none");
  if ((troubles & Trouble::Refuses) != 0)
    add(
        fmt::format("Some of its readings make no sense and are left out (times so far: {}); look at its "
                    "cable and what is "
                    "near it",
                    counts().refused()));
  add(told_);
  return all;
}

}  // namespace icome::devices
