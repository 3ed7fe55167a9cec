#include "stats/tests/correlation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include "stats/tables/sample_check.h"
#include "stats/tables/sums.h"
#include "stats/tests/rank_sums.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

constexpr std::size_t kMostEnumerated = 9;
constexpr std::size_t kMostBySeries = 1289;

// Deviations from the mean, divided by the largest of them, so that squares neither over- nor underflow.
std::vector<double> scaled_deviations(std::span<const double> values) {
  const double largest_value = std::abs(*std::max_element(
      values.begin(), values.end(), [](double a, double b) { return std::abs(a) < std::abs(b); }));
  std::vector<double> deviations(values.begin(), values.end());
  // Scaling by a power of two rounds nothing, so that small differences between large values are kept.
  for (double& value : deviations) value = std::scalbn(value, -std::ilogb(largest_value));
  double largest = 0.0;
  for (int pass = 0; pass < 2; ++pass) {  // the second removes the rounding of the first mean
    const double centre = mean(deviations);
    largest = 0.0;
    for (double& value : deviations) largest = std::max(largest, std::abs(value -= centre));
  }
  for (double& value : deviations) value /= largest;
  return deviations;
}

double sum_of_products(std::span<const double> x, std::span<const double> y) {
  std::vector<double> products(x.size());
  std::transform(x.begin(), x.end(), y.begin(), products.begin(), std::multiplies<>());
  return sum(products);
}

// Equation 6.23 with the means subtracted first, which keeps digits. Neither may be constant.
double product_moment(std::span<const double> x, std::span<const double> y) {
  const std::vector<double> a = scaled_deviations(x), b = scaled_deviations(y);
  const double r =
      sum_of_products(a, b) / (std::sqrt(sum_of_products(a, a)) * std::sqrt(sum_of_products(b, b)));
  return std::clamp(r, -1.0, 1.0);
}

// The t of a correlation; infinite for a correlation of 1.
double correlation_t(double r, double df) { return r * std::sqrt(df / ((1.0 - r) * (1.0 + r))); }

std::optional<base::Error> pairs_complaint(std::span<const double> x, std::span<const double> y) {
  constexpr std::string_view kName = "correlation";
  if (x.size() != y.size())
    return base::Error{
        fmt::format("correlation: {} x and {} y values; give them in pairs", x.size(), y.size())};
  if (auto error = complaint(kName, "x", x, 3)) return error;
  if (auto error = complaint(kName, "y", y, 3)) return error;
  if (constant(x) || constant(y))
    return base::Error{
        "correlation: a variable does not vary, so nothing correlates; look at what was measured"};
  return std::nullopt;
}

ConfidenceInterval fisher_z_interval(double r, double n, const CorrelationSettings& settings) {
  ConfidenceInterval interval{-1.0, 1.0};
  if (n < 4.0) return interval;
  const bool two_sided = settings.alternative == Alternative::TwoSided;
  const double level = two_sided ? 0.5 + 0.5 * settings.confidence : settings.confidence;
  const double reach = normal_quantile(level) / std::sqrt(n - 3.0);
  if (settings.alternative != Alternative::Less) interval.low = std::tanh(std::atanh(r) - reach);
  if (settings.alternative != Alternative::Greater) interval.high = std::tanh(std::atanh(r) + reach);
  return interval;
}

// P(S >= s) of more than 9 untied pairs: Edgeworth's series in 1 / n, coefficients of Best and Roberts
// (1975).
double spearman_series(double s, double n) {
  const double b = 1.0 / n;
  const double x = (6.0 * (s - 1.0) * b / (n * n - 1.0) - 1.0) * std::sqrt(n - 1.0);
  const double y = x * x;
  const double powers =
      y * (-0.0758 + b * (0.1033 + 0.3932 * b) -
           y * b * (0.0879 + 0.0151 * b - y * (0.0072 - 0.0831 * b + y * b * (0.0131 - 4.6e-4 * y))));
  const double correction = x * b * (0.2274 + b * (0.2531 + 0.1745 * b) + powers);
  return std::clamp(correction / std::exp(0.5 * y) + normal_above(x), 0.0, 1.0);
}

struct SpearmanTails {
  double positive = 1.0;  // P(S <= s): a correlation at least as great
  double negative = 1.0;  // P(S >= s)
};

SpearmanTails untied_tails(double s, std::size_t count) {
  if (count <= kMostEnumerated) {
    const std::vector<double> distribution = spearman_distribution(static_cast<int>(count));
    return {share_up_to(distribution, 0.5 * s), share_from(distribution, 0.5 * s)};
  }
  const auto n = static_cast<double>(count);
  return {1.0 - spearman_series(s + 2.0, n), spearman_series(s, n)};
}

