#include "stats/tables/sample_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace icome::stats {

std::optional<base::Error> complaint(std::string_view test, std::string_view what,
                                     std::span<const double> values, std::size_t least) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      return base::Error{
          fmt::format("{}: value {} of {} is not a finite number; leave it out first", test, i + 1, what)};
  if (values.size() < least)
    return base::Error{fmt::format("{}: {} has {} value{}, give at least {}", test, what, values.size(),
                                   values.size() == 1 ? "" : "s", least)};
  return std::nullopt;
}

std::optional<base::Error> complaint(std::string_view test, const std::vector<std::vector<double>>& groups,
                                     std::size_t least) {
  if (groups.size() < 2)
    return base::Error{
        fmt::format("{}: {} group{}, give at least two", test, groups.size(), groups.size() == 1 ? "" : "s")};
  for (std::size_t i = 0; i < groups.size(); ++i)
    if (auto error = complaint(test, fmt::format("group {}", i + 1), groups[i], least)) return error;
  return std::nullopt;
}

std::optional<base::Error> confidence_complaint(std::string_view test, double confidence) {
  // Closer to 1, no digits are left of 1 - confidence.
  if (confidence > 0.0 && confidence <= 1.0 - 1e-9) return std::nullopt;
  return base::Error{
      fmt::format("{}: a confidence of {} cannot be; give one above 0 and at most 1 - 1e-9, such as 0.95",
                  test, confidence)};
}

bool constant(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [&](double value) { return value == values.front(); });
}

std::vector<double> joined(const std::vector<std::vector<double>>& groups) {
  std::vector<double> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  return all;
}

}  // namespace icome::stats
