#pragma once
#include <span>

namespace icome::stats {

/// The compensated sum, which keeps the digits that plain addition loses (Neumaier 1974). 0 for no values.
double sum(std::span<const double> values);

/// The arithmetic mean (thesis 6.4.1). At least one value.
double mean(std::span<const double> values);

/// The sum of squared deviations from the mean, computed in two passes and corrected for the rounding of the
/// mean (Chan, Golub and LeVeque 1983). At least one value.
double squared_deviations(std::span<const double> values);

/// The variance with n - 1 in the denominator (thesis 6.4.1). At least two values.
double variance(std::span<const double> values);

}  // namespace icome::stats
