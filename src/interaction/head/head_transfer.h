#pragma once
#include <array>
#include <numbers>

#include "base/vector.h"

namespace icome::interaction {

constexpr double kDegree = std::numbers::pi / 180.0;  // rad

/// Maps a movement of the head along or about one axis to that of the view (thesis 5.7.1, corrected). Knees
/// in m or rad, 0 <= knee1 <= knee2; slopes are not negative.
struct TransferAxis {
  double knee1 = 0.0;  // up to here quadratic, so that small movements do little
  double slope1 = 1.0;
  double knee2 = 0.0;
  double slope2 = 1.0;  // from here on

  bool operator==(const TransferAxis&) const = default;
};

/// Odd, continuous and not falling: x^2 / knee1 up to knee1, from there with slope1, from knee2 on with
/// slope2.
double transferred(double x, const TransferAxis& axis);

/// The transfer function of all six movements of a head.
struct HeadTransfer {
  std::array<TransferAxis, 3> moves;  // along x (right), y (up), z (back), m
  std::array<TransferAxis, 3> turns;  // about x, y, z, rad

  /// Table 5.4 of the thesis.
  static HeadTransfer of_thesis();

  bool operator==(const HeadTransfer&) const = default;
};

/// A rotation taken apart into turns about y, then about the x it has brought along, then about the z that
/// both have, rad: rotation = Ry(y) Rx(x) Rz(z). The turn about x is in [-pi/2, pi/2], the others in [-pi,
/// pi].
base::Vector3 turns_of(const base::Matrix3& rotation);
/// The rotation of such turns.
base::Matrix3 rotation_of(const base::Vector3& turns);

/// The movement of the view for one of the head, both from rest, in the frame of the head at rest.
base::Pose transferred(const base::Pose& rest_from_head, const HeadTransfer& transfer);

}  // namespace icome::interaction
