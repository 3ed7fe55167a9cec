#pragma once
#include <optional>
#include <variant>
#include <vector>

#include "base/vector.h"
#include "world/id.h"

namespace icome::animation {

using base::Vector2;

struct Cell;
struct Layer;
struct Constraint;
using CellId = world::Id<Cell>;
using LayerId = world::Id<Layer>;
using ConstraintId = world::Id<Constraint>;

/// A point that a cell takes along: px in its first picture, from the upper left corner, as its pivot is.
using PointOnCell = Vector2;

/// Least and greatest turn, rad.
struct AngleLimits {
  double least = 0, greatest = 0;

  bool operator==(const AngleLimits&) const = default;
};

/// Keeps two points between a least and a greatest distance (thesis 3.4.7).
struct DistanceLimit {
  CellId one, other;
  PointOnCell on_one = Vector2::Zero(), on_other = Vector2::Zero();
  double least = 0, greatest = 0;  ///< px on the stage

  bool operator==(const DistanceLimit&) const = default;
};

/// Pins a point of `child` to one of `parent`, about which it turns. A cell is the child of one joint at
/// most, and never its own ancestor.
struct Joint {
  CellId parent, child;
  PointOnCell on_parent = Vector2::Zero(), on_child = Vector2::Zero();
  std::optional<AngleLimits> limits = std::nullopt;  ///< of the child's angle less the parent's

  bool operator==(const Joint&) const = default;
};

/// Cells that are joined one to the next, the root first. Who takes the last one moves the others, so that it
/// comes to the hand (inverse kinematics); without a chain a held cell turns at its joint only, and takes
/// along what hangs on it.
struct Chain {
  std::vector<CellId> cells;  ///< two at least; each is the parent of the next by a joint

  bool operator==(const Chain&) const = default;
};

/// Keeps a point of a cell on a line of straight pieces.
struct PathGuide {
  CellId cell;
  PointOnCell on_cell = Vector2::Zero();
  std::vector<Vector2> way;  ///< px on the stage; two places at least
  bool closed = false;
  bool turns =
      false;  ///< the cell's angle is that of the path, as it was when the path was straight to the right

  bool operator==(const PathGuide&) const = default;
};

/// Keeps a point of a cell on a straight line without ends.
struct AxisGuide {
  CellId cell;
  PointOnCell on_cell = Vector2::Zero();
  Vector2 through = Vector2::Zero();  ///< px on the stage
  double direction = 0;               ///< rad, counter-clockwise as seen, 0 to the right

  bool operator==(const AxisGuide&) const = default;
};

/// A relation between cells that holds at every frame and under every hand.
struct Constraint {
  ConstraintId id;
  std::variant<DistanceLimit, Joint, Chain, PathGuide, AxisGuide> what;

  bool operator==(const Constraint&) const = default;
};

/// The cells that a constraint is about, in its order.
std::vector<CellId> cells_of(const Constraint& constraint);

}  // namespace icome::animation
