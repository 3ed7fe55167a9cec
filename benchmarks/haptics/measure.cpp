#include "measure.h"

#include <algorithm>
#include <cmath>

namespace icome::benchmarks {
namespace {

template <typename Value>
Value quantile(std::vector<Value>& values, double share) {
  const auto rank = std::size_t(std::ceil(share * double(values.size())));
  const auto place = values.begin() + std::ptrdiff_t(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

}  // namespace

Quantiles quantiles_us(std::vector<std::int32_t> nanoseconds) {
  return {quantile(nanoseconds, 0.5) * 1e-3, quantile(nanoseconds, 0.999) * 1e-3};
}

double median(std::vector<double> values) { return quantile(values, 0.5); }

BestRun best_run(const std::vector<std::vector<std::int32_t>>& runs) {
  BestRun best;
  double worst = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Quantiles us = quantiles_us(runs[i]);
    worst = std::max(worst, us.p999);
    if (i == 0 || us.p999 < best.us.p999) best = {us, 1.0, i};
  }
  best.noise = worst / best.us.p999;
  return best;
}

}  // namespace icome::benchmarks
