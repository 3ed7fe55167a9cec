#include "haptics/effects/reach.h"

#include <cmath>

namespace icome::haptics {
namespace {

constexpr double kParallelLines = 1e-12;  // squared sine of the angle between two lines

/// Distance between two points or lines. A line is free along its axis, so two that are not parallel are
/// apart only along their common normal.
double distance_between(const Reach& a, const Reach& b) {
  const Vector3 way = b.centre - a.centre;
  const Vector3 normal = a.axis.cross(b.axis);
  if (normal.squaredNorm() > kParallelLines) return std::abs(way.dot(normal.normalized()));
  const Vector3& axis = a.axis.isZero(0.0) ? b.axis : a.axis;
  return (way - way.dot(axis) * axis).norm();
}

}  // namespace

Reach transformed(const base::Pose& to_from_reach, const Reach& reach) {
  return {to_from_reach * reach.centre, to_from_reach.linear() * reach.axis, reach.radius};
}

bool meet(const Reach& a, const Reach& b) { return distance_between(a, b) <= a.radius + b.radius; }

}  // namespace icome::haptics
