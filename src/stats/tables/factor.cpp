#include "stats/tables/factor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "stats/tables/magnitudes.h"

namespace icome::stats {
namespace {

/// The rows of the observations that have a value and a level of every factor.
std::vector<std::size_t> complete_rows(std::span<const double> values, std::span<const Factor> factors) {
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < values.size(); ++row) {
    bool complete = !std::isnan(values[row]);
    for (const Factor& factor : factors) complete = complete && factor.of[row] != kNoLevel;
    if (complete) rows.push_back(row);
  }
  return rows;
}

/// The factor for these rows, with only the levels that occur in them.
Factor taken(const Factor& factor, std::span<const std::size_t> rows, std::vector<std::string>& warnings) {
  std::vector<int> new_level(factor.levels.size(), kNoLevel);
  for (const std::size_t row : rows) new_level[static_cast<std::size_t>(factor.of[row])] = 0;
  Factor result{factor.name, {}, {}, factor.measured};
  for (std::size_t level = 0; level < new_level.size(); ++level) {
    if (new_level[level] == kNoLevel) {
      warnings.push_back(
          fmt::format("'{}' of '{}' has no observation and is left out.", factor.levels[level], factor.name));
      continue;
    }
    new_level[level] = static_cast<int>(result.levels.size());
    result.levels.push_back(factor.levels[level]);
  }
  result.of.reserve(rows.size());
  for (const std::size_t row : rows) {
    result.of.push_back(new_level[static_cast<std::size_t>(factor.of[row])]);
  }
  return result;
}

}  // namespace

base::Result<void> check_factors(std::span<const Factor> factors, std::size_t observations) {
  std::set<std::string> names;
  double combinations = 1.0;
  for (const Factor& factor : factors) {
    if (!names.insert(factor.name).second) {
      return base::fail(fmt::format("two factors are named '{}': give each column once", factor.name));
    }
    if (factor.of.size() != observations) {
      return base::fail(fmt::format("factor '{}' has {} rows and the values {}: give each value one level",
                                    factor.name, factor.of.size(), observations));
    }
    for (const int level : factor.of) {
      if (level != kNoLevel && (level < 0 || static_cast<std::size_t>(level) >= factor.levels.size())) {
        return base::fail(
            fmt::format("factor '{}' has no level number {}: number its levels from 0", factor.name, level));
      }
    }
    combinations *= static_cast<double>(std::max<std::size_t>(factor.levels.size(), 1));
  }
  if (combinations > 0x1p62)
    return base::fail("the factors' levels have too many combinations: leave out factors");
  return {};
}

base::Result<CompleteCases> complete_cases(std::span<const double> values, std::span<const Factor> factors) {
  if (const auto fine = check_factors(factors, values.size()); !fine) return base::fail(fine.error().message);
  if (const auto fine = check_magnitudes(values); !fine) return base::fail(fine.error().message);
  const std::vector<std::size_t> rows = complete_rows(values, factors);
  if (rows.empty()) return base::fail("no observation has a value and all its levels: give at least two");
  CompleteCases result;
  result.missing = values.size() - rows.size();
  if (result.missing > 0) {
    result.warnings.push_back(fmt::format("{} of {} observations lack a value or a level and are left out.",
                                          result.missing, values.size()));
  }
  for (const std::size_t row : rows) result.values.push_back(values[row]);
  for (const Factor& factor : factors) {
    result.factors.push_back(taken(factor, rows, result.warnings));
    if (result.factors.back().levels.size() < 2) {
      return base::fail(fmt::format("factor '{}' has only the level '{}': a comparison needs two",
                                    factor.name, result.factors.back().levels.front()));
    }
  }
  return result;
}

Factor factor_of(std::string name, std::span<const std::string> column) {
  Factor factor{std::move(name), {}, {}, false};
  factor.of.reserve(column.size());
  std::unordered_map<std::string, int> seen;
  for (const std::string& text : column) {
    if (text.empty()) {
      factor.of.push_back(kNoLevel);
      continue;
    }
    const auto [entry, fresh] = seen.try_emplace(text, static_cast<int>(factor.levels.size()));
    if (fresh) factor.levels.push_back(text);
    factor.of.push_back(entry->second);
  }
  return factor;
}

}  // namespace icome::stats
