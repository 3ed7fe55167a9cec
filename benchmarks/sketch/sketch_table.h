#pragma once
#include <string>
#include <vector>

#include "measure.h"

namespace icome::benchmarks {

/// A line of the table. Fields that do not apply stay empty.
struct SketchRow {
  std::string figure = {};
  std::string unit = {};
  std::string ours = {};
  std::string other = {};     // the peer's or the naive way's
  std::string ratio = {};     // ours of it
  std::string to_reach = {};  // and whether it is
};

struct SketchSection {
  std::string title;
  std::vector<SketchRow> rows;
  std::vector<std::string> notes = {};  // lines below the rows
};

/// Three digits, or all before the point.
std::string short_number(double value);
std::string median_and_p999(const Quantiles& us);
/// `value` of `limit`, and whether it is not above.
std::string reached_of(double value, double limit);
/// Both of a median and a p99.9.
std::string reached_of(const Quantiles& us, const Quantiles& limits);
/// Values (not empty) as a row tells them: median / p99 / p99.9 / max.
std::string spread_us(std::vector<double> us);

void print_section(const SketchSection& section);

}  // namespace icome::benchmarks
