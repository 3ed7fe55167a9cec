#include "sketch_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace icome::benchmarks {
namespace {

constexpr const char* kSketchLine = "{:<58} {:>6} {:>26} {:>26} {:>16}  {}\n";

}  // namespace

std::string short_number(double value) {
  const double size = std::abs(value);
  if (value == std::floor(value) || size >= 1000.0) return fmt::format("{:.0f}", value);
  if (size < 0.001) return fmt::format("{:.1e}", value);
  return fmt::format("{:.{}f}", value, size < 10.0 ? 2 : size < 100.0 ? 1 : 0);
}

std::string median_and_p999(const Quantiles& us) {
  return fmt::format("{} / {}", short_number(us.median), short_number(us.p999));
}

std::string reached_of(double value, double limit) {
  return fmt::format("{}: {}", short_number(limit), value <= limit ? "reached" : "NOT reached");
}

std::string reached_of(const Quantiles& us, const Quantiles& limits) {
  const bool good = us.median <= limits.median && us.p999 <= limits.p999;
  return fmt::format("{}: {}", median_and_p999(limits), good ? "reached" : "NOT reached");
}

std::string spread_us(std::vector<double> us) {
  std::ranges::sort(us);
  const auto at = [&](double share) {
    const auto rank = std::size_t(std::ceil(share * double(us.size())));
    return short_number(us[std::max<std::size_t>(rank, 1) - 1]);
  };
  return fmt::format("{} / {} / {} / {}", at(0.5), at(0.99), at(0.999), at(1.0));
}

void print_section(const SketchSection& section) {
  fmt::print("\n-- {}\n", section.title);
  fmt::print(fmt::runtime(kSketchLine), "figure", "unit", "ours", "other", "ours of other", "to reach");
  for (const SketchRow& row : section.rows)
    fmt::print(fmt::runtime(kSketchLine), row.figure, row.unit, row.ours, row.other, row.ratio, row.to_reach);
  for (const std::string& note : section.notes) fmt::print("{}\n", note);
  std::fflush(stdout);
}

}  // namespace icome::benchmarks
