#pragma once
#include <span>

#include "base/vector.h"

namespace icome::sketch {

using base::Vector2;

// Forces (N) with which a drawing resists tools, or helps them (thesis 4.13 to 4.16): a person feels how far
// away from the old shape she goes, and how much of the drawing hangs on what she moves.

/// The function l of the thesis: the force for a change of this length (m, >= 0). It rises with the length,
/// is nothing at 0, and from kFeltFrom on between 0.2 N and 1 N.
double resistance(double length);
constexpr double kFeltFrom = 0.001;  // m

/// The force that draws a pen back to the curve that it has pulled by `pull` (4.13).
Vector2 pull_force(const Vector2& pull);

/// The force against a selection that has been moved by `move`, which so many points hold (4.15): the sum of
/// their translations counts.
Vector2 move_force(const Vector2& move, std::size_t holding_points);

/// The force on a pen at `pen` that has turned a selection about `centre` by `angle` (rad): across the way to
/// the centre, against the turn, by the sum of the ways that the holding points would have gone.
Vector2 turn_force(const Vector2& pen, const Vector2& centre, double angle, std::span<const Vector2> holding);

/// The force on a pen at `pen` that has scaled a selection about `centre` by `factor` (> 0): along the way to
/// the centre, by the sum of the ways that the holding points would have gone.
Vector2 scale_force(const Vector2& pen, const Vector2& centre, double factor,
                    std::span<const Vector2> holding);

/// The force with which an end at `end` attracts a pen within `within` (M of 4.16, m): it sets in from
/// nothing at that distance, is greatest on the way and nothing at the end itself, so that one can resist it.
Vector2 connect_force(const Vector2& pen, const Vector2& end, double within);

}  // namespace icome::sketch
