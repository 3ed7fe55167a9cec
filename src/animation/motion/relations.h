#pragma once
// Distances, paths and axes on a rig of joints, and what keeps them.
#include <cstdint>
#include <vector>

#include "animation/motion/rig.h"
#include "animation/motion/way.h"

namespace icome::animation {

/// A distance, a path or an axis. Its excess, px, grows where `one` moves along `normal` and `other` against
/// it.
struct Relation {
  enum class Kind : std::uint8_t { Distance, Path, Axis };
  Kind kind = Kind::Distance;
  int one = -1, other = -1;  ///< cells of the rig; no other with paths and axes
  Vector2 on_one = Vector2::Zero(), on_other = Vector2::Zero();  ///< from the pivots, at angle 0
  double distance = 0;                                           ///< px, the greatest, or
  bool is_least = false;                                         ///< the least one
  Vector2 through = Vector2::Zero();                             ///< of an axis
  int way = -1;                                                  ///< of a path
  double s = 0;                                                  ///< where its bead is
  bool waits = false;                                            ///< its bead, until the cell has come to it
  bool turns = false;                                            ///< its cell, by the path
  bool has_before = false;                                       ///< the angle of the frame before
  double angle_before = 0;

  Vector2 normal = Vector2(1, 0);
  double excess = 0;    ///< to be brought to 0; below 0 where a distance is kept with room to spare
  bool is_even = true;  ///< it is to be 0, not just 0 or below

  double violation() const { return is_even ? std::abs(excess) : std::max(excess, 0.0); }
};

/// All relations of a project that a rig has the cells of.
class Relations {
 public:
  /// `rig` outlives it.
  Relations(const Project& project, Rig& rig);

  /// Puts beads where cells were the frame before and lets them slide to where cells are now; without
  /// `before` to the nearest place of the way.
  void start(const CellStates* before);
  /// Moves what is in no hand until all is kept as well as can be; then, where that is not enough, all.
  /// Precondition: start().
  void keep();
  /// px, by which the worst is not kept.
  double worst() const;

 private:
  /// Trees that relations tie to each other.
  struct Island {
    std::vector<int> relations;
    std::vector<int> roots;
    std::size_t freedoms = 0;
  };
  /// The places and turns of an island, to go back to.
  struct Pose {
    std::vector<double> values;
  };

  void find_levers();
  void gather_islands();
  void keep(const Island& island, bool with_hands);
  double worst(const Island& island) const;
  double measure(const Island& island);
  void measure(Relation& relation) const;
  void follow_way(Relation& relation);
  bool step(const Island& island, std::size_t from, std::size_t to, double damping);
  bool block_limits(const Island& island);
  bool solve_rows(const std::vector<int>& rows, std::size_t freedoms, double damping);
  void weigh(const Island& island, bool with_hands);
  void add_row(int cell, const Vector2& offset, const Vector2& along, double* row) const;
  void move(const Island& island);
  Pose pose_of(const Island& island) const;
  void restore(const Island& island, const Pose& pose);

  Rig& rig_;
  std::vector<Way> ways_;
  std::vector<Relation> relations_;
  std::vector<Island> islands_;
  std::vector<double> levers_;                     // px, of each cell: how far what matters lies from its pin
  std::vector<int> freedom_of_root_;               // by cell
  std::vector<double> weights_, free_, by_;        // of an island's freedoms
  std::vector<std::vector<std::size_t>> touched_;  // freedoms that a row is not 0 for
  std::vector<double> rows_, weighted_, products_;  // of a step
};

}  // namespace icome::animation
