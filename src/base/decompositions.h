#pragma once
// Rotations and factors of small matrices. Eigen makes these from templates that take a compiler several
// seconds wherever they are used, so they are made once, in the source file.
#include "base/vector.h"

namespace icome::base {

/// The smallest rotation that takes the direction of `from` to that of `to`; half a turn about some
/// normal where they are opposite, the identity where one of them is zero. Precondition: both are
/// finite. Real-time safe.
Quaternion rotation_between(const Vector3& from, const Vector3& to);

/// The eigenvalues of a symmetric matrix in ascending order, and unit eigenvectors as the columns.
struct SymmetricEigen {
  Vector3 values;
  Matrix3 vectors;
};

/// Reads the lower triangle only. Precondition: it is finite. Real-time safe.
SymmetricEigen symmetric_eigen(const Matrix3& matrix);

/// matrix = u * diag(values) * v^T with orthonormal u and v; values in descending order, none negative.
struct SingularValues {
  Matrix3 u;
  Vector3 values;
  Matrix3 v;
};

/// Precondition: the matrix is finite. Real-time safe.
SingularValues singular_values(const Matrix3& matrix);

}  // namespace icome::base
