#pragma once
// The cells that constraints are about, as trees of joints, while a frame is solved.
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "animation/motion/constraints.h"

namespace icome::animation {

/// A cell while it is solved. Lengths are px on the stage.
struct RigCell {
  CellId id;
  Vector2 pivot = Vector2::Zero();  ///< px in its picture
  double scale = 1;
  Vector2 place = Vector2::Zero();
  double angle = 0;
  double cosine = 1, sine = 0;  ///< of the angle

  int parent = -1;  ///< always before the cell itself; -1: it is the first of its tree
  int root = 0;     ///< the first cell of its tree
  int below = 1;    ///< cells that come along when it turns, itself included
  Vector2 pin_on_parent = Vector2::Zero();  ///< from the parent's pivot, at its angle 0
  Vector2 pin = Vector2::Zero();            ///< from the pivot, at angle 0
  double least = -std::numeric_limits<double>::infinity();
  double greatest = std::numeric_limits<double>::infinity();
  double relative = 0;  ///< its angle less the parent's, where it hangs on one
  bool keeps_angle =
      false;  ///< its angle is `kept` as far as limits allow, and does not go with the parent's
  double kept = 0;
  bool held = false;  ///< gives way last

  /// A vector from its pivot, from angle 0 to now.
  Vector2 turned(const Vector2& v) const {
    return {cosine * v.x() + sine * v.y(), cosine * v.y() - sine * v.x()};
  }
  Vector2 point(const Vector2& offset) const { return place + turned(offset); }
  Vector2 pin_place() const { return point(pin); }
  Vector2 offset_of(const PointOnCell& on_cell) const { return scale * (on_cell - pivot); }
  double limited(double turn) const { return std::max(least, std::min(greatest, turn)); }
  void set_angle(double to) {
    angle = to;
    cosine = std::cos(to);
    sine = std::sin(to);
  }
};

class Rig {
 public:
  /// Makes a rig of the cells that have both a state and a hold or a constraint. Joints that would close a
  /// ring, and second ones of a child, are left out.
  Rig(const Project& project, const CellStates& states, std::span<const Hold> holds);

  std::vector<RigCell> cells;  ///< each tree's side by side, parents first
  /// The number of a cell; -1 where it takes no part.
  int find(CellId id) const;
  /// One past the last cell of the tree that begins with `root`.
  int end_of(int root) const;

  /// Brings angles and places of a tree to what its first cell and the turns of the others say.
  void settle(int root);
  void settle_all();
  void write(CellStates& states) const;
  /// px, by which the pins of joints that were left out are apart.
  double left_out() const;

 private:
  void hang(const Project& project);
  void sort();

  struct LeftOut {
    CellId parent, child;
    PointOnCell on_parent, on_child;
  };

  std::vector<std::pair<CellId, int>> numbers_;  // by id
  std::vector<LeftOut> left_out_;
};

}  // namespace icome::animation
