#include "stats/tests/contingency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "stats/tables/count_check.h"
#include "stats/tests/binomial_test.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

std::string expected_warning(const CountTable& expected) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& row : expected) least = std::min(least, *std::min_element(row.begin(), row.end()));
  if (least >= 5.0) return {};
  return fmt::format("an expected count is {:.3g}, below 5: p is in doubt, an exact test is better", least);
}

// Chi squared of counts whose expectation is known, each difference reduced by up to `correction`.
double pearson_sum(const CountTable& counts, const CountTable& expected, double correction) {
  double sum = 0.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (std::size_t j = 0; j < counts[i].size(); ++j) {
      const double difference = std::abs(counts[i][j] - expected[i][j]);
      const double left = difference - std::min(correction, difference);
      sum += left * left / expected[i][j];
    }
  }
  return sum;
}

CountTable pearson_residuals(const CountTable& counts, const CountTable& expected) {
  CountTable residuals = counts;
  for (std::size_t i = 0; i < counts.size(); ++i)
    for (std::size_t j = 0; j < counts[i].size(); ++j)
      residuals[i][j] = (counts[i][j] - expected[i][j]) / std::sqrt(expected[i][j]);
  return residuals;
}

void judge_counts(ChiSquared& test, const CountTable& counts, double total, double correction) {
  test.chi_squared = pearson_sum(counts, test.expected, correction);
  test.p = chi_squared_above(test.chi_squared, test.df);
  test.residuals = pearson_residuals(counts, test.expected);
  test.w = std::sqrt(pearson_sum(counts, test.expected, 0.0) / total);
  test.warning = expected_warning(test.expected);
}

std::optional<base::Error> probability_complaint(std::span<const double> probabilities, std::size_t count) {
  if (probabilities.empty()) return std::nullopt;
  if (probabilities.size() != count)
    return base::Error{fmt::format("goodness of fit: {} probabilities for {} counts; give one for each",
                                   probabilities.size(), count)};
  double sum = 0.0;
  for (const double probability : probabilities) {
    if (!(probability > 0.0))
      return base::Error{"goodness of fit: every probability must be above 0; leave out what cannot happen"};
    sum += probability;
  }
  if (!(std::abs(sum - 1.0) <= 1e-8))
    return base::Error{fmt::format("goodness of fit: the probabilities sum to {}; divide each by that", sum)};
  return std::nullopt;
}

}  // namespace

base::Result<ChiSquared> goodness_of_fit(std::span<const double> counts,
                                         std::span<const double> probabilities) {
  constexpr std::string_view kName = "goodness of fit";
  if (counts.size() < 2) return base::fail("goodness of fit: give at least two counts");
  if (auto error = count_complaint(kName, counts)) return tl::unexpected(*error);
  if (auto error = probability_complaint(probabilities, counts.size())) return tl::unexpected(*error);
  const CountTable row = {{counts.begin(), counts.end()}};
  const double total = margins_of(row).total;
  if (total == 0.0) return base::fail("goodness of fit: all counts are 0; count something first");
  ChiSquared test;
  test.df = static_cast<double>(counts.size()) - 1.0;
  test.expected = row;
  for (std::size_t i = 0; i < counts.size(); ++i)
    test.expected[0][i] =
        probabilities.empty() ? total / static_cast<double>(counts.size()) : total * probabilities[i];
  judge_counts(test, row, total, 0.0);
  return test;
}

base::Result<Contingency> contingency_test(const CountTable& counts, Yates yates) {
  if (auto error = table_complaint("contingency test", counts)) return tl::unexpected(*error);
  const Margins margins = margins_of(counts);
  const auto empty = [](const std::vector<double>& sums) {
    return std::find(sums.begin(), sums.end(), 0.0) != sums.end();
  };
  if (empty(margins.rows) || empty(margins.columns))
    return base::fail("contingency test: a row or column has zeros only; leave it out");
  const auto rows = static_cast<double>(margins.rows.size());
  const auto columns = static_cast<double>(margins.columns.size());
  Contingency test;
  test.df = (rows - 1.0) * (columns - 1.0);
  test.expected = counts;
  for (std::size_t i = 0; i < margins.rows.size(); ++i)
    for (std::size_t j = 0; j < margins.columns.size(); ++j)
      test.expected[i][j] = margins.rows[i] * margins.columns[j] / margins.total;
  const bool corrects = yates == Yates::On && rows == 2.0 && columns == 2.0;
  judge_counts(test, counts, margins.total, corrects ? 0.5 : 0.0);
  test.cramers_v = std::min(1.0, test.w / std::sqrt(std::min(rows, columns) - 1.0));
  return test;
}

base::Result<McNemar> mcnemar_test(const CountTable& counts, Yates yates) {
  if (auto error = table_complaint("McNemar test", counts)) return tl::unexpected(*error);
  if (counts.size() != counts.front().size())
    return base::fail("McNemar test: the table is not square; give the same levels before and after");
  McNemar test;
  const bool two = counts.size() == 2;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    for (std::size_t j = i + 1; j < counts.size(); ++j) {
      const double changes = counts[i][j] + counts[j][i];
      if (changes == 0.0) continue;
      const double difference = std::abs(counts[i][j] - counts[j][i]);
      const double left = two && yates == Yates::On && difference > 0.0 ? difference - 1.0 : difference;
      test.chi_squared += left * left / changes;
      test.df += 1.0;
    }
  }
  if (test.df == 0.0)
    return base::fail("McNemar test: nobody changed, so nothing can be tested; look at the counts");
  test.p = chi_squared_above(test.chi_squared, test.df);
  test.exact_p = test.odds_ratio = std::numeric_limits<double>::quiet_NaN();
  if (!two) return test;
  test.odds_ratio = counts[0][1] / counts[1][0];
  const auto exact = binomial_test(counts[0][1], counts[0][1] + counts[1][0]);
  if (!exact) return tl::unexpected(exact.error());
  test.exact_p = exact->p;
  return test;
}

}  // namespace icome::stats
