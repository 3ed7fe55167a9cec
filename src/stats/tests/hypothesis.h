#pragma once
#include <cstdint>

namespace icome::stats {

/// The alternative to the null hypothesis. With two groups, the first is compared to the second: `Greater`
/// says that the first is greater.
enum class Alternative : std::uint8_t { TwoSided, Less, Greater };

/// The range in which an estimated quantity is likely to be, in the unit of the estimate. One end is
/// infinite (or the end of what is possible) if the interval belongs to a one-sided test.
struct ConfidenceInterval {
  double low = 0.0;
  double high = 0.0;
};

}  // namespace icome::stats
