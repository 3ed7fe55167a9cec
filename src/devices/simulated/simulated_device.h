#pragma once
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>

#include "devices/pointer_device.h"
#include "realtime/latest_value.h"

namespace icome::devices {

/// A hand that holds the pointer: its mass rides on the tip, and a spring with a damper pulls it to the
/// place that the person aims for. Ranges as Hajian and Howe (1997) and Kuchenbecker et al. (2003) measured
/// on fingers and wrists; the mass of a pen grip is a choice within theirs.
struct SimulatedHand {
  double mass = 0.05;        // kg, usually 0.005 to 0.2
  double stiffness = 300.0;  // N/m, usually 100 (relaxed) to 800 (tense)
  double damping = 5.0;      // N s/m, usually 2 to 20
};

struct SimulatedSettings {
  DeviceInfo info = {.name = "simulated"};  // limits and mass of the device; a profile's, for example
  SimulatedHand hand;
  double rate = 1000.0;             // Hz, ticks a second: each read() advances 1/rate
  int substeps = 8;                 // per tick, usually 1 to 20: times that the target is followed
  double encoder_resolution = 0.0;  // m, usually 2e-5 to 6e-5; 0: exact position and velocity
  Vector3 start = Vector3::Zero();  // m, where the tip rests at first
  /// Position (m) that the hand aims for at a time (s): called by read(), so it must be real-time safe.
  /// May be null: then set_target() gives it.
  std::function<Vector3(double)> trajectory;
};

/// Failures of a real device that can be simulated.
enum class SimulatedFailure : std::uint8_t {
  None,
  Unplugged,   // read and write return Lost, the motors are dead
  Stalled,     // read returns Stalled, the motors hold the last force
  NotANumber,  // read returns Ok and a position that is not a number
};

/// A device and a hand in software, so that the loop is closed and physical without hardware: the tip
/// (device plus hand mass) moves under the force written last, held over the tick, and the hand's
/// spring-damper. The motion within a sub-step is exact, not approximated. No wall clock: time advances
/// by 1/rate with each read(), and the same calls give the same bits.
class SimulatedDevice final : public PointerDevice {
 public:
  /// Masses, rate and sub-steps must be positive.
  explicit SimulatedDevice(SimulatedSettings settings = {});

  const DeviceInfo& info() const override { return settings_.info; }
  const SimulatedHand& hand() const { return settings_.hand; }
  /// Advances one tick, then reads; a velocity is the exact one, or with an encoder the backward
  /// difference of its readings. Real-time safe.
  DeviceStatus read(PointerState& state) override;
  /// Sets the force (N) that the motors hold until the next write; one that is not finite is taken as none,
  /// so that it does no more harm here than to a real amplifier. Real-time safe.
  DeviceStatus write(const Vector3& force) override;

  /// Sets the position that the hand aims for from the next tick on, m. One other thread may call this.
  /// Real-time safe.
  void set_target(const Vector3& position) { target_.publish(position); }
  /// Puts the tip there at rest, m, without a path in between, as a pen is lifted and set down elsewhere. The
  /// hand keeps its target. One other thread, that of set_target(), may call this.
  /// Real-time safe.
  void put(const Vector3& position) { put_.publish({position, false}); }
  /// Lays the tip aside there, where it touches nothing until put() is called. Same thread as put().
  /// Real-time safe.
  void park(const Vector3& position) { put_.publish({position, true}); }
  /// Sets the stylus's orientation from the next tick on. Same thread as set_target(). Real-time safe.
  void turn(const Quaternion& device_from_stylus) { turned_.publish(device_from_stylus); }
  /// Holds these buttons down (bit i: button i) from the next tick on. Any thread. Real-time safe.
  void hold_buttons(std::uint32_t buttons) { buttons_.store(buttons, std::memory_order_relaxed); }
  /// Makes the device fail from the next tick on, or work again. Any thread. Real-time safe.
  void inject(SimulatedFailure failure) { failure_.store(failure, std::memory_order_relaxed); }

  /// Seconds simulated so far. Real-time safe.
  double time() const { return static_cast<double>(ticks_) / settings_.rate; }
  /// The true position (m) and velocity (m/s) of the tip, whatever the encoder says. Real-time safe.
  const Vector3& true_position() const { return position_; }
  const Vector3& true_velocity() const { return velocity_; }

 private:
  void advance();
  struct Put {
    Vector3 position = Vector3::Zero();  // m
    bool parked = false;
  };
  void set_down(const Put& put);
  Vector3 target_at(double time) const;

  SimulatedSettings settings_;
  double substep_;  // s
  // [position; velocity] after a sub-step = these times [position; velocity; push/mass].
  std::array<std::array<double, 3>, 2> step_{};
  realtime::LatestValue<Vector3> target_;
  realtime::LatestValue<Put> put_;
  realtime::LatestValue<Quaternion> turned_;
  bool jumped_ = false;  // since the last reading that was Ok
  bool parked_ = false;
  std::atomic<std::uint32_t> buttons_ = 0;
  std::atomic<SimulatedFailure> failure_ = SimulatedFailure::None;
  Vector3 position_;                    // m
  Vector3 velocity_ = Vector3::Zero();  // m/s
  Vector3 force_ = Vector3::Zero();     // N, held by the motors
  Vector3 encoder_;                     // m, last reading
  std::int64_t ticks_ = 0;
};

}  // namespace icome::devices
