#pragma once
#include <optional>
#include <span>

#include "animation/project/project.h"

namespace icome::animation {

/// A cell in a hand.
struct Hold {
  CellId cell;
  CellState wish;  ///< place and angle count
  /// The point that a hand pulls at which does not turn (a mouse): only where `wish` has it counts then.
  std::optional<PointOnCell> pulled = std::nullopt;
};

struct Solution {
  CellStates states;
  double residual = 0;  ///< px, by which the worst constraint is not kept; below 1e-6 where all can be
};

/// States near those without hands and to what hands wish, that keep every constraint of the project (thesis
/// 3.4.7). Constraints on cells without a state are left out; those that contradict each other end in a
/// compromise, whose residual is told. The same input gives the same output.
///
/// Without hands:
/// - A cell that hangs on a joint keeps its angle to its parent as `states` have it, within the limits, and
/// has
///   its pin at the parent's exactly. So what hangs on a cell comes along with it. Angles and limits are
///   numbers: a child that was turned once round is beyond limits of less.
/// - Distances, paths and axes push cells: those without joints by their places alone, others by turning them
///   and their ancestors at their joints and by moving all of the tree, so that as little as possible moves;
///   a tree of many cells gives way less than a single one.
/// - A path that turns its cell gives it the path's angle about the guided point: Way::angle, the mean over
///   40 px of the path. Cells that hang on a joint it does not turn.
///
/// Held cells have their way; the others give way. Only where that is not enough do held ones too, all by the
/// same share.
/// - A cell that hangs on no joint, as the first of a tree: place and angle are the hand's.
/// - A cell that hangs on a joint, with no chain: it turns at the joint. Its angle is the wish's, and the
/// place
///   follows. Pulled at a point, it turns so that this points from the joint to the hand.
/// - A cell of a chain, but not its first: those between the last held one before it, or the first, and the
///   held one turn at their joints too, so that its pivot comes to the wish's place, and as far as then is
///   free, its angle to the wish's; pulled, so that the point comes to the hand. The first cell of the chain
///   turns at its own joint, or about its pivot where it hangs on none. Within the last hundredth of its
///   reach a chain straightens ever more slowly and never quite (its knees would pop): there, and beyond, the
///   end stays behind the hand by up to half a hundredth.
///
/// `before` are the states of the frame before. With them nothing pops while hands move evenly: a cell on a
/// path slides from where it was and does not jump to another branch that comes near, a chain bends on from
/// how it was bent, and no part of it moves further than 6 times what the hand went ahead; where the hand
/// passes an end that cannot follow (the centre of a bend, the root of a chain) the cell may lag for some
/// frames. Without them, the nearest of all is taken, and chains bend from `states`.
Solution solved(const Project& project, const CellStates& states, std::span<const Hold> holds,
                const CellStates* before);

/// As solved() above, with the wishes of the held cells among all: `wished` is what hands wish for cells in
/// `held`. What hangs on a held cell comes along by what that turns since `before`; without it, it keeps the
/// wished angle.
Solution solved(const Project& project, const CellStates& wished, std::span<const CellId> held,
                const CellStates* before = nullptr);

/// The states of all cells and of the camera at a frame, by their keys and the constraints. As continuous as
/// the tracks are: between two keys a cell on a path goes along it from where one puts it to where the next
/// does (the shorter way round where the path is closed), and is not thrown to another branch on its way. Two
/// cases can jump: points that keys drive through each other while a least distance keeps them apart, and a
/// cell that keys and a distance pull far off the corner of a path.
CellStates states_at(const Project& project, double frame);

}  // namespace icome::animation
