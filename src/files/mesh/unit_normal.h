#pragma once
#include <cmath>

#include "base/vector.h"

namespace icome::files {

/// The direction as a unit vector: as it is where it is one to single precision, so that what is read and
/// written again does not change in its last digits.
inline base::Vector3 unit_as_given(const base::Vector3& direction) {
  constexpr double kRounding = 1e-6;
  if (std::abs(direction.squaredNorm() - 1.0) < kRounding) return direction;
  return direction.stableNormalized();
}

}  // namespace icome::files
