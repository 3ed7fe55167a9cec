#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/clock.h"

namespace icome::benchmarks {

/// Median and 99.9 % quantile of some durations, in a unit that the user of it states.
struct Quantiles {
  double median = 0.0;
  double p999 = 0.0;
};

/// The nearest-rank quantiles of durations (ns; not empty), in microseconds.
Quantiles quantiles_us(std::vector<std::int32_t> nanoseconds);

double median(std::vector<double> values);

/// Repeated runs of equal work on a machine that others use, too: the one with the best p99.9 counts.
struct BestRun {
  Quantiles us;
  double noise = 1.0;     // the worst run's p99.9 over the best one's
  std::size_t index = 0;  // of the best run
};
BestRun best_run(const std::vector<std::vector<std::int32_t>>& runs);

/// Calls `query(i)` for i in [0, count) in each of `repeats` runs and times every call.
template <typename Query>
BestRun time_queries(int repeats, std::size_t count, Query&& query) {
  std::vector<std::vector<std::int32_t>> runs(repeats);
  for (std::vector<std::int32_t>& run : runs) {
    run.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::int64_t begin = base::steady_nanoseconds();
      query(i);
      run[i] = std::int32_t(base::steady_nanoseconds() - begin);
    }
  }
  return best_run(runs);
}

/// The median time of `repeats` calls of `work`, s.
template <typename Work>
double median_seconds(int repeats, Work&& work) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) {
    const std::int64_t begin = base::steady_nanoseconds();
    work();
    seconds.push_back(double(base::steady_nanoseconds() - begin) * 1e-9);
  }
  return median(std::move(seconds));
}

}  // namespace icome::benchmarks
