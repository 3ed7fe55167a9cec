#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "stats/tables/factor.h"

namespace icome::benchmarks {

/// An experiment whose numbers are drawn: the same ones in every run.
struct StatsSample {
  std::vector<double> values;
  std::vector<stats::Factor> factors;
};

/// As many observations of each of ten levels.
StatsSample one_way_sample(int rows);
/// A 3 x 4 design whose cells hold different numbers of observations.
StatsSample factorial_sample(int rows);
/// Everyone in each of 3 x 4 conditions once; the first factor is the subject.
StatsSample repeated_sample(int subjects);

/// As CSV, the response first and named "y".
void write_sample(const StatsSample& sample, const std::filesystem::path& file);

/// What a CSV file or one of NIST's says: the response is the column "y", or the last.
StatsSample read_sample(const std::filesystem::path& file);

}  // namespace icome::benchmarks
