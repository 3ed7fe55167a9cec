#pragma once
#include "geometry/curve/cubic_bezier.h"

namespace icome::geometry {

/// The place of a curve that is nearest to a point.
struct NearestOnCurve {
  double t = 0.0;
  Vector2 point = Vector2::Zero();
  double distance_squared = 0.0;  ///< m^2
};

/// The nearest place of the part [from, to] of a curve: the least distance at both ends and at all roots of
/// thesis 4.10 between them, of which there may be several. Of places that are equally near, the first.
/// Real-time safe.
NearestOnCurve nearest_on_curve(const CubicBezier& curve, const Vector2& point, double from = 0.0,
                                double to = 1.0);

/// The same; it takes less time where a place is known that is near the answer.
NearestOnCurve nearest_on_curve(const CubicBezier& curve, const Vector2& point, double from, double to,
                                double guess);

}  // namespace icome::geometry
