#include "interaction/techniques/technique_input.h"

#include <algorithm>
#include <cmath>

namespace icome::interaction {
namespace {

bool is_tracked_pose(const Pose& pose) {
  constexpr double kFarthestTracked = 1e6;  // m
  const Vector3 at = pose.translation();
  return at.allFinite() && at.cwiseAbs().maxCoeff() <= kFarthestTracked && pose.linear().isUnitary(1e-6) &&
         pose.linear().determinant() > 0.0;
}

}  // namespace

bool makes_sense(const TechniqueInput& input) {
  return std::isfinite(input.time) && is_tracked_pose(input.room_from_head) &&
         std::all_of(input.hands.begin(), input.hands.end(), [](const HandInput& hand) {
           return !hand.tracked || (is_tracked_pose(hand.room_from_hand) && std::isfinite(hand.reel));
         });
}

}  // namespace icome::interaction
