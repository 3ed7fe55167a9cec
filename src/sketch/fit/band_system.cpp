#include "sketch/fit/band_system.h"

#include <algorithm>
#include <cmath>

namespace icome::sketch {

void BandSystem::clear() {
  std::fill(rows_.begin(), rows_.end(), Row{});
  std::fill(right_.begin(), right_.end(), 0.0);
}

std::vector<double> BandSystem::solve(double damping) const {
  std::vector<Row> factor = rows_;
  std::vector<double> x = right_;
  for (std::size_t i = 0; i < factor.size(); ++i) {
    const std::size_t first = i > kBand ? i - kBand : 0;
    factor[i][0] += damping * factor[i][0];
    for (std::size_t j = first; j <= i; ++j) {
      double sum = factor[i][i - j];
      for (std::size_t k = std::max(first, j > kBand ? j - kBand : 0); k < j; ++k)
        sum -= factor[i][i - k] * factor[j][j - k];
      if (i == j) {
        if (!(sum > 0.0)) return {};
        factor[i][0] = std::sqrt(sum);
      } else {
        factor[i][i - j] = sum / factor[j][0];
      }
    }
    for (std::size_t k = first; k < i; ++k) x[i] -= factor[i][i - k] * x[k];
    x[i] /= factor[i][0];
  }
  for (std::size_t i = factor.size(); i-- > 0;) {
    x[i] /= factor[i][0];
    for (std::size_t k = i > kBand ? i - kBand : 0; k < i; ++k) x[k] -= factor[i][i - k] * x[i];
  }
  return x;
}

}  // namespace icome::sketch
