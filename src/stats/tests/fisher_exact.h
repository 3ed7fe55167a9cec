#pragma once
#include <cstddef>

#include "base/result.h"
#include "stats/tests/contingency.h"

namespace icome::stats {

struct FisherExactSettings {
  double null_odds_ratio = 1.0;  // above 0
  Alternative alternative = Alternative::TwoSided;
  double confidence = 0.95;  // in (0, 1)
};

struct FisherExact {
  double p = 1.0;
  double odds_ratio = 0.0;      // conditional maximum likelihood; may be 0 or infinite
  ConfidenceInterval interval;  // of the odds ratio; one-sided as the test is
};
/// Fisher's exact test of 2 x 2 whole counts of 0 or more (Fisher 1935). A table with an empty row or column
/// has no information: p is 1, the odds ratio NaN, its interval 0 to infinity.
base::Result<FisherExact> fisher_exact_2x2(const CountTable& counts,
                                           const FisherExactSettings& settings = {});

/// The p value for any table (Freeman and Halton 1951): of tables with the same margins, the probability of
/// those that are no more likely than this one. They are built column by column, and those whose remaining
/// rows agree share a node (the network of Mehta and Patel 1983). Fails when the table needs more than
/// `most_nodes` nodes (about 100 bytes each); contingency_test() is the alternative then.
base::Result<double> fisher_exact_p(const CountTable& counts, std::size_t most_nodes = 2'000'000);

}  // namespace icome::stats
