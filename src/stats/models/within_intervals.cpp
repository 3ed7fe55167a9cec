#include "stats/models/within_intervals.h"

#include <algorithm>
#include <cmath>

#include "stats/tables/sample_check.h"
#include "stats/tables/sums.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

std::vector<double> column_of(const std::vector<std::vector<double>>& rows, std::size_t column) {
  std::vector<double> values;
  for (const std::vector<double>& row : rows) values.push_back(row[column]);
  return values;
}

bool finite(const std::vector<double>& row) {
  return std::ranges::all_of(row, [](double value) { return std::isfinite(value); });
}

}  // namespace

base::Result<std::vector<std::vector<double>>> without_person_differences(
    const std::vector<std::vector<double>>& rows) {
  if (rows.empty() || rows.front().size() < 2)
    return base::fail("within-subject intervals: give at least one person with two conditions.");
  const std::size_t conditions = rows.front().size();
  for (const std::vector<double>& row : rows)
    if (row.size() != conditions || !finite(row))
      return base::fail("within-subject intervals: give a finite value of every person in every condition.");
  std::vector<double> means;
  for (std::size_t i = 0; i < conditions; ++i) means.push_back(mean(column_of(rows, i)));
  const double grand = mean(means);
  const double growth = std::sqrt(double(conditions) / double(conditions - 1));
  std::vector<std::vector<double>> moved = rows;
  for (std::vector<double>& row : moved) {
    const double shift = grand - mean(row);
    for (std::size_t i = 0; i < conditions; ++i) row[i] = means[i] + growth * (row[i] + shift - means[i]);
  }
  return moved;
}

base::Result<std::vector<WithinInterval>> within_intervals(const std::vector<std::vector<double>>& rows,
                                                           double confidence) {
  if (const auto bad = confidence_complaint("within-subject intervals", confidence))
    return tl::unexpected(*bad);
  if (rows.size() < 2) return base::fail("within-subject intervals: give at least two people.");
  const auto moved = without_person_differences(rows);
  if (!moved) return tl::unexpected(moved.error());
  const double n = double(rows.size());
  const double t = t_quantile(0.5 + 0.5 * confidence, n - 1.0);
  std::vector<WithinInterval> intervals;
  for (std::size_t i = 0; i < rows.front().size(); ++i) {
    const std::vector<double> values = column_of(*moved, i);
    const double centre = mean(values), half = t * std::sqrt(variance(values) / n);
    intervals.push_back({centre, {centre - half, centre + half}});
  }
  return intervals;
}

}  // namespace icome::stats
