#pragma once
#include <optional>

#include "geometry/curve/cubic_bezier.h"
#include "sketch/fit/stroke_path.h"

namespace icome::sketch {

using geometry::CubicBezier;

/// A cubic beside a part of a path.
struct CubicFit {
  CubicBezier curve;
  double error = 0.0;  ///< the greatest distance of the places of the path that were looked at
};

/// The cubic with its ends on the path at the lengths `from` and `to` whose two other control points bring it
/// nearest to the path between: first by least squares with t by length (thesis 4.3 to 4.7, as integrals
/// along the path), then with each place's own t and the greatest distances weighing most, until the error is
/// `enough` or no longer falls.
CubicFit fit_cubic(const StrokePath& path, double from, double to, double enough);

/// Integrals along a line of straight pieces, from which the least-squares cubic follows in constant time: of
/// s^k P(s) for k = 0 to 3. They do for t by length what the sums of thesis 4.7 do.
class CurveMoments {
 public:
  /// Continues with a straight piece whose ends lie `s_from` and `s_to` along the line.
  void add(const Vector2& from, double s_from, const Vector2& to, double s_to);

  /// The least-squares cubic from B1 = start to B4 = end over [0, length] of the line; with `tangent` (length
  /// 1) it leaves its start that way. A line without length gives a cubic that is a point.
  CubicBezier cubic(const Vector2& start, const Vector2& end, double length,
                    const std::optional<Vector2>& tangent) const;

 private:
  std::array<Vector2, 4> moments_ = {Vector2::Zero(), Vector2::Zero(), Vector2::Zero(), Vector2::Zero()};
};

/// The t near `guess` at which the curve is nearest to the point, by a step of Newton's method that stays
/// within [0, 1].
double nearer_t(const CubicBezier& curve, const Vector2& point, double guess);

}  // namespace icome::sketch
