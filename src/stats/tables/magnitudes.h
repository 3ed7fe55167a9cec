#pragma once
#include <span>

#include "base/result.h"

namespace icome::stats {

/// Fails when sums of squares of the values, NaN left aside, could not be trusted: when one is infinite or
/// beyond 1e150, or when they differ, but by less than 1e-140 in all.
base::Result<void> check_magnitudes(std::span<const double> values);

}  // namespace icome::stats
