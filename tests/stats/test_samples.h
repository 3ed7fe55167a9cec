#pragma once
// Samples, simulated values and comparisons that the tests of differences, counts and similarities share.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "base/random.h"
#include "base/result.h"
#include "places.h"

namespace icome::stats {

using Groups = std::vector<std::vector<double>>;

inline constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kEndless = std::numeric_limits<double>::infinity();

/// Within this share of the expected value, in either direction.
inline void expect_near(double actual, double expected, double share = 1e-8) {
  if (std::isinf(expected))
    EXPECT_EQ(actual, expected);
  else
    EXPECT_NEAR(actual, expected, share * std::abs(expected));
}

/// An error whose sentence has this in it.
template <typename T>
void expect_refused(const base::Result<T>& result, const std::string& part) {
  ASSERT_FALSE(result.has_value()) << "not refused: " << part;
  EXPECT_NE(result.error().message.find(part), std::string::npos) << result.error().message;
}

/// The sleep data (R: sleep), of ten people under two drugs, hours.
inline const std::vector<double> kFirstDrug = {0.7, -1.6, -0.2, -1.2, -0.1, 3.4, 3.7, 0.8, 0.0, 2.0};
inline const std::vector<double> kSecondDrug = {1.9, 0.8, 1.1, 0.1, -0.1, 4.4, 5.5, 1.6, 4.6, 3.4};

/// Hollander and Wolfe (1973), p. 140: seconds that 22 players took to round first base in three ways.
inline const Groups kRoundingTimes = {
    {5.40, 5.50, 5.55}, {5.85, 5.70, 5.75}, {5.20, 5.60, 5.50}, {5.55, 5.50, 5.40}, {5.90, 5.85, 5.70},
    {5.45, 5.55, 5.60}, {5.40, 5.40, 5.35}, {5.45, 5.50, 5.35}, {5.25, 5.15, 5.00}, {5.85, 5.80, 5.70},
    {5.25, 5.20, 5.10}, {5.65, 5.55, 5.45}, {5.60, 5.35, 5.45}, {5.05, 5.00, 4.95}, {5.50, 5.50, 5.40},
    {5.45, 5.55, 5.50}, {5.55, 5.55, 5.35}, {5.45, 5.50, 5.55}, {5.50, 5.45, 5.25}, {5.65, 5.60, 5.40},
    {5.70, 5.65, 5.55}, {6.30, 6.30, 6.25}};

/// A column of a shared data set without quotes; empty where there is no such file.
inline std::vector<std::string> shared_column(const std::string& set, const std::string& column) {
  std::ifstream file(places::shared_data() / "stats" / set);
  std::vector<std::string> values;
  std::string line, cell;
  std::size_t wanted = std::string::npos;
  for (bool header = true; std::getline(file, line); header = false) {
    std::istringstream cells(line);
    for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
      if (!cell.empty() && cell.back() == '\r') cell.pop_back();
      if (header && cell == column) wanted = i;
      if (!header && i == wanted) values.push_back(cell);
    }
  }
  return values;
}

inline std::vector<double> shared_numbers(const std::string& set, const std::string& column) {
  std::vector<double> values;
  for (const std::string& cell : shared_column(set, column)) values.push_back(std::stod(cell));
  return values;
}

/// The values of one column by the level of another, levels in alphabetical order.
inline std::map<std::string, std::vector<double>> shared_groups(const std::string& set,
                                                                const std::string& value,
                                                                const std::string& level) {
  const std::vector<double> values = shared_numbers(set, value);
  const std::vector<std::string> levels = shared_column(set, level);
  std::map<std::string, std::vector<double>> groups;
  for (std::size_t i = 0; i < values.size(); ++i) groups[levels.at(i)].push_back(values[i]);
  return groups;
}

/// Normal values (Box and Muller 1958).
inline std::vector<double> normal_sample(base::Random& random, std::size_t count, double sd = 1.0) {
  std::vector<double> values(count);
  for (double& value : values)
    value = sd * std::sqrt(-2.0 * std::log(1.0 - random.uniform())) *
            std::cos(6.283185307179586 * random.uniform());
  return values;
}

/// How often out of `simulations` a p value is below 0.05; must be within four standard errors of `level`.
template <typename PValue>
void expect_false_positives(PValue&& p_value, double level = 0.05, int simulations = 2000) {
  int below = 0;
  for (int i = 0; i < simulations; ++i) below += p_value() < 0.05 ? 1 : 0;
  EXPECT_NEAR(static_cast<double>(below) / simulations, level,
              4.0 * std::sqrt(level * (1.0 - level) / simulations));
}

}  // namespace icome::stats
