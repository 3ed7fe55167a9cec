#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "base/vector.h"

namespace icome::geometry {

/// A quadratic program in space: the y at which y'Wy/2 + p'y is least, W positive definite, among those
/// within a few half-spaces. Active sets are tried one after the other. A plain value; real-time safe.
class SmallProgram {
 public:
  static constexpr std::size_t kMostRows = 12;

  /// normal . y <= most
  struct Row {
    base::Vector3 normal;  // unit
    double most;           // m
  };
  struct Solution {
    base::Vector3 y;
    std::array<double, kMostRows> push;  // multipliers, >= 0
  };

  void add(const Row& row) { rows_[count_++] = row; }
  std::size_t size() const { return count_; }
  const Row& row(std::size_t i) const { return rows_[i]; }

  /// `doubt` (m): the tolerance of the rows. Nothing where no place is allowed. `guess`: the solution of a
  /// program much like this one, whose active set is tried first; null: none.
  std::optional<Solution> solve(const base::Matrix3& inverse_of_w, const base::Vector3& p, double doubt,
                                const Solution* guess = nullptr) const;

 private:
  std::array<Row, kMostRows> rows_;
  std::size_t count_ = 0;
};

}  // namespace icome::geometry
