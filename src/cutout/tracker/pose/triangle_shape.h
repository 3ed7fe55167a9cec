#pragma once
#include <array>
#include <cmath>

#include "cutout/tracker/tracker.h"

namespace icome::cutout {

using base::Vector2;

/// The pose of a triangle in the table's own axes (x right, y down): turned from x towards y.
struct Placed {
  Vector2 centroid = Vector2::Zero();  ///< mm
  double turn = 0;                     ///< rad, from the x axis towards the y axis, of the way to the apex
};

/// A known triangle about its centroid, its apex on the x axis. Corner 0 is the apex, edge i goes from corner
/// i to corner i + 1 with the inside at the side of its normal; edge 1 is the base.
struct TriangleShape {
  explicit TriangleShape(const KnownTriangle& triangle);

  std::array<Vector2, 3> corners;       ///< mm
  std::array<Vector2, 3> along;         ///< unit vectors from corner i to i + 1
  std::array<Vector2, 3> normals;       ///< unit vectors into the triangle
  std::array<double, 3> normal_angles;  ///< rad, of the normals
  std::array<double, 3> offsets;        ///< mm; on edge i, normals[i] . p is offsets[i], below 0
  std::array<double, 3> lengths;        ///< mm, of the edges
  std::array<double, 3> corner_angles;  ///< rad
  double circumference = 0;             ///< mm
  double reach = 0;                     ///< mm, from the centroid to the farthest corner
};

inline Vector2 turned(const Vector2& v, double cosine, double sine) {
  return {cosine * v.x() - sine * v.y(), sine * v.x() + cosine * v.y()};
}

/// An angle brought into (-pi, pi].
double within_half_turn(double angle);

TrianglePose pose_of(const Placed& placed);
Placed placed_by(const TrianglePose& pose);
std::array<Vector2, 3> corners_of(const TriangleShape& shape, const Placed& placed);
/// Distance from the place to the triangle's nearest edge, above 0 inside; less than the true one outside.
double depth_within(const TriangleShape& shape, const Placed& placed, const Vector2& place);

}  // namespace icome::cutout
