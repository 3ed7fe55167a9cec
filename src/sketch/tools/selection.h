#pragma once
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "sketch/drawn.h"

namespace icome::sketch {

/// Which control points of each stroke are chosen (thesis 4.5.4). A stroke of n segments has 3 n + 1: number
/// 3 i + k is B(k+1) of segment i, so that neighbours have the one at their joint in common; of a closed
/// curve the last is the first.
using Selection = std::map<StrokeId, std::vector<bool>>;

/// The rule for what is inside of a lasso that crosses itself.
enum class InsideRule : std::uint8_t {
  EvenOdd,  ///< what one leaves by an odd number of its lines
  NonZero,  ///< what it goes around
};

/// Is a point inside of a closed line?
bool is_inside(const Vector2& point, std::span<const Vector2> closed_line, InsideRule rule);

// All choose among strokes of layers that are visible and not locked. Strokes without a chosen point are not
// in the selection.

/// The control points inside of a lasso.
Selection inside_lasso(const Drawing& drawing, std::span<const Vector2> lasso, InsideRule rule);
/// All points of the strokes whose line is less than `within` (m) from one of these places.
Selection touched(const Drawing& drawing, std::span<const Vector2> places, double within);
Selection everything(const Drawing& drawing);

/// Both selections together.
Selection joined(const Selection& a, const Selection& b);

/// The chosen control points brought elsewhere by `to_other`; handles at a joint of which only one side is
/// chosen may then break. Widths of strokes that are chosen whole are scaled with them.
DrawingEdit transformed(const Drawing& drawing, const Selection& selection, const Eigen::Affine2d& to_other);

/// The box of the chosen points; empty where none is.
Bounds2 bounds_of(const Drawing& drawing, const Selection& selection);

/// The first ends of segments along each curve that are not chosen while their neighbour is: what holds the
/// selection back (thesis 4.15).
std::vector<Vector2> holding_points(const Drawing& drawing, const Selection& selection);

}  // namespace icome::sketch
