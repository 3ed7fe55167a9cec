#pragma once
#include <optional>

#include "base/function_ref.h"
#include "geometry/implicit/formula.h"

namespace icome::geometry {

/// A straight way through a formula's surface: `start` + s * `step`, s in [first, last].
struct ImplicitLine {
  base::Vector3 start, step;  // m
  double first, last;
  double time;         // s
  double slack;        // m, the tolerance of lengths
  bool from_behind;    // search for crossings out of the solid (f < 0) instead of into it
  bool starts_freely;  // at `first`, a place within `slack` of the surface counts as still in front of it
};

/// The s at which the way first goes through the surface from the front to behind it. Interval arithmetic
/// misses no crossing, however thin the solid or grazing the way, down to a tenth of `slack`. If more than
/// bounded work would be needed, the result is an s up to which there is surely no crossing.
/// Crossings that `counts(s, jump)` does not accept are passed; `jump`: f may be discontinuous or undefined
/// there. Real-time safe.
std::optional<double> first_crossing(const Formula& formula, const ImplicitLine& line,
                                     base::FunctionRef<bool(double s, bool jump)> counts);
/// The first of all crossings: all are accepted.
std::optional<double> first_crossing(const Formula& formula, const ImplicitLine& line);

}  // namespace icome::geometry
