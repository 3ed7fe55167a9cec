#pragma once
#include <cstdint>

#include "base/clock.h"
#include "realtime/loop.h"
#include "realtime/this_thread.h"

namespace icome::devices {

/// The pace of a driver's thread: evenly spaced deadlines, of which those that have passed are skipped. One
/// thread's.
class Pace {
 public:
  /// `rate` deadlines a second from now on; 0: no waiting at all.
  explicit Pace(double rate)
      : waits_(rate > 0.0), timetable_(base::steady_nanoseconds(), waits_ ? rate : 1.0) {}

  /// Waits for the next deadline. Real-time safe.
  void wait() {
    if (!waits_) return;
    index_ = timetable_.next(index_, base::steady_nanoseconds());
    realtime::sleep_until(timetable_.deadline(index_));
  }

 private:
  bool waits_;
  realtime::Timetable timetable_;
  std::uint64_t index_ = 0;
};

}  // namespace icome::devices
