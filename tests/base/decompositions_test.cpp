#include "base/decompositions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/random.h"

namespace icome::base {
namespace {

TEST(RotationBetween, TakesOneDirectionToTheOtherHoweverTheyLie) {
  Random random(7);
  for (int i = 0; i < 3000; ++i) {
    const Vector3 from = random.direction();
    // From the same direction over 1e-16 rad beside it and beside its opposite to the opposite itself.
    const double aside = std::pow(10.0, -double(i % 18));
    const Vector3 to = ((i % 2 ? -1.0 : 1.0) * from + aside * random.direction()).normalized();
    const Quaternion rotation = rotation_between(3.0 * from, 0.2 * to);
    EXPECT_NEAR(rotation.norm(), 1.0, 1e-15);
    EXPECT_LT((rotation * from - to).norm(), 2e-15) << aside;
  }
}

TEST(RotationBetween, GoesTheShortestWay) {
  const Quaternion quarter = rotation_between(Vector3::UnitX(), Vector3::UnitY());
  EXPECT_LT((quarter * Vector3::UnitZ() - Vector3::UnitZ()).norm(), 1e-15);
  EXPECT_TRUE(rotation_between(Vector3(0, 0, 2), Vector3(0, 0, 5)).isApprox(Quaternion::Identity(), 1e-15));
  const Quaternion half = rotation_between(Vector3::UnitX(), -Vector3::UnitX());
  EXPECT_NEAR(Eigen::AngleAxisd(half).angle(), std::numbers::pi, 1e-15);
  EXPECT_LT((half * Vector3::UnitX() + Vector3::UnitX()).norm(), 1e-15);
}

TEST(RotationBetween, LeavesThingsWhereThereIsNoDirection) {
  EXPECT_EQ(rotation_between(Vector3::Zero(), Vector3::UnitY()).coeffs(), Quaternion::Identity().coeffs());
  EXPECT_EQ(rotation_between(Vector3::UnitY(), Vector3::Zero()).coeffs(), Quaternion::Identity().coeffs());
}

TEST(RotationBetween, IsOfDirectionsAlsoWhereSquaresOfLengthsLeaveTheRange) {
  const Quaternion rotation = rotation_between(1e-200 * Vector3::UnitX(), 1e200 * Vector3::UnitY());
  EXPECT_LT((rotation * Vector3::UnitX() - Vector3::UnitY()).norm(), 1e-15);
}

Matrix3 random_matrix(Random& random) {
  Matrix3 matrix;
  for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = random.uniform(-1.0, 1.0);
  return matrix;
}

TEST(SymmetricEigen, IsWhatTheMatrixDoesToItsVectors) {
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    const Matrix3 any = random_matrix(random), matrix = any + any.transpose();
    const SymmetricEigen eigen = symmetric_eigen(matrix);
    EXPECT_LE(eigen.values[0], eigen.values[1]);
    EXPECT_LE(eigen.values[1], eigen.values[2]);
    EXPECT_LT((matrix * eigen.vectors - eigen.vectors * eigen.values.asDiagonal()).norm(), 1e-14);
    EXPECT_LT((eigen.vectors.transpose() * eigen.vectors - Matrix3::Identity()).norm(), 1e-14);
  }
}

TEST(SingularValues, MakeTheMatrixAgain) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    Matrix3 matrix = random_matrix(random);
    if (i % 4 == 0) matrix.col(2) = matrix.col(1);  // flat
    const SingularValues parts = singular_values(matrix);
    EXPECT_GE(parts.values[0], parts.values[1]);
    EXPECT_GE(parts.values[1], parts.values[2]);
    EXPECT_GE(parts.values[2], 0.0);
    EXPECT_LT((parts.u * parts.values.asDiagonal() * parts.v.transpose() - matrix).norm(), 1e-14);
    EXPECT_LT((parts.u.transpose() * parts.u - Matrix3::Identity()).norm(), 1e-14);
    EXPECT_LT((parts.v.transpose() * parts.v - Matrix3::Identity()).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace icome::base
