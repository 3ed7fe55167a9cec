#include "stats/tables/cells.h"

#include <algorithm>
#include <cstdint>
#include <unordered_map>

#include "stats/tables/sums.h"

namespace icome::stats {
namespace {

/// The combination as one number, with levels as digits, the last one lowest; -1 where a level is missing.
std::int64_t combination_number(std::span<const Factor> factors, std::size_t row) {
  std::int64_t number = 0;
  for (const Factor& factor : factors) {
    if (factor.of[row] == kNoLevel) return -1;
    number = number * static_cast<std::int64_t>(factor.levels.size()) + factor.of[row];
  }
  return number;
}

std::vector<int> levels_of_number(std::span<const Factor> factors, std::int64_t number) {
  std::vector<int> levels(factors.size());
  for (std::size_t i = factors.size(); i-- > 0;) {
    const auto count = static_cast<std::int64_t>(factors[i].levels.size());
    levels[i] = static_cast<int>(number % count);
    number /= count;
  }
  return levels;
}

}  // namespace

std::vector<int> combined_levels(std::span<const Factor> factors, std::size_t observations,
                                 std::vector<std::vector<int>>& combinations) {
  std::vector<std::int64_t> numbers(observations);
  std::unordered_map<std::int64_t, int> index_of;
  for (std::size_t row = 0; row < observations; ++row) {
    numbers[row] = combination_number(factors, row);
    if (numbers[row] >= 0) index_of.try_emplace(numbers[row], 0);
  }
  std::vector<std::int64_t> occurring;
  for (const auto& [number, index] : index_of) occurring.push_back(number);
  std::sort(occurring.begin(), occurring.end());
  for (std::size_t i = 0; i < occurring.size(); ++i) {
    index_of[occurring[i]] = static_cast<int>(i);
    combinations.push_back(levels_of_number(factors, occurring[i]));
  }
  std::vector<int> result(observations, kNoLevel);
  for (std::size_t row = 0; row < observations; ++row) {
    if (numbers[row] >= 0) result[row] = index_of.find(numbers[row])->second;
  }
  return result;
}

GroupedValues grouped(std::span<const double> values, std::span<const int> group_of, std::size_t groups) {
  GroupedValues result;
  result.starts.assign(groups + 1, 0);
  for (const int group : group_of) {
    if (group != kNoLevel) ++result.starts[static_cast<std::size_t>(group) + 1];
  }
  for (std::size_t i = 0; i < groups; ++i) result.starts[i + 1] += result.starts[i];
  result.values.resize(result.starts.back());
  std::vector<std::size_t> next = result.starts;
  for (std::size_t row = 0; row < values.size(); ++row) {
    if (group_of[row] == kNoLevel) continue;
    result.values[next[static_cast<std::size_t>(group_of[row])]++] = values[row];
  }
  return result;
}

Cells summed_to_cells(const CompleteCases& cases) {
  Cells result;
  result.centre = mean(cases.values);
  std::vector<std::vector<int>> combinations;
  const std::vector<int> cell_of = combined_levels(cases.factors, cases.values.size(), combinations);
  GroupedValues by_cell = grouped(cases.values, cell_of, combinations.size());
  // Subtraction is exact for values within a factor of two of the centre, where digits are short.
  for (double& value : by_cell.values) value -= result.centre;
  for (std::size_t i = 0; i < combinations.size(); ++i) {
    const std::span<const double> values = by_cell.group(i);
    result.cells.push_back(
        {std::move(combinations[i]), values.size(), mean(values), squared_deviations(values)});
  }
  return result;
}

}  // namespace icome::stats
