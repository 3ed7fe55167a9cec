#pragma once
#include <optional>
#include <string>
#include <vector>

#include "measure.h"

namespace icome::benchmarks {

/// A line of the table. Fields that do not apply stay empty.
struct WorldRow {
  std::string figure = {};
  std::string unit = "us";
  double value = 0.0;                         // the median, or the only value there is
  std::optional<double> p999 = std::nullopt;  // of single edits
  std::optional<double> to_reach = std::nullopt;
  std::optional<double> times_of = std::nullopt;  // a value of the same run that this is compared with
  std::string of = {};                            // name of that value
};

struct WorldSection {
  std::string title;
  std::vector<WorldRow> rows;
};

/// A row of edits that were timed one by one.
WorldRow timed_row(const std::string& figure, const std::vector<std::int32_t>& nanoseconds);

void print_table(const std::vector<WorldSection>& sections);

}  // namespace icome::benchmarks
