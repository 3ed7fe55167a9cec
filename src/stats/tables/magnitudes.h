#pragma once
#include <span>

#include "base/result.h"

namespace icome::stats {

/// Fails when sums of squares of the values would be unreliable: when a value is infinite or beyond 1e150, or
/// when the values differ, but by less than 1e-140 in all. NaN is ignored.
base::Result<void> check_magnitudes(std::span<const double> values);

}  // namespace icome::stats
