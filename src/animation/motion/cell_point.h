#pragma once
#include <cmath>

#include "animation/project/project.h"

namespace icome::animation {

/// A vector of the stage (y down) turned counter-clockwise as seen by `angle`, rad.
inline Vector2 turned(const Vector2& vector, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * vector.x() + s * vector.y(), c * vector.y() - s * vector.x()};
}

/// The angle of a direction on the stage (y down): rad, counter-clockwise as seen, 0 to the right, in
/// (-pi, pi]; 0 of no direction.
inline double angle_of(const Vector2& direction) { return std::atan2(-direction.y(), direction.x()); }

/// `angle` and full turns, so that it lies within half a turn of `near`, rad.
inline double unwrapped(double angle, double near) { return near + std::remainder(angle - near, 2 * M_PI); }

/// The place on the stage of a point of a cell that lies so, px.
inline Vector2 point_on_stage(const Cell& cell, const CellState& state, const PointOnCell& point) {
  return state.place + turned(state.scale * (point - cell.pivot), state.angle);
}

/// The point of a cell that lies so at a place on the stage; its pivot with a scale of 0.
inline PointOnCell point_on_cell(const Cell& cell, const CellState& state, const Vector2& place) {
  if (state.scale == 0) return cell.pivot;
  return cell.pivot + turned(place - state.place, -state.angle) / state.scale;
}

}  // namespace icome::animation
