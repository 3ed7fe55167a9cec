#pragma once
#include <array>

#include "base/vector.h"

namespace icome::interaction {

/// A solid cone without an end: the light of a spotlight.
struct SelectionCone {
  base::Vector3 apex = base::Vector3::Zero();         // m
  base::Vector3 direction = -base::Vector3::UnitZ();  // unit
  double half_angle = 0.1;                            // rad, above 0 and below a quarter turn
};

/// The angle between the cone's axis and the way from its apex to the point, rad; 0 at the apex.
double off_axis(const SelectionCone& cone, const base::Vector3& point);

/// Does the cone meet the ball? Exact.
bool cone_meets_ball(const SelectionCone& cone, const base::Vector3& centre, double radius);

/// Does the cone meet the triangle? Exact: a corner lies within, an edge goes through, or the axis does.
bool cone_meets_triangle(const SelectionCone& cone, const std::array<base::Vector3, 3>& corners);

}  // namespace icome::interaction
