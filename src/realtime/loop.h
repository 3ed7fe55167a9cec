#pragma once
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "base/result.h"
#include "realtime/recorder.h"

namespace icome::realtime {

/// Settings of a loop.
struct LoopSettings {
  double rate_hz = 1000.0;        // Hz, 500 to 10,000; stiff contact and texture like 5,000 and more
  bool realtime_priority = true;  // ask for SCHED_FIFO, so that no ordinary thread delays a tick
  int priority = 80;              // SCHED_FIFO priority, 1 to 99
  bool lock_memory = true;        // ask that the program's memory is never paged out
  std::string name = "servo";     // of the thread, for debuggers; 15 letters are shown
};

/// The settings that the system granted.
struct LoopReport {
  bool realtime_priority = false;  // the loop runs under SCHED_FIFO
  bool memory_locked = false;      // memory mapped when the loop began stays in memory
  std::string notice;  // sentences for the user: what was asked for but refused, and what to do; or empty
};

/// Information for one tick. Times on the steady clock (base::steady_nanoseconds).
struct TickInfo {
  std::uint64_t index = 0;     // number of the deadline, from 0; skipped deadlines leave gaps
  std::int64_t scheduled = 0;  // ns, the deadline itself
  double dt = 0.0;             // s from the last tick's deadline to this one's; the period at first
};

/// The deadlines of a loop: evenly spaced from an origin, and free of drift however long it runs.
class Timetable {
 public:
  /// First deadline at `origin`, ns; `rate_hz` > 0 deadlines a second.
  Timetable(std::int64_t origin, double rate_hz);

  /// The deadline of the given number, ns. Real-time safe.
  std::int64_t deadline(std::uint64_t index) const;

  /// The number of the first deadline after `index` that is later than `now`, ns: deadlines that
  /// have passed are skipped, never made up for in a burst. Real-time safe.
  std::uint64_t next(std::uint64_t index, std::int64_t now) const;

 private:
  std::int64_t origin_;  // ns
  double period_;        // ns
};

/// Calls a tick function at a steady rate on a thread of its own until told to stop or until the tick
/// returns false. Owns the thread, the tick function and the recorder. Started by create(), stopped
/// and joined by stop() or the destructor, both on a thread other than the loop's.
class LoopRunner {
 public:
  /// One tick; false ends the loop. It must not throw, and be real-time safe for the loop to be.
  using Tick = std::function<bool(const TickInfo&)>;

  /// Starts the loop; its first deadline is one period from now. Fails on a rate or priority out of
  /// range and when the system gives no thread. A refused priority or memory lock is no failure: the
  /// loop runs as well as it can, and report() says so. Locked memory stays locked after the loop.
  static base::Result<std::unique_ptr<LoopRunner>> create(const LoopSettings& settings, Tick tick);

  ~LoopRunner();
  LoopRunner(const LoopRunner&) = delete;
  LoopRunner& operator=(const LoopRunner&) = delete;

  /// Ends the loop and waits for the tick under way. May be called again.
  void stop();

  /// Waits until the tick function has ended the loop.
  void wait();

  /// False once the loop has ended, by stop() or by its tick; then all that it wrote can be read.
  bool running() const { return running_.load(std::memory_order_acquire); }

  const LoopReport& report() const { return report_; }

  /// The loop's diary, which may be read while it runs.
  const LoopRecorder& recorder() const { return recorder_; }

 private:
  LoopRunner(const LoopSettings& settings, Tick tick);

  base::Result<void> start();
  void run();
  void run_ticks();
  void prepare_thread();

  const LoopSettings settings_;
  const Tick tick_;
  LoopRecorder recorder_;
  LoopReport report_;                   // written by the loop's thread before create() returns
  std::atomic<bool> prepared_ = false;  // report_ is complete
  std::atomic<bool> running_ = true;
  std::atomic<bool> stop_asked_ = false;
  std::thread thread_;
};

}  // namespace icome::realtime
