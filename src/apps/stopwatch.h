#pragma once
#include <cstdint>

#include "base/clock.h"

namespace icome::apps {

/// Measures the time since it was made, on the steady clock.
class Stopwatch {
 public:
  double seconds() const { return static_cast<double>(base::steady_nanoseconds() - start_) * 1e-9; }

 private:
  std::int64_t start_ = base::steady_nanoseconds();
};

}  // namespace icome::apps
