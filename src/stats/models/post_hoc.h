#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Holm's (1979) adjusted p values, in the order given. NaN stays NaN and is not counted.
std::vector<double> holm(std::span<const double> p_values);
/// Bonferroni's adjusted p values: each times their number, at most 1. NaN stays NaN and is not counted.
std::vector<double> bonferroni(std::span<const double> p_values);

enum class Adjustment : std::uint8_t { None, Bonferroni, Holm };

/// Two of the groups, by their index: first < second.
struct PairComparison {
  std::size_t first = 0;
  std::size_t second = 0;
  double difference = 0.0;      // mean of the second less mean of the first, as in R's TukeyHSD
  double statistic = 0.0;       // Tukey: q; pairwise: t
  double df = 0.0;              // of the statistic
  ConfidenceInterval interval;  // Tukey: simultaneous; pairwise: of this pair alone, not adjusted
  double p = 1.0;               // adjusted for the number of comparisons
};

/// The input of Tukey's test: a mean and a count for each level compared, and the error term.
struct MeansToCompare {
  std::vector<double> means;
  std::vector<double> counts;  // number of values of each mean, above 0
  double residual_ms = 0.0;    // mean square error of the analysis, above 0
  double residual_df = 0.0;    // at least 1
};

/// Tukey's honest significant differences of all pairs, by Kramer's (1956) formula where counts differ.
/// Serves factorial designs: give the marginal means and the analysis's error term.
base::Result<std::vector<PairComparison>> tukey_hsd(const MeansToCompare& design, double confidence = 0.95);
/// Tukey's test of a one-way layout. At least two groups of one finite value, with some variance within.
base::Result<std::vector<PairComparison>> tukey_hsd(const std::vector<std::vector<double>>& groups,
                                                    double confidence = 0.95);

/// The error that pairwise t-tests use.
enum class PairwiseError : std::uint8_t {
  Pooled,    // of all groups: R's default
  Separate,  // Welch's test of the two
  Paired,    // of the differences: the groups are the same people's, in the same order
};
/// Compares each pair by a two-sided t-test.
base::Result<std::vector<PairComparison>> pairwise_t_tests(const std::vector<std::vector<double>>& groups,
                                                           Adjustment adjustment = Adjustment::Holm,
                                                           PairwiseError error = PairwiseError::Pooled,
                                                           double confidence = 0.95);

}  // namespace icome::stats
