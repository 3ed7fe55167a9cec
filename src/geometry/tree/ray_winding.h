#pragma once
#include "geometry/tree/triangle_tree.h"

namespace icome::geometry {

/// A ray from a point along an axis of the frame, by which the winding number of a closed mesh around the
/// point is counted without any rounding: fronts that it leaves through, less backs. Triangles meet the ray
/// as if the point were moved off every edge and corner by less than any number, by the same for all
/// triangles: so one of those that share an edge counts, never both or none (simulation of simplicity,
/// Edelsbrunner and Muecke 1990). Signs are exact (exact_sign.h).
class WindingRay {
 public:
  /// The ray that leaves the box, which holds the point, soonest.
  WindingRay(const Vector3& point, const Bounds& box);

  /// A point of the ray beyond the box.
  const Vector3& end() const { return end_; }

  /// The contribution of a triangle to the winding number: 1, 0 or -1; for a point on the triangle 0, or
  /// that of a point beside it. Real-time safe.
  int through(const Corners& triangle) const;

 private:
  Eigen::Vector2d seen(const Vector3& place) const { return {place[across_[0]], place[across_[1]]}; }

  Vector3 point_;
  Vector3 end_;
  std::array<int, 2> across_{};  // the axes across the ray, which with its own are right-handed
  bool up_ = true;               // along its axis, not against it
};

}  // namespace icome::geometry
