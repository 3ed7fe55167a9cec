#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "stats/tables/factor.h"

namespace icome::benchmarks {

/// The values of an experiment with their factors. Drawn values are equal in every run.
struct StatsSample {
  std::vector<double> values;
  std::vector<stats::Factor> factors;
};

/// A sample with as many observations of each of ten levels.
StatsSample one_way_sample(int rows);
/// A sample of a 3 x 4 design with different numbers of observations in its cells.
StatsSample factorial_sample(int rows);
/// A sample with each subject once in each of 3 x 4 conditions; the first factor is the subject.
StatsSample repeated_sample(int subjects);

/// Writes a sample as CSV, with the response first and named "y".
void write_sample(const StatsSample& sample, const std::filesystem::path& file);

/// Reads a sample from a CSV file or one of NIST's: the response is the column "y", or the last.
StatsSample read_sample(const std::filesystem::path& file);

}  // namespace icome::benchmarks
