#pragma once
#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

struct BinomialTest {
  double p = 1.0;
  double share = 0.0;           // successes / trials
  ConfidenceInterval interval;  // of the share (Clopper and Pearson 1934); one-sided as the test is
};

struct BinomialTestSettings {
  double probability = 0.5;  // of a success under the null hypothesis, 0 to 1
  Alternative alternative = Alternative::TwoSided;
  double confidence = 0.95;  // in (0, 1)
};

/// Is `probability` the probability of a success? Exact; two-sided, p counts all outcomes that are no more
/// likely than this one. Whole numbers, at least one trial and at most 1e9.
base::Result<BinomialTest> binomial_test(double successes, double trials,
                                         const BinomialTestSettings& settings = {});

/// The sign test: are as many better as worse? Equal ones are not counted. Two-sided unless set.
base::Result<BinomialTest> sign_test(double better, double worse, const BinomialTestSettings& settings = {});

}  // namespace icome::stats
