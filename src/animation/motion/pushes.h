#pragma once
#include <span>
#include <vector>

namespace icome::animation {

/// A row of a linear system with inequalities.
struct PushRow {
  double excess = 0;    ///< to be brought to 0
  bool is_even = true;  ///< or just to 0 or below
  bool moves = true;    ///< false: nothing does
};

/// Pushes p of rows, so that excess + matrix p is 0 where a row is even; else at most 0, with p at most 0,
/// and 0 where it is below. `matrix` is symmetric positive definite, n x n row by row, which makes them
/// unique. Block principal pivoting, and Murty's rule where that goes round in circles.
std::vector<double> pushes_of(std::span<const double> matrix, std::span<const PushRow> rows);

}  // namespace icome::animation
