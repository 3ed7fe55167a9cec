#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "base/result.h"
#include "stats/tests/contingency.h"

namespace icome::stats {

/// An error for a count that is negative, fractional, not finite or above 1e15 (beyond which doubles skip
/// whole numbers), otherwise nothing; `test` begins the sentence.
std::optional<base::Error> count_complaint(std::string_view test, std::span<const double> counts);
/// As count_complaint() for a table, also for fewer than 2 rows or columns and for rows of different lengths.
std::optional<base::Error> table_complaint(std::string_view test, const CountTable& counts);

/// The sums of rows and columns of a table.
struct Margins {
  std::vector<double> rows, columns;
  double total = 0.0;
};
Margins margins_of(const CountTable& counts);

}  // namespace icome::stats
