#pragma once
#include <cmath>

#include "base/vector.h"

namespace icome::files {

/// The direction as a unit vector: unchanged where it has unit length to single precision, so that
/// reading and writing it again does not change its last digits.
inline base::Vector3 unit_as_given(const base::Vector3& direction) {
  constexpr double kRounding = 1e-6;
  if (std::abs(direction.squaredNorm() - 1.0) < kRounding) return direction;
  return direction.stableNormalized();
}

}  // namespace icome::files
