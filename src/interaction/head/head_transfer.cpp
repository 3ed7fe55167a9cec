#include "interaction/head/head_transfer.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

using base::Matrix3;
using base::Vector3;

constexpr TransferAxis turn_axis(double knee1, double slope1, double knee2, double slope2) {
  return {knee1 * kDegree, slope1, knee2 * kDegree, slope2};
}

}  // namespace

double transferred(double x, const TransferAxis& axis) {
  const double size = std::abs(x);
  if (size < axis.knee1) return x * size / axis.knee1;
  const double straight = axis.knee1 + axis.slope1 * (std::min(size, axis.knee2) - axis.knee1);
  return std::copysign(straight + axis.slope2 * std::max(0.0, size - axis.knee2), x);
}

HeadTransfer HeadTransfer::of_thesis() {
  return {{{{0.12, 1.5, 0.22, 0.5}, {0.05, 3.0, 0.22, 0.1}, {0.02, 1.0, 0.22, 0.1}}},
          {{turn_axis(5.0, 0.5, 45.0, 0.1), turn_axis(5.0, 0.8, 45.0, 0.1), turn_axis(5.0, 0.2, 45.0, 0.1)}}};
}

Vector3 turns_of(const Matrix3& rotation) {
  constexpr double kUpright = 1e-12;  // cosine below which the turns about y and z are one
  const double x = std::atan2(-rotation(1, 2), std::hypot(rotation(0, 2), rotation(2, 2)));
  if (std::hypot(rotation(0, 2), rotation(2, 2)) < kUpright)
    return {x, std::atan2(-rotation(2, 0), rotation(0, 0)), 0.0};
  return {x, std::atan2(rotation(0, 2), rotation(2, 2)), std::atan2(rotation(1, 0), rotation(1, 1))};
}

Matrix3 rotation_of(const Vector3& turns) {
  return (Eigen::AngleAxisd(turns.y(), Vector3::UnitY()) * Eigen::AngleAxisd(turns.x(), Vector3::UnitX()) *
          Eigen::AngleAxisd(turns.z(), Vector3::UnitZ()))
      .toRotationMatrix();
}

base::Pose transferred(const base::Pose& rest_from_head, const HeadTransfer& transfer) {
  Vector3 moves = rest_from_head.translation(), turns = turns_of(rest_from_head.linear());
  for (int i = 0; i < 3; ++i) {
    moves[i] = transferred(moves[i], transfer.moves[std::size_t(i)]);
    turns[i] = transferred(turns[i], transfer.turns[std::size_t(i)]);
  }
  base::Pose moved = base::Pose::Identity();
  moved.linear() = rotation_of(turns);
  moved.translation() = moves;
  return moved;
}

}  // namespace icome::interaction
