#include "stats/tables/count_check.h"

#include <fmt/format.h>

#include <cmath>

namespace icome::stats {

std::optional<base::Error> count_complaint(std::string_view test, std::span<const double> counts) {
  for (const double count : counts)
    if (!(count >= 0.0 && count <= 1e15) || count != std::floor(count))
      return base::Error{
          fmt::format("{}: a count of {} cannot be; give whole numbers from 0 to 1e15", test, count)};
  return std::nullopt;
}

std::optional<base::Error> table_complaint(std::string_view test, const CountTable& counts) {
  if (counts.size() < 2 || counts.front().size() < 2)
    return base::Error{fmt::format("{}: give a table of at least two rows and two columns", test)};
  for (const auto& row : counts) {
    if (row.size() != counts.front().size())
      return base::Error{fmt::format("{}: rows differ in length; give each as many columns", test)};
    if (auto error = count_complaint(test, row)) return error;
  }
  return std::nullopt;
}

Margins margins_of(const CountTable& counts) {
  Margins margins;
  margins.columns.assign(counts.front().size(), 0.0);
  for (const auto& row : counts) {
    margins.rows.push_back(0.0);
    for (std::size_t j = 0; j < row.size(); ++j) {
      margins.rows.back() += row[j];
      margins.columns[j] += row[j];
    }
    margins.total += margins.rows.back();
  }
  return margins;
}

}  // namespace icome::stats
