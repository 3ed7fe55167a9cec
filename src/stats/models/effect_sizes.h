#pragma once
#include "base/result.h"

namespace icome::stats {

/// Both ends of a confidence interval.
struct EffectInterval {
  double low = 0.0, high = 0.0;
};

/// The confidence interval of the noncentrality of an F with df and error_df degrees of freedom: at `high`,
/// f or less has the probability (1 - confidence) / 2, and at `low`, f or more has it (Steiger 2004). An end
/// that would be below 0 is 0. Fails when f is negative or not finite, df or error_df is not above 0, or the
/// confidence is not between 0 and 1.
base::Result<EffectInterval> noncentrality_interval(double f, double df, double error_df,
                                                    double confidence = 0.90);

/// The interval of the population's share of variance behind an F: noncentrality / (noncentrality + n) with
/// n = df + error_df + 1 (Steiger 2004). Partial eta squared and partial omega squared estimate this share,
/// and in a one-way analysis eta squared and omega squared do as well. With the confidence 0.90 the
/// interval leaves out 0 exactly where p < 0.05. Fails as noncentrality_interval() does.
base::Result<EffectInterval> partial_eta_sq_interval(double f, double df, double error_df,
                                                     double confidence = 0.90);

/// The interval of a share of variance with another denominator (eta squared, generalised eta
/// squared): an approximation by the F that would give this share if its denominator were the term and
/// its error alone. Fails unless 0 <= share < 1, and as partial_eta_sq_interval() does.
base::Result<EffectInterval> eta_sq_interval(double share, double df, double error_df,
                                             double confidence = 0.90);

/// The interval of a share of variance whose denominator has more in it than the effect and its error: the
/// effect is the noncentrality times `error_ms`, and `rest` is all else in the denominator, taken as it is
/// (RepeatedMeasuresTerm has it for each share). Leaves out 0 exactly where partial_eta_sq_interval() does.
/// Assumes sphericity, as the F does. Fails as noncentrality_interval() does, and when error_ms or rest is
/// not above 0.
base::Result<EffectInterval> share_interval(double f, double df, double error_df, double error_ms,
                                            double rest, double confidence = 0.90);

}  // namespace icome::stats
