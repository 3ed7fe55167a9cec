#pragma once
#include <array>
#include <utility>

#include "base/vector.h"

namespace icome::geometry {

using base::Vector2;

/// A rectangle of the plane, empty when default-constructed.
using Bounds2 = Eigen::AlignedBox2d;

/// A cubic Bezier curve in the plane (thesis 4.1). A plain value; lengths in m, t in [0, 1].
struct CubicBezier {
  std::array<Vector2, 4> points;  ///< B1 to B4: the ends, and the control points between them

  /// A straight line as a cubic whose speed is even.
  static CubicBezier line(const Vector2& from, const Vector2& to);

  /// The place at `t`, which may lie beyond [0, 1], too. Real-time safe.
  Vector2 at(double t) const;
  /// First derivative by t. Real-time safe.
  Vector2 derivative(double t) const;
  /// Second derivative by t. Real-time safe.
  Vector2 second_derivative(double t) const;

  /// The direction (length 1) in which the curve leaves its start or comes to its end, by the first control
  /// point that differs from it; zero for a curve that is a point.
  Vector2 start_direction() const;
  Vector2 end_direction() const;

  /// Both parts of the curve, cut at `t`.
  std::pair<CubicBezier, CubicBezier> split(double t) const;
  /// The part from `from` to `to`, with from <= to.
  CubicBezier part(double from, double to) const;
  CubicBezier reversed() const;
  CubicBezier transformed(const Eigen::Affine2d& to_other) const;

  /// The box of the control points, which holds the curve. Real-time safe.
  Bounds2 hull_bounds() const;
  /// The box of the curve itself.
  Bounds2 bounds() const;
  /// Length of the part from 0 to `t`, to some 1e-9 of it unless the curve has a cusp.
  double length(double t = 1.0) const;

  bool operator==(const CubicBezier&) const = default;
};

}  // namespace icome::geometry
