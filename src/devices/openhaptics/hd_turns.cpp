#include "devices/openhaptics/hd_turns.h"

#include "base/clock.h"
#include "realtime/this_thread.h"

namespace icome::devices {

HdTurns::Turn HdTurns::take(std::int64_t patience) {
  // Not a timed mutex: the thread sanitizer does not know how this waits.
  constexpr std::int64_t kStep = 50'000;  // ns
  const std::int64_t end = base::steady_nanoseconds() + patience;
  Turn turn(guard_, std::try_to_lock);
  while (!turn && base::steady_nanoseconds() < end) {
    realtime::sleep_until(base::steady_nanoseconds() + kStep);
    static_cast<void>(turn.try_lock());
  }
  return turn;
}

void HdTurns::pause() {
  pauses_.fetch_add(1, std::memory_order_release);
  paused_.store(true, std::memory_order_release);
}

}  // namespace icome::devices
