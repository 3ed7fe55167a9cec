#pragma once
// The vector and pose types that every folder shares. SI units: metres, newtons, seconds, radians.
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace icome::base {

using Vector2 = Eigen::Vector2d;
using Vector3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;
using Quaternion = Eigen::Quaterniond;
/// A rigid transform. Variables read `world_from_object`; neighbours match when multiplied.
using Pose = Eigen::Isometry3d;
/// A transform that may also stretch, shear and mirror; named like a Pose.
using Affine3 = Eigen::Affine3d;
/// An axis-aligned box, empty when default-constructed; grows with extend().
using Bounds = Eigen::AlignedBox3d;

}  // namespace icome::base
