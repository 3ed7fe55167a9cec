#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "base/vector.h"
#include "devices/pointer_device.h"

namespace icome::haptics {

using base::Vector3;

/// Settings of the limiter for the safety of device and hand.
struct LimiterSettings {
  double ramp_seconds = 0.5;      // s from no force to full force, usually 0.1 to 1; 0: at once
  double max_rate = 0.0;          // N/s, usually 1000 to 20000; 0: full force within 2 ms
  double thermal_seconds = 20.0;  // s, time constant of the motors' heating, usually 10 to 60
  int stall_ticks = 10;           // ticks without fresh data that count as a stall, >= 1
  double longest_step = 0.01;     // s, a longer tick ramps and moves no further than this one
};

/// Input of the limiter in one tick beside the wanted force.
struct LimiterInput {
  bool source_fresh = true;     // did this tick see new data (position read, force computed)?
  bool device_ok = true;        // is the device there (no read or write said Lost)?
  bool started_inside = false;  // did the tip start inside an object (or one appear around it)?
};

/// Actions of the limiter. Several can occur in one tick.
enum class LimiterAct : std::uint8_t {
  NotFinite,    // wanted force or time step was not a finite number: zero force
  Stalled,      // no fresh data for stall_ticks: zero force
  DeviceLost,   // zero force
  RampedIn,     // force was scaled down while ramping in
  Clamped,      // above the device's maximum
  Continuous,   // above what the motors can sustain now
  RateLimited,  // changed too fast
};
constexpr std::size_t kLimiterActs = 7;

/// The last function before the device write (design.md, rule 16): whatever it is given, the returned force
/// - is finite and never longer than the device's max_force,
/// - never heats the motors beyond their rating: with h the exponentially weighted mean of |force|^2
///   (time constant thermal_seconds, starting at 0), h <= continuous_force^2 at every tick. Peak force is
///   free until h reaches half of that, then the limit falls smoothly towards the continuous force,
/// - changes by at most max_rate * dt a tick (dt at most longest_step) except to zero after a fault; a
///   max_rate below (max_force/continuous_force)^2 max_force/thermal_seconds yields to the motors' rating,
/// - is zero on a non-finite value, a stalled source or a lost device, and afterwards, as when the tip
///   starts inside an object, grows from zero over ramp_seconds,
/// - keeps the wanted direction wherever only its length is limited.
/// Owns nothing else; one thread calls it.
class ForceLimiter {
 public:
  /// Limits come from `device`; ones that make no sense (negative, not finite) count as 0: no force.
  explicit ForceLimiter(const devices::DeviceInfo& device, const LimiterSettings& settings = {});

  /// The force (N) to write for the `wanted` one (N), `dt` seconds after the last call. Real-time safe.
  Vector3 limit(const Vector3& wanted, double dt, const LimiterInput& input = {});

  /// Did this act in the last call? Real-time safe.
  bool acted(LimiterAct act) const { return ((acts_ >> static_cast<unsigned>(act)) & 1U) != 0; }
  /// Calls in which this acted, since the start. Real-time safe.
  std::uint64_t count(LimiterAct act) const { return counts_[static_cast<std::size_t>(act)]; }
  /// Share of the motors' sustained capacity in use: 0 cold, 1 only continuous force is left.
  /// Real-time safe.
  double heat() const;
  /// The longest force (N) that may be written now. Real-time safe.
  double allowed_force() const;
  /// As after (re)connecting: the next forces ramp in. Heat is kept, motors do not forget. Real-time safe.
  void restart();

 private:
  bool faulty(const Vector3& wanted, double dt, const LimiterInput& input);
  void note(LimiterAct act);
  Vector3 ramped(const Vector3& force, double step);
  void warm(double force, double dt);

  double max_force_;         // N
  double continuous_force_;  // N
  double max_rate_;          // N/s
  LimiterSettings settings_;
  Vector3 last_ = Vector3::Zero();  // N, as returned last
  double mean_square_ = 0.0;        // N^2, h above
  double ramp_ = 1.0;               // 0 to 1
  int stale_ticks_ = 0;
  bool was_inside_ = false;
  unsigned acts_ = 0;  // one bit an act
  std::array<std::uint64_t, kLimiterActs> counts_{};
};

}  // namespace icome::haptics
