#include "world_table.h"

#include <fmt/format.h>

#include <cmath>

namespace icome::benchmarks {
namespace {

constexpr const char* kLine = "{:<58} {:>7} {:>17} {:>12} {:>22} {:>34}\n";

std::string number(double value) {
  if (std::abs(value) < 10.0) return fmt::format("{:.2f}", value);
  return fmt::format("{:.{}f}", value, std::abs(value) < 100.0 ? 1 : 0);
}

std::string per_second(const WorldRow& row) {
  if (row.unit != "us" || row.value == 0.0) return {};
  return fmt::format("{:.0f}", 1e6 / row.value);
}

std::string reached(const WorldRow& row) {
  if (!row.to_reach) return {};
  const bool good = row.value <= *row.to_reach;
  return fmt::format("{} of {} {}", number(row.value / *row.to_reach), number(*row.to_reach),
                     good ? "reached" : "NOT reached");
}

std::string ratio(const WorldRow& row) {
  if (!row.times_of || *row.times_of == 0.0) return {};
  return number(row.value / *row.times_of) + " of " + row.of;
}

}  // namespace

WorldRow timed_row(const std::string& figure, const std::vector<std::int32_t>& nanoseconds) {
  const Quantiles us = quantiles_us(nanoseconds);
  return {.figure = figure, .value = us.median, .p999 = us.p999};
}

void print_table(const std::vector<WorldSection>& sections) {
  fmt::print(fmt::runtime(kLine), "figure", "unit", "median / p99.9", "per second", "to reach", "ratio");
  for (const WorldSection& section : sections) {
    fmt::print("-- {}\n", section.title);
    for (const WorldRow& row : section.rows) {
      const std::string value = number(row.value) + (row.p999 ? " / " + number(*row.p999) : "");
      fmt::print(fmt::runtime(kLine), row.figure, row.unit, value, per_second(row), reached(row), ratio(row));
    }
  }
  fmt::print(
      "\nA journalled edit survives the end of the program once it returned; one that was synced survives "
      "that "
      "the\npower goes, too: how long that takes is up to the disk under {}.\n",
      "the folder for temporary files");
}

}  // namespace icome::benchmarks
