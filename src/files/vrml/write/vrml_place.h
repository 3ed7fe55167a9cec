#pragma once
#include <Eigen/Core>

#include "base/vector.h"

namespace icome::files {

/// An axis and an angle (rad) in the precision of VRML 2.0.
struct VrmlTurn {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();
  float angle = 0.0F;

  bool operator==(const VrmlTurn&) const = default;
};

/// The fields of a Transform node: its content is stretched along the axes of `scale_orientation`, then
/// turned, then moved (VRML 2.0, 6.52).
struct VrmlPlace {
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  VrmlTurn rotation = {};
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
  VrmlTurn scale_orientation = {};

  bool operator==(const VrmlPlace&) const = default;
};

/// The fields for the place of an object, for any affine transform that does not flatten. Turns have six
/// decimals, since readers keep no more of them (Coin: quaternions of single precision); the rest is within
/// single precision. The fields of their affine() are the same again, to the last bit.
VrmlPlace vrml_place(const base::Affine3& parent_from_object);

/// The transform of the fields, by the decimals that they are written with.
base::Affine3 affine(const VrmlPlace& frame);

}  // namespace icome::files
