#pragma once

namespace icome::stats {

/// The distribution of the range of `groups` means over their standard error, which has `df` degrees of
/// freedom (Tukey 1953), integrated numerically to about 12 digits.

/// P(range <= q). NaN unless 2 <= groups <= 1000 and df >= 1; df may be infinite.
double studentized_range_below(double q, double groups, double df);
/// P(range > q), with its digits kept where it is small, to about 1e-17 absolute.
double studentized_range_above(double q, double groups, double df);
/// The q below which the range lies with this probability. NaN as above, and unless 0 <= probability < 1.
double studentized_range_quantile(double probability, double groups, double df);

}  // namespace icome::stats
