#include "files/vrml/write/vrml_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/decompositions.h"
#include "io/number_text.h"
#include "io/single.h"

namespace icome::files {
namespace {

using base::Affine3;
using base::Matrix3;
using base::Vector3;

// Numbers below this have no effect beside one in single precision.
constexpr double kNothing = std::numeric_limits<float>::epsilon() / 4.0;
// Least advantage by which one of several equivalent forms must be better than those before it, so that
// rounding does not decide.
constexpr double kClearly = 1e-5;

constexpr double kStep = std::numbers::pi / 12.0;  // 15 degrees

/// The exact multiple of 15 degrees where single precision cannot distinguish the angle from it.
double meant_angle(float angle) {
  const double step = std::round(angle / kStep) * kStep;
  return float(step) == angle ? step : io::from_single(angle);
}

Vector3 decimals(const Eigen::Vector3f& value) {
  return {io::from_single(value.x()), io::from_single(value.y()), io::from_single(value.z())};
}

/// Rounded to the precision of Coin and others, who keep quaternions in single precision: more decimals
/// would be read back differently. Multiples of 15 degrees get more, as their exact value is known.
float lasting_angle(double angle) {
  constexpr double kDecimals = 1e6;
  // Half a turn is the limit: rounding must not go past it and back by the other way.
  if (std::fabs(angle) > std::numbers::pi - 1.0 / kDecimals) return std::numbers::pi_v<float>;
  const double step = std::round(angle / kStep) * kStep;
  if (std::fabs(angle - step) < 0.5 / kDecimals) return float(step);
  return float(std::round(angle * kDecimals) / kDecimals);
}

/// Rounded to the same decimal in all parts: readers that normalise the axis would otherwise change the
/// small ones, and another axis would be written each time.
Eigen::Vector3f lasting_axis(const Vector3& axis) {
  constexpr double kDecimals = 1e6;
  return ((axis * kDecimals).array().round() / kDecimals).cast<float>();
}

VrmlTurn turn_of(const Matrix3& rotation) {
  base::Quaternion turn(rotation);
  if (turn.w() < 0.0) turn.coeffs() = -turn.coeffs();
  const double sine = turn.vec().norm();
  if (sine == 0.0) return {};
  Vector3 axis = turn.vec() / sine;
  double angle = 2.0 * std::atan2(sine, turn.w());
  // The equivalent turn about the opposite axis is less readable.
  constexpr double kMuch = 0.4;
  int first = 0;
  while (first < 2 && std::fabs(axis[first]) < kMuch) ++first;
  if (axis[first] < 0.0) {
    axis = -axis;
    angle = -angle;
  }
  const float lasting = lasting_angle(angle);
  return lasting == 0.0F ? VrmlTurn() : VrmlTurn{lasting_axis(axis), lasting};
}

Matrix3 matrix_of(const VrmlTurn& turn) {
  if (turn.angle == 0.0F) return Matrix3::Identity();
  return Eigen::AngleAxisd(meant_angle(turn.angle), decimals(turn.axis).normalized()).toRotationMatrix();
}

/// A matrix is rotation * orientation * scale * orientation^-1.
struct Stretch {
  Matrix3 rotation;
  Vector3 scale;
  Matrix3 orientation = Matrix3::Identity();
  int axis = -1;  // the only one that differs from the others; -1: all three differ
};

/// Equal stretches leave their axes free: chooses those that turn least. False where none are equal.
bool settle_equal(Stretch& stretch) {
  constexpr double kEqual = 2.0 * std::numeric_limits<float>::epsilon();
  const Vector3 scale = stretch.scale;  // sorted
  const bool upper = scale[0] - scale[1] <= kEqual * scale[0],
             lower = scale[1] - scale[2] <= kEqual * scale[1];
  if (!upper && !lower) return false;
  if (upper && lower) {
    stretch.scale = Vector3::Constant(scale[1]);
    stretch.orientation = Matrix3::Identity();
    return true;
  }
  const int other = upper ? 2 : 0;
  const Vector3 axis = stretch.orientation.col(other);
  stretch.axis = 0;
  for (const int i : {1, 2}) {
    if (std::fabs(axis[i]) > std::fabs(axis[stretch.axis]) + kClearly) stretch.axis = i;
  }
  const double twice = upper ? 0.5 * (scale[0] + scale[1]) : 0.5 * (scale[1] + scale[2]);
  stretch.scale = Vector3::Constant(twice);
  stretch.scale[stretch.axis] = scale[other];
  const Vector3 along = axis[stretch.axis] < 0.0 ? -axis : axis;
  stretch.orientation = base::rotation_between(Vector3::Unit(stretch.axis), along).toRotationMatrix();
  return true;
}

/// Puts the axes of the stretch in the order and with the signs that turn it least.
void turn_least(Stretch& stretch) {
  std::array<int, 3> order = {0, 1, 2}, best = order;
  const Matrix3 axes = stretch.orientation;
  const Vector3 scale = stretch.scale;
  double most = -1.0;
  do {
    double along = 0.0;
    for (int i = 0; i < 3; ++i) along += std::fabs(axes(i, order[i]));
    if (along > most + kClearly) {
      most = along;
      best = order;
    }
  } while (std::next_permutation(order.begin(), order.end()));
  Matrix3& turned = stretch.orientation;
  for (int i = 0; i < 3; ++i) {
    turned.col(i) = axes(i, best[i]) < 0.0 ? Vector3(-axes.col(best[i])) : Vector3(axes.col(best[i]));
    stretch.scale[i] = scale[best[i]];
  }
  if (turned.determinant() > 0.0) return;
  int least = 0;
  turned.diagonal().minCoeff(&least);
  turned.col(least) = -turned.col(least);
}

/// Makes a rotation of one that also mirrors by mirroring along an axis of the stretch, or all of them,
/// whichever turns least.
void mirror(Stretch& stretch) {
  const Matrix3 mirrored = stretch.rotation;
  const Matrix3 axes = stretch.orientation;
  double most = -4.0;
  Vector3 best = Vector3::Ones();
  for (int axis = -1; axis < 3; ++axis) {
    if (axis >= 0 && stretch.axis >= 0 && axis != stretch.axis) continue;
    Vector3 way = Vector3::Constant(axis < 0 ? -1.0 : 1.0);
    if (axis >= 0) way[axis] = -1.0;
    const Matrix3 rotation = mirrored * axes * way.asDiagonal() * axes.transpose();
    if (rotation.trace() <= most + kClearly) continue;
    most = rotation.trace();
    best = way;
    stretch.rotation = rotation;
  }
  stretch.scale = stretch.scale.cwiseProduct(best);
}

/// Polar decomposition: the rotation is the nearest one.
Stretch stretch_of(const Matrix3& matrix) {
  const Vector3 lengths = matrix.colwise().norm();
  Stretch result{matrix * lengths.cwiseInverse().asDiagonal(), lengths};
  const Matrix3 cosines = result.rotation.transpose() * result.rotation - Matrix3::Identity();
  if (!(cosines.cwiseAbs().maxCoeff() < kNothing)) {
    const base::SingularValues parts = base::singular_values(matrix);
    result = {parts.u * parts.v.transpose(), parts.values, parts.v};
    if (!settle_equal(result)) turn_least(result);
  }
  if (result.rotation.determinant() < 0.0) mirror(result);
  return result;
}

VrmlPlace rounded(const Affine3& parent_from_object) {
  VrmlPlace frame;
  const Matrix3 matrix = parent_from_object.linear();
  const double size = matrix.cwiseAbs().maxCoeff();
  const Stretch stretch = stretch_of(matrix / size);
  for (int i = 0; i < 3; ++i) {
    frame.translation[i] = io::to_single(parent_from_object.translation()[i]);
    // A frame that was not flat must not become so.
    const double scale = stretch.scale[i] * size;
    constexpr double kLeast = std::numeric_limits<float>::min();
    frame.scale[i] = io::to_single(std::copysign(std::max(std::fabs(scale), kLeast), scale));
  }
  frame.rotation = turn_of(stretch.rotation);
  const bool even = frame.scale == Eigen::Vector3f::Constant(frame.scale.x());
  if (!even) frame.scale_orientation = turn_of(stretch.orientation);
  return frame;
}

}  // namespace

VrmlPlace vrml_place(const Affine3& parent_from_object) {
  // Rounded axes are not quite of unit length, and may round differently again: repeats until they stay.
  constexpr int kMostRounds = 16;
  VrmlPlace frame = rounded(parent_from_object);
  for (int i = 0; i < kMostRounds; ++i) {
    const VrmlPlace again = rounded(affine(frame));
    if (again == frame) break;
    frame = again;
  }
  return frame;
}

Affine3 affine(const VrmlPlace& frame) {
  const Matrix3 orientation = matrix_of(frame.scale_orientation);
  Affine3 result = Affine3::Identity();
  result.linear() =
      matrix_of(frame.rotation) * orientation * decimals(frame.scale).asDiagonal() * orientation.transpose();
  result.translation() = decimals(frame.translation);
  return result;
}

}  // namespace icome::files
