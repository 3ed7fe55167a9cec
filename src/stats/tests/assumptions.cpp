#include "stats/tests/assumptions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string_view>

#include "stats/tables/sample_check.h"
#include "stats/tables/sums.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

enum class Centre : std::uint8_t { Mean, Median };

double middle_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  if (values.size() % 2 == 1) return values[half];
  return values[half - 1] + 0.5 * (values[half] - values[half - 1]);
}

std::vector<double> distances_from(Centre centre, const std::vector<double>& values) {
  const double middle = centre == Centre::Mean ? mean(values) : middle_of(values);
  std::vector<double> distances = values;
  for (double& value : distances) value = std::abs(value - middle);
  return distances;
}

double largest_size(const std::vector<std::vector<double>>& groups) {
  double largest = 0.0;
  for (const auto& group : groups)
    for (const double value : group) largest = std::max(largest, std::abs(value));
  return largest;
}

base::Result<VarianceTest> distance_test(std::string_view name,
                                         const std::vector<std::vector<double>>& groups, Centre centre) {
  if (auto error = complaint(name, groups, 2)) return tl::unexpected(*error);
  const double total = static_cast<double>(joined(groups).size()), count = static_cast<double>(groups.size());
  std::vector<std::vector<double>> distances;
  for (const auto& group : groups) distances.push_back(distances_from(centre, group));
  const double grand = mean(joined(distances));
  double between = 0.0, within = 0.0;
  for (const auto& group : distances) {
    const double deviation = mean(group) - grand;
    between += static_cast<double>(group.size()) * deviation * deviation;
    within += squared_deviations(group);
  }
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * largest_size(groups);
  if (!(within > total * rounding * rounding) || !std::isfinite(within))
    return base::fail(fmt::format(
        "{}: distances within the groups do not vary, so nothing can be tested; give more values", name));
  VarianceTest test;
  test.df = count - 1.0;
  test.error_df = total - count;
  test.statistic = between / test.df / (within / test.error_df);
  test.p = f_above(test.statistic, test.df, test.error_df);
  return test;
}

template <std::size_t N>
double polynomial(const std::array<double, N>& coefficients, double x) {
  double value = 0.0;
  for (std::size_t i = N; i-- > 0;) value = value * x + coefficients[i];
  return value;
}

// The weights of the sorted values, whose squares sum to 1: expected normal order statistics (Blom's
// approximation), the outermost one or two replaced by Royston's polynomials in 1 / sqrt(n).
std::vector<double> shapiro_weights(std::size_t count) {
  constexpr std::array kOutermost = {0.0, 0.221157, -0.147981, -2.07119, 4.434685, -2.706056};
  constexpr std::array kNext = {0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633};
  if (count == 3) return {-std::sqrt(0.5), 0.0, std::sqrt(0.5)};
  const auto n = static_cast<double>(count);
  std::vector<double> weights(count);
  double squares = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    weights[i] = normal_quantile((static_cast<double>(i) + 1.0 - 0.375) / (n + 0.25));
    squares += weights[i] * weights[i];
  }
  const double root = 1.0 / std::sqrt(n);
  const std::size_t replaced = count > 5 ? 2 : 1;
  const std::array ends = {weights[count - 1], weights[count - 2]};
  const std::array better = {ends[0] / std::sqrt(squares) + polynomial(kOutermost, root),
                             ends[1] / std::sqrt(squares) + polynomial(kNext, root)};
  double left = squares, share = 1.0;
  for (std::size_t i = 0; i < replaced; ++i) {
    left -= 2.0 * ends[i] * ends[i];
    share -= 2.0 * better[i] * better[i];
  }
  for (double& weight : weights) weight /= std::sqrt(left / share);
  for (std::size_t i = 0; i < replaced; ++i) {
    weights[count - 1 - i] = better[i];
    weights[i] = -better[i];
  }
  return weights;
}

