#pragma once
#include <vector>

#include "drawing/drawing.h"

namespace icome::drawing {

/// A closed loop of cubics, each of which begins where the one before it ends.
struct OutlinePiece {
  std::vector<CubicBezier> rim;  ///< m
};

/// The area that a pen of the curve's width paints: all points within width / 2 of a point of the curve. Flat
/// ends stop at a line across the curve where it is first or last seen: through its point there or, where
/// they lie farther out, the points in which the sides touch the last disc (those of a line that becomes
/// wider or narrower touch it aslant).
///
/// All pieces filled as one path with the non-zero rule give that region, nowhere farther off than
/// `tolerance` (m, > 0). Loops may cross themselves and each other, but no point is wound around a negative
/// number of times in all, so that there are neither holes nor gaps. Mostly one piece for an open curve and
/// two (the outer and the inner rim) for a closed one; none for a line without width.
std::vector<OutlinePiece> outline_of(const Curve& curve, CurveEnds ends, double tolerance);

}  // namespace icome::drawing
