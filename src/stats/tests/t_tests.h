#pragma once
#include <cstdint>
#include <span>

#include "base/result.h"
#include "stats/tests/hypothesis.h"

namespace icome::stats {

/// The null hypothesis, alternative and confidence of a t-test.
struct TTestSettings {
  double null_value = 0.0;  // of the mean or the difference of means, in the unit of the values
  Alternative alternative = Alternative::TwoSided;
  double confidence = 0.95;  // of the intervals, in (0, 1)
};

/// The divisor of a standardised mean difference.
enum class Standardiser : std::uint8_t {
  SampleSd,      // of the one sample
  PooledSd,      // of both samples, also beside Welch's test: Cohen's d_s
  DifferenceSd,  // of the differences of pairs: Cohen's d_z
};

struct TTest {
  double t = 0.0;
  double df = 0.0;  // not whole for Welch's test
  double p = 1.0;
  double difference = 0.0;      // the mean, first mean less second mean, or the mean of first less second
  double standard_error = 0.0;  // of the difference
  ConfidenceInterval interval;  // of the difference; one-sided as the test is
  double d = 0.0;               // Cohen's d: difference less null_value, divided by the `standardiser`
  Standardiser standardiser = Standardiser::SampleSd;
  ConfidenceInterval d_interval;  // always two-sided, by the non-central t (Steiger and Fouladi 1997)
};

/// Is the mean `null_value`? (Student 1908.) At least two finite values that are not all the same.
base::Result<TTest> one_sample_t_test(std::span<const double> values, const TTestSettings& settings = {});

/// Do the means differ, whatever the variances? (Welch 1947.) At least two finite values each, and not all
/// values of both groups the same as their mean. The interval of d is that of the pooled test: it takes
/// the variances as equal.
base::Result<TTest> welch_t_test(std::span<const double> first, std::span<const double> second,
                                 const TTestSettings& settings = {});

/// Do the means differ, given equal variances? One of the groups may have a single value.
base::Result<TTest> pooled_t_test(std::span<const double> first, std::span<const double> second,
                                  const TTestSettings& settings = {});

/// Do the two values of a pair differ? As many first as second values, pair by pair.
base::Result<TTest> paired_t_test(std::span<const double> first, std::span<const double> second,
                                  const TTestSettings& settings = {});

}  // namespace icome::stats