// The p value by Royston's normalising transformations of `lack`, 1 - W.
double shapiro_p(double lack, double n) {
  if (n == 3.0) {
    const double root = std::sqrt(std::max(0.0, 1.0 - lack));
    return std::clamp(6.0 / std::numbers::pi * (std::asin(root) - std::asin(std::sqrt(0.75))), 0.0, 1.0);
  }
  double y = std::log(lack);
  if (n <= 11.0) {
    const double gamma = -2.273 + 0.459 * n;
    if (y >= gamma) return 0.0;  // less normal than possible
    y = -std::log(gamma - y);
    const double centre = polynomial(std::array{0.544, -0.39978, 0.025054, -6.714e-4}, n);
    const double spread = std::exp(polynomial(std::array{1.3822, -0.77857, 0.062767, -0.0020322}, n));
    return normal_above((y - centre) / spread);
  }
  const double log_n = std::log(n);
  const double centre = polynomial(std::array{-1.5861, -0.31082, -0.083751, 0.0038915}, log_n);
  const double spread = std::exp(polynomial(std::array{-0.4803, -0.082676, 0.0030302}, log_n));
  return normal_above((y - centre) / spread);
}

}  // namespace

base::Result<VarianceTest> levene_test(const std::vector<std::vector<double>>& groups) {
  return distance_test("Levene's test", groups, Centre::Mean);
}

base::Result<VarianceTest> brown_forsythe_test(const std::vector<std::vector<double>>& groups) {
  return distance_test("Brown-Forsythe test", groups, Centre::Median);
}

base::Result<VarianceTest> bartlett_test(const std::vector<std::vector<double>>& groups) {
  if (auto error = complaint("Bartlett's test", groups, 2)) return tl::unexpected(*error);
  double df = 0.0, squares = 0.0, logs = 0.0, inverses = 0.0;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (constant(groups[i]))
      return base::fail(fmt::format("Bartlett's test: group {} does not vary; leave it out", i + 1));
    const double own_df = static_cast<double>(groups[i].size()) - 1.0;
    df += own_df;
    squares += squared_deviations(groups[i]);
    logs += own_df * std::log(variance(groups[i]));
    inverses += 1.0 / own_df;
  }
  VarianceTest test;
  test.df = static_cast<double>(groups.size()) - 1.0;
  const double correction = 1.0 + (inverses - 1.0 / df) / (3.0 * test.df);
  test.statistic = (df * std::log(squares / df) - logs) / correction;
  if (!std::isfinite(test.statistic))
    return base::fail("Bartlett's test: the values are too large or small to square; change their unit");
  test.statistic = std::max(0.0, test.statistic);
  test.p = chi_squared_above(test.statistic, test.df);
  return test;
}

base::Result<ShapiroWilk> shapiro_wilk(std::span<const double> values) {
  if (auto error = complaint("Shapiro-Wilk test", "the sample", values, 3)) return tl::unexpected(*error);
  if (values.size() > 5000)
    return base::fail(fmt::format(
        "Shapiro-Wilk test: {} values, give at most 5000; look at a normal plot of more", values.size()));
  if (constant(values))
    return base::fail(
        "Shapiro-Wilk test: all values are equal, so nothing can be tested; look at what was measured");
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  // Deviations from the mean over half the range, so that squares keep their digits.
  const double range = 0.5 * sorted.back() - 0.5 * sorted.front();
  for (double& value : sorted) value /= range;
  const double centre = mean(sorted);
  for (double& value : sorted) value -= centre;
  const std::vector<double> weights = shapiro_weights(sorted.size());
  std::vector<double> products(sorted.size()), rests(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) products[i] = weights[i] * sorted[i];
  const double fitted = sum(products);
  // 1 - W is the rest that the line of slope `fitted` leaves, which has digits when W is near 1.
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const double rest = sorted[i] - fitted * weights[i];
    rests[i] = rest * rest;
  }
  const double lack = sum(rests) / squared_deviations(sorted);
  return ShapiroWilk{1.0 - lack, shapiro_p(lack, static_cast<double>(sorted.size()))};
}

}  // namespace icome::stats
