#pragma once
#include <Eigen/Core>

#include "base/vector.h"

namespace icome::files {

/// An axis and an angle (rad) as VRML 2.0 keeps them.
struct VrmlTurn {
  Eigen::Vector3f axis = Eigen::Vector3f::UnitZ();
  float angle = 0.0F;

  bool operator==(const VrmlTurn&) const = default;
};

/// The fields of a Transform node: what is in it is stretched along the axes of `scale_orientation`, then
/// turned, then moved (VRML 2.0, 6.52).
struct VrmlPlace {
  Eigen::Vector3f translation = Eigen::Vector3f::Zero();
  VrmlTurn rotation = {};
  Eigen::Vector3f scale = Eigen::Vector3f::Ones();
  VrmlTurn scale_orientation = {};

  bool operator==(const VrmlPlace&) const = default;
};

/// The fields that say where an object is, for any affine transform that does not flatten. Turns are told to
/// six decimals, since readers keep no more of them (Coin: quaternions of single precision); the rest is
/// within single precision. The fields of what they say are the same again, to the last bit.
VrmlPlace vrml_place(const base::Affine3& parent_from_object);

/// What the fields say, by the decimals that they are written as.
base::Affine3 affine(const VrmlPlace& frame);

}  // namespace icome::files
