#include "geometry/tree/ray_winding.h"

#include "geometry/algebra/exact_sign.h"

namespace icome::geometry {
namespace {

/// The winding number of a triangle in the plane around a point moved a bit to the right, and much less up.
int plane_winding(const std::array<Eigen::Vector2d, 3>& corners, const Eigen::Vector2d& point) {
  int winding = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d& from = corners[i];
    const Eigen::Vector2d& to = corners[(i + 1) % 3];
    const bool from_above = from.y() > point.y(), to_above = to.y() > point.y();
    if (from_above == to_above) continue;
    // Edges that pass to the right of the point.
    const int side = turn_sign(from, to, point);
    if (to_above && side > 0) ++winding;
    if (from_above && side < 0) --winding;
  }
  return winding;
}

}  // namespace

WindingRay::WindingRay(const Vector3& point, const Bounds& box) : point_(point), end_(point) {
  const Vector3 ahead = box.max() - point, behind = point - box.min();
  int axis = 0, back_axis = 0;
  const double up = ahead.minCoeff(&axis);
  const double down = behind.minCoeff(&back_axis);
  up_ = up <= down;
  if (!up_) axis = back_axis;
  across_ = {(axis + 1) % 3, (axis + 2) % 3};
  const double beyond = 0.01 * box.sizes().maxCoeff();
  end_[axis] = up_ ? box.max()[axis] + beyond : box.min()[axis] - beyond;
}

int WindingRay::through(const Corners& triangle) const {
  const auto& [a, b, c] = triangle;
  const int winding = plane_winding({seen(a), seen(b), seen(c)}, seen(point_));
  if (winding == 0) return 0;
  // A triangle that winds to the left faces along the axis: the point is before it on its back side.
  const int side = winding * side_sign(a, b, c, point_);
  if (up_) return side < 0 ? winding : 0;
  return side > 0 ? -winding : 0;
}

}  // namespace icome::geometry
