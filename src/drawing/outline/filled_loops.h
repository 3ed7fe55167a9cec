#pragma once
#include <span>
#include <vector>

#include "drawing/curve.h"

namespace icome::drawing {

/// The rule by which lines say what lies inside of them.
enum class FillRule { NonZero, EvenOdd };

/// The likeness of an area to what was asked for.
enum class FillLikeness {
  Exact,
  StraightPieces,  ///< off by the tolerance at most
  NonZeroInstead,  ///< there are too many lines for the even-odd rule, or they cross too often
};

/// A curve without width that fills an area, and those of the lines given that it fills.
struct FilledLoops {
  Curve curve;                       ///< closed; filled by the non-zero rule
  std::vector<std::size_t> members;  ///< in ascending order
  FillLikeness likeness = FillLikeness::Exact;
};

/// The area that lines enclose together by a rule, as few curves that are filled by the non-zero rule, as
/// strokes are. Open lines are closed by a straight one. Lines whose boxes lie apart, `beside` (m) of each
/// counted in, are curves of their own, and otherwise unchanged. Others become one curve: it leads from the
/// first one to each of the others and back on the same straight way, which encloses nothing. For the
/// even-odd rule some are run through backwards; where lines cross so that this does not do, the area is made
/// of straight pieces that are off by `tolerance` (m, > 0) at most. Lines without a segment enclose nothing;
/// beyond 20,000 lines all are one curve.
std::vector<FilledLoops> filled_loops(std::span<const Curve> lines, FillRule rule, double beside,
                                      double tolerance);

}  // namespace icome::drawing
