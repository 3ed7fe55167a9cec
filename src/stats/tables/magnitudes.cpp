#include "stats/tables/magnitudes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace icome::stats {

base::Result<void> check_magnitudes(std::span<const double> values) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isnan(values[i])) continue;
    if (!(std::abs(values[i]) <= 1e150)) {
      return base::fail(
          fmt::format("value {} is {}: leave it out, or divide all by a constant", i + 1, values[i]));
    }
    low = std::min(low, values[i]);
    high = std::max(high, values[i]);
  }
  if (high > low && high - low < 1e-140) {
    return base::fail("the values differ by less than 1e-140: multiply all by a constant");
  }
  return {};
}

}  // namespace icome::stats
