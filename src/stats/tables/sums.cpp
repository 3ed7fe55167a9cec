#include "stats/tables/sums.h"

#include <cassert>
#include <cmath>

namespace icome::stats {
namespace {

/// A sum with the rounding errors that it has lost so far.
class CompensatedSum {
 public:
  void add(double value) {
    const double next = total_ + value;
    lost_ += std::abs(total_) >= std::abs(value) ? (total_ - next) + value : (value - next) + total_;
    total_ = next;
  }
  double value() const { return total_ + lost_; }

 private:
  double total_ = 0.0;
  double lost_ = 0.0;
};

}  // namespace

double sum(std::span<const double> values) {
  CompensatedSum total;
  for (const double value : values) total.add(value);
  return total.value();
}

double mean(std::span<const double> values) {
  assert(!values.empty());
  const auto count = static_cast<double>(values.size());
  const double first = sum(values) / count;
  // The rounding error of the division shows in the deviations.
  CompensatedSum rest;
  for (const double value : values) rest.add(value - first);
  return first + rest.value() / count;
}

double squared_deviations(std::span<const double> values) {
  const double centre = mean(values);
  CompensatedSum squares, deviations;
  for (const double value : values) {
    const double deviation = value - centre;
    squares.add(deviation * deviation);
    deviations.add(deviation);
  }
  const double left = deviations.value();
  return squares.value() - left * left / static_cast<double>(values.size());
}

double variance(std::span<const double> values) {
  assert(values.size() > 1);
  return squared_deviations(values) / static_cast<double>(values.size() - 1);
}

}  // namespace icome::stats
