#pragma once
#include "base/vector.h"

namespace icome::session {

/// A place taken apart: a rigid part, in which things are touched, and its effect on the shape within.
/// world_from_shape = world_from_felt * felt_from_shape.
struct RigidPart {
  base::Pose world_from_felt = base::Pose::Identity();
  base::Matrix3 felt_from_shape = base::Matrix3::Identity();  // identity for a place that is rigid

  bool rigid() const { return felt_from_shape == base::Matrix3::Identity(); }
};

/// Takes a place, of finite numbers, apart. Places that turn and stretch alike but lie elsewhere give the
/// same bits for the shape's part, as do those that differ by a turn only (the polar decomposition, rounded
/// to 2^-40 of its largest entry), so that clones share what is felt. A diagonal stretch stays diagonal.
RigidPart rigid_part(const base::Affine3& world_from_shape);

/// The turn of a place without its stretch, for things of a size of their own, such as effects.
struct TurnPart {
  base::Pose world_from_turned = base::Pose::Identity();
  bool mirrored = false;  // things in the place have their own x turned round first
};

/// The turn and the mirror nearest to a place, of finite numbers: its orthogonal polar factor, so that places
/// that are nearly equal turn nearly alike.
TurnPart turn_part(const base::Affine3& world_from_object);

}  // namespace icome::session
