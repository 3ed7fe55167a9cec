#pragma once
#include <vector>

#include "drawing/curve.h"

namespace icome::drawing {

/// The motion of the disc that runs along a part of a curve.
enum class DiscMotion {
  Sweeps,   ///< it leaves a mark on both sides: its radius changes less than its centre moves
  Grows,    ///< it swallows every disc before it
  Shrinks,  ///< it stays in every disc before it
};

/// The disc at one place of a curve. Derivatives are by the length of the curve.
struct SweepingDisc {
  Vector2 centre;         ///< m
  double radius;          ///< m
  Vector2 tangent;        ///< length 1
  double radius_slope;    ///< within [-1, 1]
  double radius_bending;  ///< second derivative of the radius, 1/m
  double curvature;       ///< positive where the curve turns from x towards y, 1/m

  /// The direction from the centre to where the disc touches the rim; `side` is 1 (from x towards y as seen
  /// along the curve) or -1.
  Vector2 touching(double side) const;
  /// The sine of the angle between it and the tangent.
  double lean_sine() const;
  /// Positive where the rim runs forward, negative where the curve turns so tightly that it runs back.
  double rim_speed(double side) const;
  /// The distance from the centre at which the next spokes, the ways to the touching points, cross this one
  /// (m). Only where the rim does not run forward: it is not beyond the radius there.
  double crossing(double side) const;
};

/// A part of one segment along which the width is linear and the motion one of the three.
struct SweptPart {
  CubicBezier curve;   ///< the whole segment
  double from;         ///< t
  double to;           ///< t
  double radius;       ///< at t = 0, as if the width were linear from there, m
  double radius_by_t;  ///< m
  DiscMotion motion;

  double radius_at(double t) const;
  SweepingDisc disc_at(double t) const;
};

/// The curve in such parts, in order. Cusps are left out, and so is what is without width or, unless it is
/// wider than both neighbours, without length: places that are not farther apart than `speck` (m) count as
/// one.
std::vector<SweptPart> swept_parts(const Curve& curve, double speck);

}  // namespace icome::drawing
