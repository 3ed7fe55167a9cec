#pragma once
#include <time.h>

#include <cstdint>

namespace icome::base {

/// Nanoseconds on the steady clock (CLOCK_MONOTONIC); only differences mean anything. Real-time safe.
inline std::int64_t steady_nanoseconds() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

}  // namespace icome::base
