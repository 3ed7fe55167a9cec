#pragma once
#include <span>

namespace icome::stats {

/// The sum, with the digits kept that adding one after the other loses (Neumaier 1974). 0 of none.
double sum(std::span<const double> values);

/// The arithmetic mean (thesis 6.4.1). At least one value.
double mean(std::span<const double> values);

/// The sum of squared deviations from their mean, computed in two passes and corrected for what rounding
/// leaves of the first (Chan, Golub and LeVeque 1983). At least one value.
double squared_deviations(std::span<const double> values);

/// The variance with n - 1 in the denominator (thesis 6.4.1). At least two values.
double variance(std::span<const double> values);

}  // namespace icome::stats
