#pragma once
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Tail probabilities and quantiles that tests share, by Boost.Math. Arguments are possible ones: df > 0,
/// probabilities in (0, 1), effects not negative; anything else gives NaN.

double normal_above(double z);
double normal_quantile(double probability);
double t_above(double t, double df);
double t_quantile(double probability, double df);
double chi_squared_above(double x, double df);
double chi_squared_quantile(double probability, double df);
/// 0 for infinite f; NaN for a NaN or when a number of degrees of freedom is not above 0.
double f_above(double f, double df, double error_df);
double f_quantile(double probability, double df, double error_df);
double beta_quantile(double probability, double a, double b);
double noncentral_f_below(double f, double df, double error_df, double lambda);
double noncentral_f_above(double f, double df, double error_df, double lambda);
double noncentral_chi_squared_above(double x, double df, double lambda);

/// P(T <= t) of the noncentral t with `df` and the noncentrality `delta`, to about 1e-13 whatever their size.
double noncentral_t_below(double t, double df, double delta);
/// The interval of delta for `t`: P(T > t) at `low`, and P(T <= t) at `high`, is (1 - confidence) / 2.
ConfidenceInterval t_noncentrality_interval(double t, double df, double confidence);

/// The p value of a statistic with a symmetric null distribution.
double normal_p(double z, Alternative alternative);
double t_p(double t, double df, Alternative alternative);

}  // namespace icome::stats
