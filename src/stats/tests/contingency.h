#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// Counts: a row for each level of one variable, a column for each level of the other.
using CountTable = std::vector<std::vector<double>>;

struct ChiSquared {
  double chi_squared = 0.0;
  double df = 0.0;
  double p = 1.0;
  CountTable expected;   // if the null hypothesis holds; one row for a goodness of fit
  CountTable residuals;  // (observed - expected) / sqrt(expected)
  double w = 0.0;        // Cohen's effect size w, without Yates's correction: sqrt(chi squared / N)
  /// A sentence if the approximation is in doubt because an expected count is below 5, otherwise empty.
  std::string warning;
};

/// Are counts distributed as `probabilities` (thesis 6.4.2: evenly, when there are none)? At least two
/// whole counts of 0 or more, and as many probabilities above 0 whose sum is 1.
base::Result<ChiSquared> goodness_of_fit(std::span<const double> counts,
                                         std::span<const double> probabilities = {});

/// Yates's correction: subtracts up to 1/2 from each difference, in tables of 2 x 2 only.
enum class Yates : std::uint8_t { Off, On };

struct Contingency : ChiSquared {
  double cramers_v = 0.0;  // without Yates's correction; 0 for independent, 1 if one decides the other
};
/// Are rows and columns independent? (Pearson 1900.) At least 2 x 2 whole counts of 0 or more, with
/// no row and no column of zeros only.
base::Result<Contingency> contingency_test(const CountTable& counts, Yates yates = Yates::Off);

struct McNemar {
  double chi_squared = 0.0;
  double df = 0.0;
  double p = 1.0;
  double exact_p = 1.0;     // of 2 x 2: two-sided binomial test of the changes; NaN for larger tables
  double odds_ratio = 0.0;  // of 2 x 2: changes from first to second row over the others, n12 / n21
};
/// Do as many change one way as the other? (McNemar 1947; Bowker 1948 for more than two levels.) A square
/// table of before (rows) by after (columns). `yates` as in R's mcnemar.test, On there.
base::Result<McNemar> mcnemar_test(const CountTable& counts, Yates yates = Yates::On);

}  // namespace icome::stats
