#pragma once
#include <span>
#include <vector>

#include "geometry/curve/cubic_bezier.h"

namespace icome::drawing {

using base::Vector2;
using geometry::Bounds2;
using geometry::CubicBezier;

/// The width of a curve between two of its places: linear in t (thesis 4.8). Places along a curve are
/// counted in segments: 2.5 is the middle (t = 0.5) of the third one.
struct WidthSegment {
  double from;        ///< place along the curve
  double from_width;  ///< m
  double to;          ///< place along the curve, not before `from`
  double to_width;    ///< m

  bool operator==(const WidthSegment&) const = default;
};

/// A curve of cubic segments, each of which begins where the one before it ends, with a width all along.
/// A plain value. Width segments follow one another without a gap from place 0 to the end; none at all is a
/// line without width, of which only the fill is seen.
struct Curve {
  std::vector<CubicBezier> segments;
  std::vector<WidthSegment> widths;
  bool closed = false;  ///< its end is its start

  /// The last place: the number of segments.
  double end() const { return double(segments.size()); }
  /// The point at a place in [0, end()]. Precondition: there are segments.
  Vector2 at(double place) const;
  /// The derivative by the place.
  Vector2 derivative(double place) const;
  /// The width (m) at a place.
  double width_at(double place) const;
  /// The box of the curve without its width.
  Bounds2 bounds() const;
  double widest() const;      ///< m
  double mean_width() const;  ///< over its places, m

  bool operator==(const Curve&) const = default;
};

/// The curve from one place to a later one, places counted anew from its start, open.
Curve part_of(const Curve& curve, double from, double to);
/// The curve run through from its end.
Curve reversed(const Curve& curve);
/// The curve moved, turned and scaled; widths grow with the square root of the determinant.
Curve transformed(const Curve& curve, const Eigen::Affine2d& to_other);
/// The curve with one segment more and its shape unchanged: the one at `place` is cut there. Places at joins
/// change nothing.
Curve cut_at(const Curve& curve, double place);

}  // namespace icome::drawing
