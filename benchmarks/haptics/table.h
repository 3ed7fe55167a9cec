#pragma once
#include <optional>
#include <string>
#include <vector>

#include "judge.h"
#include "measure.h"

namespace icome::benchmarks {

/// A line of the table. Fields that do not apply stay empty.
struct Row {
  std::string figure;
  std::string unit = "us";
  std::optional<double> median = std::nullopt;  // or the only value there is
  std::optional<double> p999 = std::nullopt;
  std::optional<Quantiles> solver = std::nullopt;  // of the contact stage alone
  std::optional<Quantiles> load = std::nullopt;  // with the preparations for the next tick, after the output
  std::optional<double> noise = std::nullopt;    // see BestRun
  std::optional<Faults> faults = std::nullopt;
  std::optional<double> to_reach = std::nullopt;  // for the median
  std::optional<double> p999_to_reach = std::nullopt;
  std::string elsewhere = "";                    // the best open toolkit of today
  std::optional<Quantiles> ours = std::nullopt;  // which a peer is compared with
};

struct Section {
  std::string title;
  std::vector<Row> rows;
};

void print_table(const std::vector<Section>& sections);
void print_json(const std::vector<Section>& sections);

/// The pops and sticks of all rows together.
Faults total_faults(const std::vector<Section>& sections);

}  // namespace icome::benchmarks
