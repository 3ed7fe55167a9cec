#pragma once
#include <span>

#include "geometry/curve/cubic_bezier.h"

namespace icome::sketch {

using base::Vector2;
using geometry::CubicBezier;

/// A distance that is certainly no less than the greatest distance between a line of straight pieces and one
/// cubic that stands for it, both ways: from every place of the line to the cubic, and from every place of
/// the cubic to the line. Both are run through together, so it may be well above the true one where they run
/// differently. It allows itself some `resolution` (> 0) more. Infinite where a number is not finite.
double certified_distance(std::span<const Vector2> line, const CubicBezier& cubic, double resolution);

/// The greatest distance between a line of straight pieces and a curve, both ways (that of Hausdorff): never
/// less than the true one and at most `resolution` (> 0) more. Looks at all of the curve for every place of
/// the line, and the other way round, so it takes longer than certified_distance(). Precondition: all is
/// finite.
double greatest_distance(std::span<const Vector2> line, std::span<const CubicBezier> curve,
                         double resolution);

}  // namespace icome::sketch
