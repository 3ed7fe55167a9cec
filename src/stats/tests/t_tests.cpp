#include "stats/tests/t_tests.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "stats/tables/sample_check.h"
#include "stats/tables/sums.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

constexpr std::string_view kTTest = "t-test";

struct Moments {
  double n, mean, squares;  // squares: squared deviations
  double variance() const { return squares / (n - 1.0); }
};

Moments moments_of(std::span<const double> values) {
  return {static_cast<double>(values.size()), mean(values), squared_deviations(values)};
}

std::optional<base::Error> settings_complaint(const TTestSettings& settings) {
  if (!std::isfinite(settings.null_value))
    return base::Error{"t-test: the value to test against is not a finite number; give one, such as 0"};
  return confidence_complaint(kTTest, settings.confidence);
}

std::optional<base::Error> spread_complaint(double standard_error, double largest_mean) {
  if (!std::isfinite(standard_error))
    return base::Error{"t-test: the values are too large to square; give them in a larger unit"};
  // Differences this small are only the rounding of the values: R's rule.
  if (standard_error <= 10.0 * std::numeric_limits<double>::epsilon() * std::abs(largest_mean))
    return base::Error{
        "t-test: the values do not vary, or by too little to be squared; look at the means, or change the "
        "unit"};
  return std::nullopt;
}

ConfidenceInterval difference_interval(const TTest& test, const TTestSettings& settings) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const bool two_sided = settings.alternative == Alternative::TwoSided;
  const double level = two_sided ? 0.5 + 0.5 * settings.confidence : settings.confidence;
  const double reach = t_quantile(level, test.df) * test.standard_error;
  return {settings.alternative == Alternative::Less ? -kInfinity : test.difference - reach,
          settings.alternative == Alternative::Greater ? kInfinity : test.difference + reach};
}

// Fills in the results that follow from the difference, its standard error and the degrees of freedom.
void judge(TTest& test, const TTestSettings& settings) {
  test.t = (test.difference - settings.null_value) / test.standard_error;
  test.p = t_p(test.t, test.df, settings.alternative);
  test.interval = difference_interval(test, settings);
}

// d is t times `scale` for a t with `df` degrees of freedom (Steiger and Fouladi 1997).
void size_effect(TTest& test, double t, double df, double scale, double confidence) {
  test.d = t * scale;
  const ConfidenceInterval delta = t_noncentrality_interval(t, df, confidence);
  test.d_interval = {delta.low * scale, delta.high * scale};
}

base::Result<TTest> test_of_one(const Moments& sample, Standardiser standardiser,
                                const TTestSettings& settings, double scale_of_values) {
  TTest test;
  test.df = sample.n - 1.0;
  test.difference = sample.mean;
  test.standard_error = std::sqrt(sample.variance() / sample.n);
  test.standardiser = standardiser;
  if (auto error = spread_complaint(test.standard_error, scale_of_values)) return tl::unexpected(*error);
  judge(test, settings);
  size_effect(test, test.t, test.df, 1.0 / std::sqrt(sample.n), settings.confidence);
  return test;
}

enum class Variances : std::uint8_t { Equal, Any };

// The standard error and degrees of freedom of Welch and Satterthwaite.
void set_welch_error(TTest& test, const Moments& first, const Moments& second) {
  const double a = first.variance() / first.n, b = second.variance() / second.n;
  test.standard_error = std::sqrt(a + b);
  // As shares, so that squares neither over- nor underflow.
  const double share = a / (a + b), rest = b / (a + b);
  test.df = 1.0 / (share * share / (first.n - 1.0) + rest * rest / (second.n - 1.0));
}

base::Result<TTest> test_of_two(std::span<const double> first, std::span<const double> second,
                                const TTestSettings& settings, Variances variances) {
  if (auto error = settings_complaint(settings)) return tl::unexpected(*error);
  const std::size_t least = variances == Variances::Any ? 2 : 1;
  if (auto error = complaint(kTTest, "the first group", first, least)) return tl::unexpected(*error);
  if (auto error = complaint(kTTest, "the second group", second, least)) return tl::unexpected(*error);
  if (first.size() + second.size() < 3)
    return base::fail("t-test: two values in all, give at least three in the two groups together");
  const Moments a = moments_of(first), b = moments_of(second);
  const double pooled_df = a.n + b.n - 2.0;
  const double pooled_variance = (a.squares + b.squares) / pooled_df;
  const double counts = std::sqrt(1.0 / a.n + 1.0 / b.n);
  TTest test;
  test.df = pooled_df;
  test.difference = a.mean - b.mean;
  test.standard_error = std::sqrt(pooled_variance) * counts;
  test.standardiser = Standardiser::PooledSd;
  const double pooled_error = test.standard_error;
  if (auto error = spread_complaint(pooled_error, std::max(std::abs(a.mean), std::abs(b.mean))))
    return tl::unexpected(*error);
  if (variances == Variances::Any) set_welch_error(test, a, b);
  judge(test, settings);
  const double pooled_t = (test.difference - settings.null_value) / pooled_error;
  size_effect(test, pooled_t, pooled_df, counts, settings.confidence);
  return test;
}

}  // namespace

base::Result<TTest> one_sample_t_test(std::span<const double> values, const TTestSettings& settings) {
  if (auto error = settings_complaint(settings)) return tl::unexpected(*error);
  if (auto error = complaint(kTTest, "the sample", values, 2)) return tl::unexpected(*error);
  const Moments sample = moments_of(values);
  return test_of_one(sample, Standardiser::SampleSd, settings, sample.mean);
}

base::Result<TTest> welch_t_test(std::span<const double> first, std::span<const double> second,
                                 const TTestSettings& settings) {
  return test_of_two(first, second, settings, Variances::Any);
}

base::Result<TTest> pooled_t_test(std::span<const double> first, std::span<const double> second,
                                  const TTestSettings& settings) {
  return test_of_two(first, second, settings, Variances::Equal);
}

base::Result<TTest> paired_t_test(std::span<const double> first, std::span<const double> second,
                                  const TTestSettings& settings) {
  if (auto error = settings_complaint(settings)) return tl::unexpected(*error);
  if (first.size() != second.size())
    return base::fail("t-test: pairs need as many first as second values; leave out those without a partner");
  if (auto error = complaint(kTTest, "the first of the pairs", first, 2)) return tl::unexpected(*error);
  if (auto error = complaint(kTTest, "the second of the pairs", second, 2)) return tl::unexpected(*error);
  std::vector<double> differences(first.size());
  std::transform(first.begin(), first.end(), second.begin(), differences.begin(), std::minus<>());
  return test_of_one(moments_of(differences), Standardiser::DifferenceSd, settings,
                     std::max(std::abs(mean(first)), std::abs(mean(second))));
}

}  // namespace icome::stats
