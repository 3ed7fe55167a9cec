#pragma once
#include <cstdint>

#include "base/vector.h"

namespace icome::apps {

constexpr std::int32_t kNothingTouched = -1;

/// One tick as the trace holds it; world frame.
struct TickRow {
  double t = 0.0;                         // s
  base::Vector3 tip;                      // m
  base::Vector3 scp;                      // m, as the solver has it, also while nothing is touched
  base::Vector3 force;                    // N
  std::int32_t object = kNothingTouched;  // number of the MODEL on the command line, from 0
  double moment = 0.0;                    // s, of the touch, on the clock of motions and changes
  std::int64_t own_ns = 0;                // ns, all of the tick except device input and output

  bool touching() const { return object != kNothingTouched; }
};

}  // namespace icome::apps
