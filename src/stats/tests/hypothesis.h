#pragma once
#include <cstdint>

namespace icome::stats {

/// What is held against the null hypothesis. Of two groups, the first compared to the second: `Greater` says
/// that the first is greater.
enum class Alternative : std::uint8_t { TwoSided, Less, Greater };

/// Where the quantity that was estimated is likely to be, in the unit of the estimate. One end is infinite
/// (or the end of what is possible) where the interval belongs to a one-sided test.
struct ConfidenceInterval {
  double low = 0.0;
  double high = 0.0;
};

}  // namespace icome::stats
