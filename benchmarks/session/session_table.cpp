#include <fmt/format.h>

#include <algorithm>

#include "session_figures.h"

namespace icome::benchmarks {

SessionRow row_of(const std::string& figure, std::vector<double> values, const std::string& unit) {
  if (values.empty()) return {.figure = figure + ": nothing was measured", .unit = unit};
  std::sort(values.begin(), values.end());
  return {.figure = figure, .unit = unit, .median = values[values.size() / 2], .worst = values.back()};
}

void print_sections(const std::vector<SessionSection>& sections) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{:.3g}", *value) : std::string();
  };
  for (const SessionSection& section : sections) {
    fmt::print("\n{:<58} {:>8} {:>10} {:>10}\n", section.title, "median", "99.9 %", "worst");
    for (const SessionRow& row : section.rows) {
      fmt::print("  {:<56} {:>8} {:>10} {:>10} {:<6}{}\n", row.figure, number(row.median), number(row.high),
                 number(row.worst), row.unit,
                 row.times_of && *row.times_of > 0.0
                     ? fmt::format(" {:.2f} x {}", row.median / *row.times_of, row.of)
                     : std::string());
    }
  }
}

}  // namespace icome::benchmarks
