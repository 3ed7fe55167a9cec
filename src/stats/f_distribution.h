#pragma once

namespace icome::stats {

/// The chance of f or more under the F distribution: the p of an analysis of variance. 0 for infinite f, NaN
/// for a NaN or when a number of degrees of freedom is not above 0.
double f_upper_tail(double f, double df, double error_df);

/// The chance of f or less under the noncentral F distribution, noncentrality >= 0, f >= 0. NaN where it
/// cannot be computed.
double noncentral_f_lower_tail(double f, double df, double error_df, double noncentrality);

}  // namespace icome::stats
