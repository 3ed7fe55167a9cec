#pragma once
#include "base/result.h"

namespace icome::stats {

/// Both ends of a confidence interval.
struct EffectInterval {
  double low = 0.0, high = 0.0;
};

/// The noncentralities of F with df and error_df degrees of freedom between which f is not surprising: of a
/// larger one than `high` f or less has the probability (1 - confidence) / 2, of a smaller one than `low` f
/// or more has (Steiger 2004). An end that would be below 0 is 0. Fails when f is negative or not finite, df
/// or error_df is not above 0, or the confidence is not between 0 and 1.
base::Result<EffectInterval> noncentrality_interval(double f, double df, double error_df,
                                                    double confidence = 0.90);

/// The interval of the population's share of variance behind an F: noncentrality / (noncentrality + n) with
/// n = df + error_df + 1 (Steiger 2004). Partial eta squared and partial omega squared both estimate this
/// share; in a one-way analysis it is eta squared's and omega squared's too. With the confidence 0.90 it
/// leaves out 0 exactly where p < 0.05. Fails as noncentrality_interval() does.
base::Result<EffectInterval> partial_eta_sq_interval(double f, double df, double error_df,
                                                     double confidence = 0.90);

/// The same for a share of variance that another denominator goes with (eta squared, generalised eta
/// squared): by the F that would give this share were its denominator the term and its error alone, an
/// approximation. 0 <= share < 1, otherwise fails.
base::Result<EffectInterval> eta_sq_interval(double share, double df, double error_df,
                                             double confidence = 0.90);

/// The interval of a share of variance that has more in its denominator than the effect and its error: with
/// the noncentrality times `error_ms` for the effect, and `rest` for all else there (RepeatedMeasuresTerm
/// has it for each share), which is taken as it is. Leaves out 0 exactly where partial_eta_sq_interval()
/// does. Supposes sphericity, as the F does. Fails as noncentrality_interval() does, and when error_ms or
/// rest is not above 0.
base::Result<EffectInterval> share_interval(double f, double df, double error_df, double error_ms,
                                            double rest, double confidence = 0.90);

}  // namespace icome::stats
