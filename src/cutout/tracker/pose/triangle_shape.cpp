#include "cutout/tracker/pose/triangle_shape.h"

#include <algorithm>
#include <numbers>

namespace icome::cutout {

TriangleShape::TriangleShape(const KnownTriangle& triangle) {
  const double half_base = triangle.height / std::tan(triangle.base_angle);
  corners = {Vector2(2 * triangle.height / 3, 0), Vector2(-triangle.height / 3, half_base),
             Vector2(-triangle.height / 3, -half_base)};
  corner_angles = {std::numbers::pi - 2 * triangle.base_angle, triangle.base_angle, triangle.base_angle};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vector2 way = corners[(i + 1) % 3] - corners[i];
    lengths[i] = way.norm();
    along[i] = way / lengths[i];
    normals[i] = {-along[i].y(), along[i].x()};
    normal_angles[i] = std::atan2(normals[i].y(), normals[i].x());
    offsets[i] = normals[i].dot(corners[i]);
    circumference += lengths[i];
    reach = std::max(reach, corners[i].norm());
  }
}

double within_half_turn(double angle) {
  const double turns = std::remainder(angle, 2 * std::numbers::pi);
  return turns <= -std::numbers::pi ? std::numbers::pi : turns;
}

TrianglePose pose_of(const Placed& placed) { return {placed.centroid, within_half_turn(-placed.turn)}; }

Placed placed_by(const TrianglePose& pose) { return {pose.centroid, -pose.angle}; }

std::array<Vector2, 3> corners_of(const TriangleShape& shape, const Placed& placed) {
  const double cosine = std::cos(placed.turn), sine = std::sin(placed.turn);
  std::array<Vector2, 3> corners;
  for (std::size_t i = 0; i < 3; ++i) corners[i] = placed.centroid + turned(shape.corners[i], cosine, sine);
  return corners;
}

std::array<Vector2, 3> corners_of(const KnownTriangle& triangle, const TrianglePose& pose) {
  const std::array<Vector2, 3> corners = corners_of(TriangleShape(triangle), placed_by(pose));
  return {corners[0], corners[2], corners[1]};
}

double depth_within(const TriangleShape& shape, const Placed& placed, const Vector2& place) {
  const Vector2 own = turned(place - placed.centroid, std::cos(placed.turn), -std::sin(placed.turn));
  double depth = shape.normals[0].dot(own) - shape.offsets[0];
  for (std::size_t i = 1; i < 3; ++i) depth = std::min(depth, shape.normals[i].dot(own) - shape.offsets[i]);
  return depth;
}

}  // namespace icome::cutout
