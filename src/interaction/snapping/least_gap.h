#pragma once
#include <optional>

#include "interaction/snapping/touches.h"

namespace icome::interaction {

/// The gaps between two placed shapes along parallel lines near a place, by the exact shapes. The lines'
/// direction leads from the other to the moved one there.
class GapLines {
 public:
  /// `direction` is unit, world frame; the lines are looked at within `window` (m) of the place. The shapes
  /// of the passing, at its share 0, and its effort outlive this.
  GapLines(const Passing& passing, const Vector3& place, const Vector3& direction, double window);

  struct Gap {
    double gap;           // m; negative where they overlap
    base::Vector2 slope;  // of it across the lines
    Vector3 place;        // m, world frame: where the line leads into the other
    Vector3 normal;       // unit, of the other there; world frame
  };
  /// The gap along the line that is so far beside the place (m); nothing where it misses one of the two.
  std::optional<Gap> at(const base::Vector2& beside) const;

  const Vector3& direction() const { return direction_; }

 private:
  struct Side {
    world::CollisionShape* shape;
    Affine3 shape_from_world;
  };
  struct Hit {
    double height;  // m, along the direction from the place's plane
    Vector3 normal;
  };
  std::optional<Hit> hit(const Side& side, const Vector3& middle, const Vector3& way) const;
  std::optional<Gap> within(const Vector3& middle, double window) const;

  Side moved_, other_;
  Vector3 place_, direction_;
  Eigen::Matrix<double, 3, 2> across_;  // unit, at right angles to the direction and each other
  double window_;
  world::Effort* effort_;  // may be null
};

/// The least gap between the two, downhill from the place.
struct LeastGap {
  double gap;      // m
  Vector3 place;   // m, world frame: where that line leads into the other
  Vector3 normal;  // unit, world frame: a move along it opens the gap by as much, and the quickest
};
/// `reach` (m) is about its distance from the place; `precision` (m) is that of the gap. Nothing where the
/// line through the place, and those next to it, miss one of the two.
std::optional<LeastGap> least_gap(const GapLines& lines, double reach, double precision);

}  // namespace icome::interaction
