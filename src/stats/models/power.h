#pragma once
#include <cstddef>
#include <cstdint>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Power: the probability that a test finds an effect of a given size. Effects are standardised, without
/// unit. All functions fail for impossible sizes (alpha outside [1e-9, 1), too few values, not finite), and
/// those for needed counts also where more than 1e7 would be needed.

/// The samples that a t-test compares.
enum class TDesign : std::uint8_t { OneSample, Paired, TwoSample };

struct PowerSettings {
  double alpha = 0.05;  // in [1e-9, 1)
  Alternative alternative = Alternative::TwoSided;
};

/// The power of a t-test with `count` values (pairs, or a group), for Cohen's d (of pairs d_z). Two-sided,
/// both tails count (power.t.test(strict = TRUE) in R). `count` need not be whole, but is at least 2.
base::Result<double> t_test_power(TDesign design, double count, double d, const PowerSettings& settings = {});
/// The power of a pooled t-test of two groups of unequal size.
base::Result<double> t_test_power(double first_count, double second_count, double d,
                                  const PowerSettings& settings = {});
/// The smallest whole count (pairs, or values a group) that reaches `power`, alpha < power < 1.
base::Result<std::size_t> t_test_count(TDesign design, double d, double power,
                                       const PowerSettings& settings = {});

/// The power of a one-way ANOVA with `count` values in each group, for Cohen's f = sd of the group means
/// (n in the denominator) over sd within the groups.
base::Result<double> anova_power(std::size_t groups, double count, double f, double alpha = 0.05);
/// The smallest whole count in each group that reaches `power`.
base::Result<std::size_t> anova_count(std::size_t groups, double f, double power, double alpha = 0.05);

/// The power of a chi-squared test with `df` and `total` counts, for Cohen's w = sqrt(sum((p1 - p0)^2 / p0)).
base::Result<double> chi_squared_power(double df, double total, double w, double alpha = 0.05);
/// The smallest whole total that reaches `power`.
base::Result<std::size_t> chi_squared_count(double df, double w, double power, double alpha = 0.05);

}  // namespace icome::stats
