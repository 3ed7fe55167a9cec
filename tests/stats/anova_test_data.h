#pragma once
// Shared data sets as columns, simulated samples and comparisons by digits, for the tests of analysis of
// variance.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/random.h"
#include "places.h"
#include "stats/tables/factor.h"

namespace icome::stats::anova_data {

inline std::filesystem::path shared_file(const std::string& name) {
  return places::shared_data() / "stats" / name;
}

/// Equal in so many significant digits.
inline void expect_digits(double actual, double expected, int digits) {
  const double error = std::abs(actual - expected) / (expected == 0.0 ? 1.0 : std::abs(expected));
  EXPECT_LE(error, std::pow(10.0, -digits)) << testing::PrintToString(actual) << " is not " << expected;
}

/// A plain CSV file (no quotes) by column name; missing cells are empty texts.
inline std::map<std::string, std::vector<std::string>> csv_columns(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::string>> columns;
  while (std::getline(file, line)) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::istringstream cells(line + ',');
    const bool header = names.empty();
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (header) {
        names.push_back(cell);
      } else {
        columns[names.at(i)].push_back(cell);
      }
    }
  }
  return columns;
}

/// A column as numbers; NaN where a cell is empty or NA.
inline std::vector<double> numbers(const std::vector<std::string>& cells) {
  std::vector<double> values;
  for (const std::string& cell : cells)
    values.push_back(cell.empty() || cell == "NA" ? NAN : std::stod(cell));
  return values;
}

/// A factor from one level an observation, of levels "0", "1", ...
inline Factor numbered(std::string name, std::vector<int> of) {
  int most = 0;
  for (const int level : of) most = std::max(most, level);
  Factor factor{std::move(name), {}, std::move(of), false};
  for (int level = 0; level <= most; ++level) factor.levels.push_back(std::to_string(level));
  return factor;
}

/// A column with these observations (counted from 0) taken out.
template <typename T>
std::vector<T> without_rows(std::vector<T> column, std::vector<std::size_t> rows) {
  for (std::size_t i = rows.size(); i-- > 0;)
    column.erase(column.begin() + static_cast<std::ptrdiff_t>(rows[i]));
  return column;
}

/// Of the standard normal distribution (Box and Muller 1958).
inline double normal_value(base::Random& random) {
  const double length = std::sqrt(-2.0 * std::log(1.0 - random.uniform()));
  return length * std::cos(6.283185307179586 * random.uniform());
}

/// The row of a table with this term.
template <typename Terms>
const auto& row_of(const Terms& terms, const std::string& name) {
  for (const auto& term : terms) {
    if (term.term == name) return term;
  }
  ADD_FAILURE() << "no term " << name;
  return terms.front();
}

/// How many of the sentences have this in them.
inline int warnings_with(const std::vector<std::string>& warnings, const std::string& part) {
  int count = 0;
  for (const std::string& warning : warnings) count += warning.find(part) != std::string::npos ? 1 : 0;
  return count;
}

/// Of 2,000 p values, whether the share below 0.05 is what chance allows: within 4 standard errors of it.
inline void expect_level(int below, double level = 0.05, int simulations = 2000) {
  const double error = std::sqrt(level * (1.0 - level) / simulations);
  EXPECT_NEAR(static_cast<double>(below) / simulations, level, 4.0 * error);
}

}  // namespace icome::stats::anova_data
