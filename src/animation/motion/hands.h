#pragma once
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "animation/motion/constraints.h"
#include "animation/motion/one_euro.h"

namespace icome::animation {

/// The table on the stage: all of it is on the stage, in the middle, as large as can be, and lies as it does.
struct TableMap {
  double scale = 1;                  ///< px of the stage for a mm
  Vector2 corner = Vector2::Zero();  ///< px, of the table's upper left corner

  /// Width and height of the table, mm, above 0.
  static TableMap fitting(double table_width, double table_height, const Stage& stage);

  Vector2 to_stage(const Vector2& mm) const { return corner + scale * mm; }
  Vector2 to_table(const Vector2& px) const { return (px - corner) / scale; }
};

/// A triangle that lies on the table.
struct TriangleOnTable {
  std::string id;                   ///< in the known list
  Vector2 place = Vector2::Zero();  ///< mm, of its centroid, from the table's upper left corner, y down
  double angle = 0;                 ///< rad, counter-clockwise as seen, of its apex; 0 to the right
  double confidence = 1;            ///< 0 to 1
};

struct HandSettings {
  double least_confidence = 0.25;  ///< below it a triangle counts as lost
  double lets_go_after = 0.3;      ///< s without its triangle, after which a cell is let go
  double nearest_reach =
      60;  ///< px, up to which Nearest takes the cell whose pivot is nearest where none lies there
  double upright = M_PI / 2;  ///< rad, angle of a triangle whose cell has the angle 0: its apex is up
  OneEuroSettings place = kSteadyPlace;  ///< mm; used with Project::smooth_hands
  OneEuroSettings angle = kSteadyAngle;
};

/// The cell that lies at a place of the stage, the topmost that hands may take; none: CellId{}.
using CellUnder = std::function<CellId(const Vector2& place)>;

/// Cells in hands at a moment.
struct Moves {
  CellStates wished;         ///< of held cells alone, to be handed to solved()
  std::vector<CellId> held;  ///< in ascending order
  std::vector<Hold> holds() const;
};

/// Turns what lies on the table into moves of cells (thesis 3.4.7).
///
/// - Absolute: the cell's pivot is where the triangle is. Its angle is the triangle's less a right angle: an
/// apex
///   that points up is an upright cell. Of angles that are full turns apart it begins with the one that is
///   nearest to the cell's, and then counts turns.
/// - Relative: what the triangle moved and turned since it was first seen is added to the cell as it was
/// then.
/// - Nearest: takes the cell that lies under the triangle when it is laid down, and moves it as Relative
/// does.
///   Where none lies there, and none within reach, it takes none until it is taken away and laid down again.
///
/// A triangle that is lost keeps its cell where it is for `lets_go_after`, and goes on if it comes back until
/// then; later it begins anew, from where the cell is. A cell that was let go stays. Cells of layers that are
/// locked or not visible are left alone, and no cell is in two hands: who had it first keeps it, of two at
/// once the mapping that stands first.
class Hands {
 public:
  explicit Hands(const HandSettings& settings = {}) : settings_(settings) {}

  /// The moves at `time`, s, not before the last one. `now` are the states that are shown, of all cells.
  /// Triangles without a mapping, and second ones of an id, are left out; what is not finite counts as lost.
  Moves next(const Project& project, const CellStates& now, std::span<const TriangleOnTable> triangles,
             double time, const TableMap& table, const CellUnder& cell_under);

  /// Lets all go: triangles on the table begin anew.
  void forget() { grips_.clear(); }

  /// The cell that a triangle holds; none: CellId{}.
  CellId held_by(const std::string& triangle) const;

 private:
  /// A triangle that is on the table, or was just now.
  struct Grip {
    Mapping mapping;
    CellId cell;                                                     // none: it found none to take
    double last_seen = 0;                                            // s
    CellState start;                                                 // of the cell, when it was taken
    Vector2 place = Vector2::Zero(), first_place = Vector2::Zero();  // of the triangle, mm
    double angle = 0, first_angle = 0;                               // full turns counted
    SteadyPlace steady_place;
    SteadyAngle steady_angle;
  };

  void let_go(const Project& project, const CellStates& now, double time);
  void lay_down(const Project& project, const CellStates& now, const Mapping& mapping,
                const TriangleOnTable& seen, double time, const TableMap& table, const CellUnder& cell_under);
  void follow(Grip& grip, const TriangleOnTable& seen, double time, bool smooth);
  CellId taken_under(const Project& project, const CellStates& now, const Vector2& place,
                     const CellUnder& cell_under) const;
  bool is_held(CellId cell) const;
  CellState wish_of(const Grip& grip, const CellState& now, const TableMap& table) const;

  HandSettings settings_;
  std::map<std::string, Grip> grips_;  // by triangle
};

}  // namespace icome::animation
