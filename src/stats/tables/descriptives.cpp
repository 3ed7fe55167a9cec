#include "stats/tables/descriptives.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cassert>
#include <cmath>
#include <limits>

#include "stats/tables/cells.h"
#include "stats/tables/magnitudes.h"
#include "stats/tables/sums.h"

namespace icome::stats {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

double quantile_of_sorted(std::span<const double> sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const double rest = place - static_cast<double>(below);
  if (rest == 0.0) return sorted[below];
  return sorted[below] + rest * (sorted[below + 1] - sorted[below]);
}

std::vector<double> modes_of_sorted(std::span<const double> sorted) {
  std::vector<double> modes;
  std::size_t most = 2;
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto last = std::upper_bound(first, sorted.end(), *first);
    const auto count = static_cast<std::size_t>(last - first);
    if (count > most) {
      most = count;
      modes.clear();
    }
    if (count == most) modes.push_back(*first);
    first = last;
  }
  return modes;
}

/// The mean of the values' z scores (by the standard deviation with n) to a power.
double standardised_moment(std::span<const double> values, double centre, double spread, int power) {
  std::vector<double> powers;
  powers.reserve(values.size());
  for (const double value : values) {
    const double z = (value - centre) / spread;
    powers.push_back(power == 3 ? z * z * z : z * z * z * z);
  }
  return mean(powers);
}

void add_spread(Description& result, std::span<const double> values) {
  const auto n = static_cast<double>(result.n);
  const double squares = squared_deviations(values);
  result.variance = squares / (n - 1.0);
  result.standard_deviation = std::sqrt(result.variance);
  result.standard_error = result.standard_deviation / std::sqrt(n);
  const boost::math::students_t student(n - 1.0);
  const double half = result.standard_error * quantile(complement(student, (1.0 - result.confidence) / 2.0));
  result.mean_low = result.mean - half;
  result.mean_high = result.mean + half;
  const double spread = std::sqrt(squares / n);
  if (spread == 0.0) return;
  if (result.n > 2) {
    const double g1 = standardised_moment(values, result.mean, spread, 3);
    result.skewness = g1 * std::sqrt(n * (n - 1.0)) / (n - 2.0);
  }
  if (result.n > 3) {
    const double g2 = standardised_moment(values, result.mean, spread, 4) - 3.0;
    result.excess_kurtosis = (n - 1.0) / ((n - 2.0) * (n - 3.0)) * ((n + 1.0) * g2 + 6.0);
  }
}

/// Describes finite values, at least one, that have passed check_magnitudes().
Description described(std::vector<double> values, double confidence) {
  std::sort(values.begin(), values.end());
  Description result;
  result.n = values.size();
  result.mean = mean(values);
  result.median = quantile_of_sorted(values, 0.5);
  result.modes = modes_of_sorted(values);
  result.minimum = values.front();
  result.maximum = values.back();
  result.lower_quartile = quantile_of_sorted(values, 0.25);
  result.upper_quartile = quantile_of_sorted(values, 0.75);
  result.confidence = confidence;
  result.variance = result.standard_deviation = result.standard_error = kUndefined;
  result.skewness = result.excess_kurtosis = result.mean_low = result.mean_high = kUndefined;
  if (result.n > 1) add_spread(result, values);
  return result;
}

std::vector<double> without_missing(std::span<const double> values) {
  std::vector<double> kept;
  kept.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(kept),
               [](double v) { return !std::isnan(v); });
  return kept;
}

base::Result<void> check_describable(std::span<const double> values, double confidence) {
  if (!(confidence > 0.0 && confidence < 1.0)) {
    return base::fail(fmt::format("a confidence of {} is not between 0 and 1: give, say, 0.95", confidence));
  }
  return check_magnitudes(values);
}

}  // namespace

base::Result<Description> describe(std::span<const double> values, double confidence) {
  if (const auto fine = check_describable(values, confidence); !fine) return base::fail(fine.error().message);
  std::vector<double> kept = without_missing(values);
  if (kept.empty()) return base::fail("there are no values to describe: give at least one");
  const std::size_t missing = values.size() - kept.size();
  Description result = described(std::move(kept), confidence);
  result.missing = missing;
  return result;
}

double quantile(std::span<const double> values, double share) {
  assert(!values.empty() && share >= 0.0 && share <= 1.0);
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  return quantile_of_sorted(sorted, share);
}

base::Result<std::vector<double>> z_scores(std::span<const double> values) {
  const auto description = describe(values);
  if (!description) return base::fail(description.error().message);
  if (!(description->standard_deviation > 0.0)) {
    return base::fail("values that do not vary have no z scores: give at least two that differ");
  }
  std::vector<double> scores;
  scores.reserve(values.size());
  for (const double value : values) {
    scores.push_back((value - description->mean) / description->standard_deviation);
  }
  return scores;
}

base::Result<OutlierReport> describe_outliers(std::span<const double> values, double limit,
                                              double confidence) {
  if (!(limit > 0.0)) return base::fail("the limit for outliers is not above 0: give, say, 2");
  const auto all = describe(values, confidence);
  if (!all) return base::fail(all.error().message);
  OutlierReport report{limit, {}, *all, std::nullopt};
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double deviation = std::abs(values[i] - all->mean);
    if (deviation > limit * all->standard_deviation) {
      report.outliers.push_back(i);
    } else {
      kept.push_back(values[i]);
    }
  }
  if (report.outliers.empty() || report.outliers.size() == all->n) return report;
  const auto rest = describe(kept, confidence);
  if (!rest) return base::fail(rest.error().message);
  report.without = *rest;
  return report;
}

base::Result<std::vector<CellDescription>> describe_cells(std::span<const double> values,
                                                          std::span<const Factor> factors,
                                                          double confidence) {
  if (const auto fine = check_factors(factors, values.size()); !fine) return base::fail(fine.error().message);
  if (const auto fine = check_describable(values, confidence); !fine) return base::fail(fine.error().message);
  std::vector<std::vector<int>> combinations;
  const auto cell_of = combined_levels(factors, values.size(), combinations);
  const GroupedValues by_cell = grouped(values, cell_of, combinations.size());
  std::vector<CellDescription> result;
  for (std::size_t i = 0; i < combinations.size(); ++i) {
    std::vector<double> kept = without_missing(by_cell.group(i));
    const std::size_t missing = by_cell.group(i).size() - kept.size();
    CellDescription cell{std::move(combinations[i]), {}};
    if (!kept.empty()) cell.description = described(std::move(kept), confidence);
    cell.description.missing = missing;
    result.push_back(std::move(cell));
  }
  return result;
}

}  // namespace icome::stats
