#include "realtime/this_thread.h"

#include <pthread.h>
#include <sched.h>
#include <time.h>

#include <cerrno>

namespace icome::realtime {

// Absolute, so that a signal does not prolong it.
void sleep_until(std::int64_t nanoseconds) {
  const timespec until{nanoseconds / 1'000'000'000, nanoseconds % 1'000'000'000};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
  }
}

bool ask_for_realtime_priority(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters) == 0;
}

}  // namespace icome::realtime