bool has_ties(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return std::adjacent_find(values.begin(), values.end()) != values.end();
}

// The rows of two columns in which both have a value.
std::array<std::vector<double>, 2> complete_pairs(std::span<const double> x, std::span<const double> y) {
  std::array<std::vector<double>, 2> pairs;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::isnan(x[i]) || std::isnan(y[i])) continue;
    pairs[0].push_back(x[i]);
    pairs[1].push_back(y[i]);
  }
  return pairs;
}

struct Correlated {
  double r = std::numeric_limits<double>::quiet_NaN();
  double p = std::numeric_limits<double>::quiet_NaN();
};

Correlated correlate(CorrelationKind kind, std::span<const double> x, std::span<const double> y) {
  if (kind == CorrelationKind::Pearson) {
    if (const auto test = pearson(x, y)) return {test->r, test->p};
  } else if (const auto test = spearman(x, y)) {
    return {test->rho, test->p};
  }
  return {};
}

}  // namespace

double critical_r(double df, double alpha) {
  const double t = t_quantile(1.0 - 0.5 * alpha, df);
  return t / std::sqrt(df + t * t);
}

base::Result<PearsonCorrelation> pearson(std::span<const double> x, std::span<const double> y,
                                         const CorrelationSettings& settings) {
  if (auto error = confidence_complaint("correlation", settings.confidence)) return tl::unexpected(*error);
  if (auto error = pairs_complaint(x, y)) return tl::unexpected(*error);
  const auto n = static_cast<double>(x.size());
  PearsonCorrelation correlation;
  correlation.r = product_moment(x, y);
  correlation.df = n - 2.0;
  correlation.t = correlation_t(correlation.r, correlation.df);
  correlation.p = t_p(correlation.t, correlation.df, settings.alternative);
  correlation.interval = fisher_z_interval(correlation.r, n, settings);
  correlation.critical_r = critical_r(correlation.df, 1.0 - settings.confidence);
  return correlation;
}

base::Result<SpearmanCorrelation> spearman(std::span<const double> x, std::span<const double> y,
                                           Alternative alternative) {
  if (auto error = pairs_complaint(x, y)) return tl::unexpected(*error);
  const std::vector<double> x_ranks = ranks(x), y_ranks = ranks(y);
  const auto n = static_cast<double>(x.size());
  SpearmanCorrelation correlation;
  correlation.rho = product_moment(x_ranks, y_ranks);
  correlation.s = (n * n * n - n) * (1.0 - correlation.rho) / 6.0;
  if (x.size() > kMostBySeries || has_ties(x_ranks) || has_ties(y_ranks)) {
    correlation.p = t_p(correlation_t(correlation.rho, n - 2.0), n - 2.0, alternative);
    return correlation;
  }
  correlation.s = std::round(correlation.s);
  correlation.exact = x.size() <= kMostEnumerated;
  const SpearmanTails tails = untied_tails(correlation.s, x.size());
  if (alternative == Alternative::TwoSided)
    correlation.p = std::min(1.0, 2.0 * (correlation.rho < 0.0 ? tails.negative : tails.positive));
  else
    correlation.p = alternative == Alternative::Greater ? tails.positive : tails.negative;
  return correlation;
}

base::Result<CorrelationMatrix> correlation_matrix(const std::vector<std::vector<double>>& columns,
                                                   CorrelationKind kind) {
  if (columns.size() < 2) return base::fail("correlation matrix: give at least two columns");
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (columns[i].size() != columns.front().size())
      return base::fail("correlation matrix: columns differ in length; mark missing values as NaN");
    if (std::any_of(columns[i].begin(), columns[i].end(), [](double value) { return std::isinf(value); }))
      return base::fail(
          fmt::format("correlation matrix: column {} has an infinite value; leave it out", i + 1));
  }
  const auto size = static_cast<Eigen::Index>(columns.size());
  CorrelationMatrix matrix{Eigen::MatrixXd::Identity(size, size), Eigen::MatrixXd::Zero(size, size),
                           Eigen::MatrixXi::Zero(size, size)};
  for (Eigen::Index i = 0; i < size; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) {
      const auto pairs =
          complete_pairs(columns[static_cast<std::size_t>(i)], columns[static_cast<std::size_t>(j)]);
      matrix.counts(i, j) = matrix.counts(j, i) = static_cast<int>(pairs[0].size());
      if (i == j) continue;
      const Correlated found = correlate(kind, pairs[0], pairs[1]);
      matrix.r(i, j) = matrix.r(j, i) = found.r;
      matrix.p(i, j) = matrix.p(j, i) = found.p;
    }
  }
  return matrix;
}

}  // namespace icome::stats
