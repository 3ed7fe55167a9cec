#pragma once
#include <array>
#include <optional>

#include "base/vector.h"

namespace icome::geometry {

using base::Bounds;
using base::Vector3;

/// A short arc of a smooth curve in space, such as an edge where two faces of a solid meet: each coordinate
/// is a polynomial of degree 8 of a parameter s in [first(), last()], part of [-1, 1]. One point, and a
/// straight line, are arcs, too. Lengths in m. A plain value.
class CurveArc {
 public:
  static constexpr int kDegree = 8;
  using Places = std::array<Vector3, kDegree + 1>;

  /// The parameters of the places through which an arc is laid: the zeros of a Chebyshev polynomial.
  static double node(int index);

  /// The arc through the places at the nodes.
  explicit CurveArc(const Places& at_nodes);
  /// The straight line from one place to another.
  CurveArc(const Vector3& from, const Vector3& to);

  double first() const { return first_; }
  double last() const { return last_; }
  /// The curve between two other parameters in [-1, 1].
  CurveArc part(double first, double last) const;

  // Real-time safe, all of them:

  Vector3 at(double s) const;
  /// The most that the arc may stray from the straight line between its ends (m).
  double sagitta() const { return sagitta(first_, last_); }
  double sagitta(double from, double to) const { return 0.125 * bend_ * (to - from) * (to - from); }
  Bounds bounds() const;
  /// The parameter of the place nearest to `point`, as found downhill from that at `from`.
  double nearest(const Vector3& point, double from) const;
  /// The parameter of the place nearest to `point`, as found downhill from the best of some places.
  double nearest(const Vector3& point) const;
  /// No place of the arc is nearer than this (m) to the segment from `a` to `b`.
  double least_distance(const Vector3& a, const Vector3& b) const;

  /// The first touch of the arc by a ball of this radius whose centre moves from `start` by t * `step`, t in
  /// [0, 1], to within `slack` (m), and never later than the true one; nothing when it does not touch, or
  /// when it touches at the start and leaves.
  struct Touch {
    double t;
    double s;
  };
  std::optional<Touch> first_touch(double radius, const Vector3& start, const Vector3& step,
                                   double slack) const;

 private:
  struct Part;
  double traced(const Part& part, double radius, const Vector3& start, const Vector3& step, double t,
                double last, double slack) const;

  std::array<Vector3, kDegree + 1> terms_;  // of s^0, s^1, ...
  double bend_;                             // no second derivative is longer
  double first_ = -1.0, last_ = 1.0;
};

/// The least distance (m) between the segments from a to b and from c to d (Ericson 2005, 5.1.9).
/// Real-time safe.
double segment_distance(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d);

}  // namespace icome::geometry
