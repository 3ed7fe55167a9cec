#pragma once
#include <optional>

#include "base/vector.h"

namespace icome::sketch {

using base::Vector2;

// Forces (N) with which a drawing resists tools, or helps them (thesis 4.13 to 4.16): a person feels how far
// away from the old shape she goes, and how much of the drawing hangs on what she moves.

/// The function l of the thesis: the force for a change of this length (m, >= 0). It rises with the length,
/// is nothing at 0, and from kFeltFrom on between 0.2 N and 1 N.
double resistance(double length);
constexpr double kFeltFrom = 0.001;   // m
constexpr double kHardness = 752.84;  // N/m: the slope of resistance() at 0, nowhere steeper

/// The grip of a pen on a drawing: what resists when it moves on. Lengths in m, on the paper or as a hand
/// feels them.
struct ToolGrip {
  Vector2 start = Vector2::Zero();  ///< where the pen took it
  /// Points that hold back what goes along with the pen: 1 for the curve that it pulls (4.13); for a
  /// selection that is moved, those of holding_points() (4.15).
  double holding = 0.0;
  Vector2 centre = Vector2::Zero();  ///< of a turn or a scaling
  /// m, the sum of the distances of the holding points from the centre; 0: nothing is turned, or scaled.
  double turned = 0.0, scaled = 0.0;
  std::optional<Vector2> end = {};  ///< attracts the pen within `within` (M of 4.16)
  double within = 0.0;
  Vector2 free = Vector2::Zero();  ///< unit, a direction in which it does not; 0: it does in all
  double softness = 1.0;  ///< 0 to 1, counts for all lengths: less for a device that cannot be as hard

  bool operator==(const ToolGrip&) const = default;
};

/// The force on a pen at a place, and how hard it is there: force by length of the way, N/m. It is nothing
/// where the pen took hold, and changes without a step.
/// - Against a move, and against the curve that is pulled: by the way, times the holding points.
/// - Against a turn: across the arm, by the sum of the translations of the holding points; less far from the
///   centre, as a torque, fading near it, and where it has gone half around.
/// - Against a scaling: along the arm, by the sum of those translations; fading near the centre.
/// - Towards an end: from nothing at the distance `within` on, greatest on the way, and nothing at the end.
struct ToolForce {
  Vector2 force = Vector2::Zero();
  Vector2 of_turn = Vector2::Zero();  ///< the part of it against a turn
  double hardness = 0.0;
};
ToolForce tool_force(const ToolGrip& grip, const Vector2& pen);

/// The most of hardness that there is anywhere, N/m; 0: the grip is none.
double greatest_hardness(const ToolGrip& grip);

}  // namespace icome::sketch
