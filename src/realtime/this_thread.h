#pragma once
#include <cstdint>

namespace icome::realtime {

/// Sleeps until a time on the steady clock (base::steady_nanoseconds), ns; returns at once when it has
/// passed. A signal does not end it early. Real-time safe.
void sleep_until(std::int64_t nanoseconds);

/// Asks that no ordinary thread delays the calling one (SCHED_FIFO, `priority` 1 to 99); false where the
/// system does not permit it.
bool ask_for_realtime_priority(int priority);

}  // namespace icome::realtime
