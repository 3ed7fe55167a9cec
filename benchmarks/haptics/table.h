#pragma once
#include <optional>
#include <string>
#include <vector>

#include "judge.h"
#include "measure.h"

namespace icome::benchmarks {

/// One line of the table. What does not apply stays empty.
struct Row {
  std::string figure;
  std::string unit = "us";
  std::optional<double> median = std::nullopt;  // or the only value there is
  std::optional<double> p999 = std::nullopt;
  std::optional<Quantiles> solver = std::nullopt;  // the contact stage of it
  std::optional<Quantiles> load = std::nullopt;  // with what is made ready for the next tick after the output
  std::optional<double> noise = std::nullopt;    // see BestRun
  std::optional<Faults> faults = std::nullopt;
  std::optional<double> to_reach = std::nullopt;  // by median
  std::optional<double> p999_to_reach = std::nullopt;
  std::string elsewhere = "";                    // the best open toolkit of today
  std::optional<Quantiles> ours = std::nullopt;  // what a peer is held against
};

struct Section {
  std::string title;
  std::vector<Row> rows;
};

void print_table(const std::vector<Section>& sections);
void print_json(const std::vector<Section>& sections);

/// Pops and sticks of all rows together.
Faults total_faults(const std::vector<Section>& sections);

}  // namespace icome::benchmarks
