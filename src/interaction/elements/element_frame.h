#pragma once
#include <cmath>

#include "base/vector.h"

namespace icome::interaction {

/// The plane of an element, which turns about the vertical only (thesis 5.7.2): through `centre`, spanned by
/// the vertical and (cos alpha, 0, sin alpha). Its front is where, without a turn, the person is: +z.
struct ElementFrame {
  base::Vector3 centre = base::Vector3::Zero();  // m
  double alpha = 0.0;                            // rad

  base::Vector3 right() const { return {std::cos(alpha), 0.0, std::sin(alpha)}; }
  base::Vector3 normal() const { return {-std::sin(alpha), 0.0, std::cos(alpha)}; }

  /// Distance (m) of the point to the plane, > 0 in front. Its size is that of equation 5.2.
  double front_distance(const base::Vector3& point) const {
    return -(point.x() - centre.x()) * std::sin(alpha) + (point.z() - centre.z()) * std::cos(alpha);
  }

  /// The point's projection onto the plane, m to the right of the centre and above it: what equation 5.6
  /// (corrected) divides by half the width and height.
  base::Vector2 projected(const base::Vector3& point) const {
    return {(point.x() - centre.x()) * std::cos(alpha) + (point.z() - centre.z()) * std::sin(alpha),
            point.y() - centre.y()};
  }

  base::Vector3 in_world(const base::Vector2& place) const {
    return centre + place.x() * right() + place.y() * base::Vector3::UnitY();
  }

  /// The frame with x to the right, y up and z out of the front.
  base::Pose world_from_element() const {
    base::Pose pose = base::Pose::Identity();
    pose.linear().col(0) = right();
    pose.linear().col(1) = base::Vector3::UnitY();
    pose.linear().col(2) = normal();
    pose.translation() = centre;
    return pose;
  }
};

}  // namespace icome::interaction
