#pragma once
#include <cmath>

#include "base/vector.h"

namespace icome::interaction {

/// The plane of an element, which turns about the vertical only (thesis 5.7.2): through `centre`, spanned by
/// the vertical and (cos alpha, 0, sin alpha). Its front is where, without a turn, the person is: +z. One
/// that pops up before an eye that looks down also leans back, by `lean`, about its own horizontal. Places in
/// the plane and distances to it are the element's metres, of which each is `size` metres of the world.
struct ElementFrame {
  base::Vector3 centre = base::Vector3::Zero();  // m, world frame
  double alpha = 0.0;                            // rad
  double lean = 0.0;                             // rad, in [-pi/2, pi/2]
  double size = 1.0;                             // > 0

  base::Vector3 right() const { return {std::cos(alpha), 0.0, std::sin(alpha)}; }
  base::Vector3 up() const {
    return {std::sin(alpha) * std::sin(lean), std::cos(lean), -std::cos(alpha) * std::sin(lean)};
  }
  base::Vector3 normal() const {
    return {-std::sin(alpha) * std::cos(lean), std::sin(lean), std::cos(alpha) * std::cos(lean)};
  }

  /// Distance of the point to the plane, > 0 in front. Its size is that of equation 5.2.
  double front_distance(const base::Vector3& point) const { return (point - centre).dot(normal()) / size; }

  /// The point's projection onto the plane, to the right of the centre and above it: what equation 5.6
  /// (corrected) divides by half the width and height.
  base::Vector2 projected(const base::Vector3& point) const {
    return base::Vector2((point - centre).dot(right()), (point - centre).dot(up())) / size;
  }

  base::Vector3 in_world(const base::Vector2& place) const {
    return centre + size * (place.x() * right() + place.y() * up());
  }

  /// The frame with x to the right, y up and z out of the front, of the world's metres.
  base::Pose world_from_element() const {
    base::Pose pose = base::Pose::Identity();
    pose.linear().col(0) = right();
    pose.linear().col(1) = up();
    pose.linear().col(2) = normal();
    pose.translation() = centre;
    return pose;
  }
};

}  // namespace icome::interaction
