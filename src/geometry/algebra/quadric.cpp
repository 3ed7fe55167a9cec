#include "geometry/algebra/quadric.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/decompositions.h"

namespace icome::geometry {
namespace {

/// Eigenvalues below this part of the largest count as zero: planes that meet at less than some 3 degrees
/// do not make an edge. The square of the same limit for singular values (0.03).
constexpr double kFlat = 1e-3;

/// min over y of y'Ay - 2 b'y, with coordinates of y fixed one by one at bounds that they would leave.
struct BoxedQuadric {
  Matrix3 a = Matrix3::Zero();
  Vector3 b = Vector3::Zero();
  double drop = 0.0;  // eigenvalues up to this count as zero
  Vector3 y = Vector3::Zero();
  std::array<bool, 3> fixed = {};

  void solve_free() {
    Matrix3 reduced = a;
    Vector3 right = b;
    for (int axis = 0; axis < 3; ++axis) {
      if (!fixed[axis]) continue;
      right -= a.col(axis) * y[axis];
      reduced.row(axis).setZero();
      reduced.col(axis).setZero();
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (fixed[axis]) right[axis] = 0.0;
    }
    const base::SymmetricEigen eigen = base::symmetric_eigen(reduced);
    Vector3 free = Vector3::Zero();
    for (int i = 0; i < 3; ++i) {
      const double value = eigen.values[i];
      const Vector3 direction = eigen.vectors.col(i);
      if (value > drop) free += direction * (direction.dot(right) / value);
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (!fixed[axis]) y[axis] = free[axis];
    }
  }
};

}  // namespace

Vector3 nearest_to_planes(std::span<const SurfacePoint> planes, const Bounds& box) {
  Vector3 mean = Vector3::Zero();
  for (const SurfacePoint& plane : planes) mean += plane.point;
  mean = (mean / static_cast<double>(planes.size())).cwiseMax(box.min()).cwiseMin(box.max());

  BoxedQuadric quadric;
  for (const SurfacePoint& plane : planes) {
    quadric.a += plane.normal * plane.normal.transpose();
    quadric.b += plane.normal * plane.normal.dot(plane.point - mean);
  }
  quadric.drop = kFlat * base::symmetric_eigen(quadric.a).values[2];

  const Vector3 low = box.min() - mean, high = box.max() - mean;
  for (int round = 0; round < 3; ++round) {
    quadric.solve_free();
    const Vector3 over = (quadric.y - high).cwiseMax(low - quadric.y);
    int worst = 0;
    if (!(over.maxCoeff(&worst) > 0.0)) break;
    quadric.y[worst] = std::clamp(quadric.y[worst], low[worst], high[worst]);
    quadric.fixed[worst] = true;
  }
  return (mean + quadric.y).cwiseMax(box.min()).cwiseMin(box.max());
}

double farthest_plane(std::span<const SurfacePoint> planes, const Vector3& point) {
  double farthest = 0.0;
  for (const SurfacePoint& plane : planes) {
    farthest = std::max(farthest, std::abs(plane.normal.dot(point - plane.point)));
  }
  return farthest;
}

}  // namespace icome::geometry
