#pragma once
#include <cmath>

#include "base/vector.h"

namespace icome::interaction {

// Transforms that turn, move and scale alike in all directions: the place of the tracked room in the world
// (which automatic scaling makes larger or smaller) and the miniature of a world.

/// The factor by which lengths grow; the linear part's determinant must be > 0.
inline double scale_of(const base::Affine3& similarity) {
  return std::cbrt(similarity.linear().determinant());
}

/// The frame of a rigid thing after a similarity: it is elsewhere and turned, but keeps its size.
inline base::Pose carried_by(const base::Affine3& similarity, const base::Pose& pose) {
  base::Pose carried = base::Pose::Identity();
  carried.linear() = similarity.linear() / scale_of(similarity) * pose.linear();
  carried.translation() = similarity * base::Vector3(pose.translation());
  return carried;
}

/// Everything made `factor` times as large as seen from a point that stays.
inline base::Affine3 scaled_about(const base::Vector3& fixed, double factor) {
  return Eigen::Translation3d(fixed) * Eigen::Scaling(factor) * Eigen::Translation3d(-fixed);
}

}  // namespace icome::interaction
