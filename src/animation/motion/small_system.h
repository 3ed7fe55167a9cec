#pragma once
#include <cmath>
#include <cstddef>
#include <span>

namespace icome::animation {

/// Solves a symmetric positive definite system in place (Cholesky): `matrix` holds n x n values row by row
/// and is spent, `values` hold the right side and then the solution. Directions without weight are left at 0.
inline void solve_symmetric(std::span<double> matrix, std::span<double> values) {
  const std::size_t n = values.size();
  for (std::size_t i = 0; i < n; ++i) {
    double* row = &matrix[i * n];
    for (std::size_t j = 0; j <= i; ++j) {
      const double* other = &matrix[j * n];
      double sum = row[j];
      for (std::size_t k = 0; k < j; ++k) sum -= row[k] * other[k];
      if (j < i) {
        row[j] = other[j] > 0 ? sum / other[j] : 0;
      } else {
        row[i] = sum > 1e-300 ? std::sqrt(sum) : 0;
      }
    }
    double sum = values[i];
    for (std::size_t k = 0; k < i; ++k) sum -= row[k] * values[k];
    values[i] = row[i] > 0 ? sum / row[i] : 0;
  }
  for (std::size_t i = n; i-- > 0;) {
    double sum = values[i];
    for (std::size_t k = i + 1; k < n; ++k) sum -= matrix[k * n + i] * values[k];
    values[i] = matrix[i * n + i] > 0 ? sum / matrix[i * n + i] : 0;
  }
}

}  // namespace icome::animation
