#pragma once
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "devices/pointer_device.h"
#include "realtime/latest_value.h"

namespace icome::devices {

/// Counts since a link's beginning: readings passed to the servo or kept from it, and forces taken away.
struct LinkCounts {
  std::uint64_t passed = 0;          // readings that the servo could have
  std::uint64_t not_finite = 0;      // readings with something that is not a number
  std::uint64_t far_away = 0;        // readings far outside the workspace
  std::uint64_t spikes = 0;          // readings that no hand could have come to, and that did not last
  std::uint64_t left_out = 0;        // readings that the driver refused itself
  std::uint64_t watchdog_stops = 0;  // times that the servo said nothing new and the forces were taken away
  std::uint64_t refused() const { return not_finite + far_away + spikes + left_out; }
};

/// The exchange between a servo and the thread that talks to a device (a driver); neither ever waits for the
/// other. It guards the hand whatever either does: readings that make no sense never reach the servo, and no
/// force that is too old, too strong or not a number reaches the device. Nor does any while the device may
/// not push: while the driver withholds forces, without new readings, or where readings stay the same while
/// it pushes. Whatever took the force away, it grows from none again. One thread calls the servo's part and
/// one the driver's; between two runs the driver's may be another one.
class DriverLink {
 public:
  /// Age at which a force is taken away: the servo's thread stands still.
  static constexpr std::int64_t kWatchdog = 10'000'000;  // ns
  /// Time in which forces grow from none to the ones asked for, at the start and after they were taken away.
  static constexpr double kRamp = 0.3;  // s
  /// Age of the newest reading at which forces are taken away, as nobody knows where the hand is.
  static constexpr std::int64_t kSilence = 100'000'000;  // ns
  /// Time in which a hand that is pushed moves a little, whatever it is pushed against: tremor is some tenths
  /// of a millimetre, but coarse encoders (60 um of a Falcon) may hide it for a moment.
  static constexpr std::int64_t kFrozen = 3'000'000'000;  // ns

  explicit DriverLink(const DeviceInfo& info);

  // The servo. Times are of base::steady_nanoseconds; real-time safe.
  /// Ok with the newest reading, Stalled without a new one, Lost while no device is connected.
  DeviceStatus read(PointerState& state);
  /// Holds the force (N, device frame) until the next one, or until it is too old.
  DeviceStatus write(const Vector3& force, std::int64_t now);

  // The driver.
  /// Connects a device: its limits count where they are lower, and forces begin at none. Readings of the
  /// connection before are no longer read.
  void connect(const DeviceInfo& info);
  /// Takes the device away: the servo reads Lost, and people are told why.
  void disconnect(const std::string& why);
  /// Passes a reading on, or refuses it (see LinkCounts). `now`: the time at which it was taken. A reading at
  /// another place than a hand can have moved to is refused while it may be a spike; if it lasts, it counts
  /// as jumped, and forces grow from none again. The velocity is the device's own. Real-time safe.
  void pass(const PointerState& reading, std::int64_t now);
  /// Counts a reading that came and that the driver refused itself. Real-time safe.
  void leave_out(std::int64_t now);
  /// The force to send now, N, device frame. Real-time safe.
  Vector3 force(std::int64_t now);
  /// Takes the force away, as the watchdog does. Real-time safe.
  void take_force_away();
  /// Says that a hand that is pushed may keep the device still for as long as it likes, as a thumb does a
  /// gamepad's stick. Before readings.
  void may_keep_still() { may_keep_still_ = true; }
  /// Says why the device may not push now, such as "it has no power; plug in its power supply"; empty: it
  /// may. Takes a lock. Any thread of the driver's.
  void withhold(const std::string& why);
  /// Sets the sentences about the device that people should know now, one a line; empty: none. Takes a lock.
  /// Any thread of the driver's.
  void tell(const std::string& condition);

  // Any thread.
  bool connected() const { return connected_.load(std::memory_order_acquire); }
  LinkCounts counts() const;
  /// What people should know now, one sentence a line: why the device is lost, or else why it may not push,
  /// what of its readings makes no sense, and what the driver tells.
  std::string condition() const;

 private:
  struct Reading {
    PointerState state;
    std::uint64_t jumps = 0;       // so far
    std::uint64_t connection = 0;  // the number of the connection that it is of
  };
  struct Asked {
    Vector3 force = Vector3::Zero();  // N
    std::int64_t time = 0;            // ns, 0: none was asked for yet
  };
  /// Reasons of the link itself for which the device may not push, and for which readings are told of.
  enum Trouble : unsigned { Withheld = 1, Silent = 2, Still = 4, Refuses = 8 };
  bool makes_sense(const PointerState& reading);
  bool is_spike(const PointerState& reading, std::int64_t now);
  bool is_taken(const PointerState& reading, std::int64_t now);
  void watch_refusals(bool refused, std::int64_t now);
  void watch_stillness(const PointerState& reading, const Vector3& given, std::int64_t now);
  void trouble(Trouble which, bool lasts);
  bool may_push(std::int64_t now);
  Vector3 allowed_force(std::int64_t now);

  double workspace_radius_;  // m
  double max_force_;         // N, the lower of the expected and the connected device's
  double expected_max_force_;
  realtime::LatestValue<Reading> readings_;
  realtime::LatestValue<Asked> asked_;
  std::atomic<bool> connected_ = false;
  std::atomic<std::uint64_t> connection_ = 0;  // the number of the newest connection

  std::uint64_t jumps_seen_ = 0;  // the servo's

  // The driver's.
  PointerState last_;
  std::int64_t last_time_ = 0;  // ns, 0: nothing has been passed since it was connected
  PointerState odd_;            // the last reading that may be a spike
  std::int64_t odd_time_ = 0;   // ns
  int odd_readings_ = 0;        // in a row, that agree
  bool jump_told_ = false;      // the driver told a jump in a reading that was refused
  std::uint64_t jumps_ = 0;
  double ramp_ = 0.0;            // 0 to 1
  std::int64_t force_time_ = 0;  // ns, of the last force(); 0: none since it was connected
  bool stopped_ = true;          // forces were taken away
  bool may_keep_still_ = false;
  Vector3 given_ = Vector3::Zero();  // N, the last force
  std::int64_t moved_time_ = 0;      // ns, of the last reading that was another one, or came without a force
  std::int64_t window_begin_ = 0;    // ns, of the readings that are counted here
  int window_readings_ = 0;
  int window_refused_ = 0;
  std::int64_t refused_until_ = 0;  // ns

  std::atomic<std::uint64_t> passed_ = 0;
  std::atomic<std::uint64_t> not_finite_ = 0;
  std::atomic<std::uint64_t> far_away_ = 0;
  std::atomic<std::uint64_t> spikes_ = 0;
  std::atomic<std::uint64_t> left_out_ = 0;
  std::atomic<std::uint64_t> watchdog_stops_ = 0;
  std::atomic<unsigned> troubles_ = 0;          // bits of Trouble
  std::atomic<std::int64_t> pushes_since_ = 0;  // ns, since when it may push again; 0: it always might

  mutable std::mutex condition_guard_;
  std::string lost_why_;      // of the last loss
  std::string withheld_why_;  // empty: the driver withholds nothing
  std::string told_;          // by the driver
};

}  // namespace icome::devices
