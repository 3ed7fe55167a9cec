#include "base/decompositions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <cassert>

namespace icome::base {

Quaternion rotation_between(const Vector3& from, const Vector3& to) {
  const Vector3 a = from.stableNormalized(), b = to.stableNormalized();
  if (a.isZero(0.0) || b.isZero(0.0)) return Quaternion::Identity();
  Vector3 axis = a.cross(b);
  axis -= a.dot(axis) * a;  // the part of a that rounding leaves in the axis would be felt near half a turn
  constexpr double kRounding = 1e-15;
  if (!(axis.norm() > kRounding)) axis = a.unitOrthogonal();
  // The chord and its complement are twice the sine and cosine of half the angle, exact at both ends.
  Quaternion rotation;
  rotation.w() = (a + b).norm();
  rotation.vec() = (a - b).norm() * axis.normalized();
  return rotation.normalized();
}

SymmetricEigen symmetric_eigen(const Matrix3& matrix) {
  assert(matrix.allFinite());
  const Eigen::SelfAdjointEigenSolver<Matrix3> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

SingularValues singular_values(const Matrix3& matrix) {
  assert(matrix.allFinite());
  const Eigen::JacobiSVD<Matrix3> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

}  // namespace icome::base
