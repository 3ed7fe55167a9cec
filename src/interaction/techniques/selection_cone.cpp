#include "interaction/techniques/selection_cone.h"

#include <cmath>

namespace icome::interaction {
namespace {

using base::Vector3;

/// A quadratic in the place t along the edge is >= 0 within the double cone.
bool cone_meets_edge(const SelectionCone& cone, const Vector3& start, const Vector3& end) {
  const double square = std::pow(std::cos(cone.half_angle), 2);
  const Vector3 from = start - cone.apex;
  const Vector3 along = end - start;
  const double start_depth = cone.direction.dot(from);
  const double rise = cone.direction.dot(along);
  const double a = rise * rise - square * along.squaredNorm();
  const double b = rise * start_depth - square * along.dot(from);
  const double c = start_depth * start_depth - square * from.squaredNorm();
  const auto within = [&](double t) { return t >= 0.0 && t <= 1.0 && start_depth + t * rise >= 0.0; };
  if (a == 0.0) return b != 0.0 && within(-0.5 * c / b);
  const double root = b * b - a * c;
  if (root < 0.0) return false;
  return within((-b + std::sqrt(root)) / a) || within((-b - std::sqrt(root)) / a);
}

bool axis_meets_triangle(const SelectionCone& cone, const std::array<Vector3, 3>& corners) {
  const Vector3 one = corners[1] - corners[0];
  const Vector3 other = corners[2] - corners[0];
  const Vector3 across = cone.direction.cross(other);
  const double volume = one.dot(across);
  if (volume == 0.0) return false;  // its edges then decide
  const Vector3 from = cone.apex - corners[0];
  const double u = from.dot(across) / volume;
  const Vector3 turned_from = from.cross(one);
  const double v = cone.direction.dot(turned_from) / volume;
  return u >= 0.0 && v >= 0.0 && u + v <= 1.0 && other.dot(turned_from) / volume >= 0.0;
}

}  // namespace

double off_axis(const SelectionCone& cone, const Vector3& point) {
  const Vector3 way = point - cone.apex;
  return std::atan2(cone.direction.cross(way).norm(), cone.direction.dot(way));
}

bool cone_meets_ball(const SelectionCone& cone, const Vector3& centre, double radius) {
  const Vector3 way = centre - cone.apex;
  const double depth = cone.direction.dot(way);
  const double aside = cone.direction.cross(way).norm();
  const double cosine = std::cos(cone.half_angle);
  const double sine = std::sin(cone.half_angle);
  if (depth * cosine + aside * sine <= 0.0) return way.norm() <= radius;  // the apex is nearest
  return aside * cosine - depth * sine <= radius;
}

bool cone_meets_triangle(const SelectionCone& cone, const std::array<Vector3, 3>& corners) {
  for (const Vector3& corner : corners)
    if (off_axis(cone, corner) <= cone.half_angle) return true;
  for (std::size_t i = 0; i < 3; ++i)
    if (cone_meets_edge(cone, corners[i], corners[(i + 1) % 3])) return true;
  return axis_meets_triangle(cone, corners);
}

}  // namespace icome::interaction
