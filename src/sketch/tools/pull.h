#pragma once
#include <cstdint>

#include "sketch/drawn.h"

namespace icome::sketch {

/// The way in which a curve gives way to a pen that pulls at it.
enum class PullRule : std::uint8_t {
  Thesis,  ///< the three cases of thesis 4.5.3: near its ends a joint moves, between them the two others
  Exact,   ///< all four control points, by their share in the place (4.12 divided by the sum of squares)
};

/// The curve with its point at `place` pulled by `by` (m): there it moves by that much exactly with the exact
/// rule, and with the thesis's between the ends of a segment. Neighbours keep on turning into the segment as
/// smoothly as they did. `place` in [0, end()].
Curve pulled(const Curve& curve, double place, const Vector2& by, PullRule rule);

}  // namespace icome::sketch
