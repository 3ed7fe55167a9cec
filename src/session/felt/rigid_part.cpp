#include "session/felt/rigid_part.h"

#include <cmath>

#include "base/decompositions.h"

namespace icome::session {
namespace {

using base::Matrix3;

// Error of a turn after some products of rounded turns; far below what contact arithmetic tells apart
// (1e-10 of the scene).
constexpr double kRigid = 1e-12;
constexpr int kKeptBits = 40;

bool is_turn(const Matrix3& linear) {
  return (linear.transpose() * linear - Matrix3::Identity()).cwiseAbs().maxCoeff() < kRigid &&
         linear.determinant() > 0.0;
}

Matrix3 rounded(const Matrix3& matrix) {
  const double largest = matrix.cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return matrix;
  const double step = std::ldexp(1.0, std::ilogb(largest) - kKeptBits);
  // Zero plus: entries are never -0, which has other bits.
  return matrix.unaryExpr([step](double entry) { return std::round(entry / step) * step + 0.0; });
}

bool is_diagonal(const Matrix3& matrix) { return Matrix3(matrix.diagonal().asDiagonal()) == matrix; }

}  // namespace

RigidPart rigid_part(const base::Affine3& world_from_shape) {
  const Matrix3 linear = world_from_shape.linear();
  RigidPart part;
  part.world_from_felt.translation() = world_from_shape.translation();
  if (is_turn(linear)) {
    part.world_from_felt.linear() = linear;
  } else if (is_diagonal(linear)) {
    part.felt_from_shape = rounded(linear);
  } else {
    const base::SingularValues parts = base::singular_values(linear);
    const Matrix3 turn = parts.u * parts.v.transpose();
    const double side = turn.determinant() < 0.0 ? -1.0 : 1.0;  // a mirror is no turn: it goes to the shape
    part.world_from_felt.linear() = side * turn;
    part.felt_from_shape = rounded(side * parts.v * parts.values.asDiagonal() * parts.v.transpose());
  }
  return part;
}

TurnPart turn_part(const base::Affine3& world_from_object) {
  TurnPart part;
  part.world_from_turned.translation() = world_from_object.translation();
  Matrix3 turn = world_from_object.linear();
  if (!is_turn(turn)) {
    const base::SingularValues parts = base::singular_values(turn);
    turn = parts.u * parts.v.transpose();
  }
  part.mirrored = turn.determinant() < 0.0;
  if (part.mirrored) turn.col(0) *= -1.0;
  part.world_from_turned.linear() = turn;
  return part;
}

}  // namespace icome::session
