#pragma once
// Inverse kinematics of a chain of joints (thesis 3.4.7).
#include <optional>
#include <vector>

#include "animation/motion/rig.h"

namespace icome::animation {

/// Cells that turn, so that a point of the last one comes to a target.
struct ArmWish {
  std::vector<int> turning;          ///< cells of a rig, each the parent of the next; one at least
  Vector2 offset = Vector2::Zero();  ///< of the last one's point, from its pivot at its angle 0
  Vector2 target = Vector2::Zero();  ///< px on the stage
  std::optional<double> angle;       ///< to which the last one turns, as far as the point leaves it free
};

/// Turns the cells from how they lie, by damped least squares within their limits. The first one turns about
/// its pivot where it hangs on nothing. With `continues` they lie as in the frame before, and the bounds of
/// solved() on what moves in one frame hold.
void reach(Rig& rig, const ArmWish& wish, bool continues);

}  // namespace icome::animation
