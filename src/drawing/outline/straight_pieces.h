#pragma once
#include <algorithm>
#include <cmath>

#include "geometry/curve/cubic_bezier.h"

namespace icome::drawing {

/// The number of straight pieces, even in t, that stay within `tolerance` (m, > 0) of the cubic; a whole
/// number that may be too large for an int. A piece that is an n-th in t leaves its chord by |f''| / (8 n^2)
/// at most.
inline double straight_pieces(const geometry::CubicBezier& cubic, double tolerance) {
  const double bend = std::max(cubic.second_derivative(0.0).norm(), cubic.second_derivative(1.0).norm());
  return std::max(1.0, std::ceil(std::sqrt(bend / (8.0 * tolerance))));
}

}  // namespace icome::drawing
