#pragma once
#include <Eigen/Core>

#include "base/vector.h"

namespace icome::geometry {

// Signs of determinants, never wrong by rounding: -1, 0 or 1. First computed in doubles with an error bound,
// and only where that is inconclusive as sums of all products without rounding (Shewchuk 1997, "Adaptive
// precision floating-point arithmetic and fast robust geometric predicates"). Coordinates must have the size
// of lengths: no product of three may overflow, or fall below the smallest double. Real-time safe.

/// Does the path in the plane from `a` to `b` to `c` turn left (1) or right (-1), or run straight (0)?
int turn_sign(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

/// Is `d` on the side of the plane through `a`, `b`, `c` from which these run counter-clockwise (1), on the
/// other (-1), or in the plane (0)?
int side_sign(const base::Vector3& a, const base::Vector3& b, const base::Vector3& c, const base::Vector3& d);

}  // namespace icome::geometry
