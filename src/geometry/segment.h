#pragma once
#include <algorithm>
#include <array>
#include <optional>

#include "base/vector.h"

namespace icome::geometry {

/// The part [first, last] of the segment start + t * step, t in [0, 1], that lies within `reach` (m) of the
/// box along each axis separately; nothing where there is no such part, and for numbers that are not finite.
/// Real-time safe.
inline std::optional<std::array<double, 2>> part_within(const base::Bounds& box, const base::Vector3& start,
                                                        const base::Vector3& step, double reach) {
  double first = 0.0, last = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = box.min()[axis] - reach - start[axis], hi = box.max()[axis] + reach - start[axis];
    if (step[axis] == 0.0) {
      if (!(lo <= 0.0 && hi >= 0.0)) return std::nullopt;
      continue;
    }
    const double s = lo / step[axis], t = hi / step[axis];
    first = std::max(first, std::min(s, t));
    last = std::min(last, std::max(s, t));
  }
  if (!(first <= last) || !step.allFinite() || !start.allFinite()) return std::nullopt;
  return std::array<double, 2>{first, last};
}

}  // namespace icome::geometry
