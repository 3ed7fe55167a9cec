#pragma once
#include <array>
#include <cstddef>
#include <vector>

namespace icome::sketch {

/// The normal equations of least squares whose unknowns meet only near ones: a symmetric matrix that is zero
/// farther than kBand beside its diagonal, and the right side.
class BandSystem {
 public:
  static constexpr std::size_t kBand = 7;

  explicit BandSystem(std::size_t size) : rows_(size), right_(size, 0.0) {}

  std::size_t size() const { return rows_.size(); }
  void clear();
  /// Adds to the entry of row `i` and column `j`, and to its mirror image. Precondition: j <= i <= j + kBand.
  void add(std::size_t i, std::size_t j, double value) { rows_[i][i - j] += value; }
  void add_right(std::size_t i, double value) { right_[i] += value; }

  /// The solution where each diagonal entry is made larger by `damping` of itself, by Cholesky's factors.
  /// Empty where the matrix is not positive definite.
  std::vector<double> solve(double damping) const;

 private:
  using Row = std::array<double, kBand + 1>;  // the entry on the diagonal, then those left of it

  std::vector<Row> rows_;
  std::vector<double> right_;
};

}  // namespace icome::sketch
