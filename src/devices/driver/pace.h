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
  /// `rate` (> 0) deadlines a second from now on.
  explicit Pace(double rate) : timetable_(base::steady_nanoseconds(), rate) {}

  /// Waits for the next deadline. Real-time safe.
  void wait() {
    index_ = timetable_.next(index_, base::steady_nanoseconds());
    const std::int64_t deadline = timetable_.deadline(index_);
    // At a rate that nobody can keep it has passed already.
    if (deadline > base::steady_nanoseconds()) realtime::sleep_until(deadline);
  }

 private:
  realtime::Timetable timetable_;
  std::uint64_t index_ = 0;
};

}  // namespace icome::devices
