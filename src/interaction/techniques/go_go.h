#pragma once
#include "base/vector.h"

namespace icome::interaction {

/// The Go-Go mapping of the hand (Poupyrev, Billinghurst, Weghorst and Ichikawa, UIST 1996): unchanged
/// near the body, farther and farther away beyond D. The paper has k = 1/6 for lengths in cm and D = 2/3
/// of the arm's length; k is 1/cm, so 100/6 for metres.
struct GoGoSettings {
  double arm = 0.7;                // m, from the chest to the hand of the stretched arm; 0.4 to 1
  double near_share = 2.0 / 3.0;   // of the arm: D
  double gain = 100.0 / 6.0;       // 1/m: k
  double chest_below_eyes = 0.25;  // m, where distances are measured from; 0.2 to 0.4
};

/// Distance of the virtual hand from the chest when the hand is at `distance` (m, >= 0):
/// r below D, r + k (r - D)^2 beyond.
double go_go_reach(const GoGoSettings& settings, double distance);
/// Speed of the virtual hand outwards there, in that of the hand: 1 up to D, and continuous.
double go_go_slope(const GoGoSettings& settings, double distance);
/// Distance of the hand from the chest when the virtual hand is at `reach` (m, >= 0).
double go_go_distance(const GoGoSettings& settings, double reach);

/// The virtual hand: in the hand's direction from the chest, turned as the hand. Room frame.
base::Pose go_go_hand(const GoGoSettings& settings, const base::Vector3& room_chest,
                      const base::Pose& room_from_hand);
/// The place of the hand that puts the virtual hand at a point. Room frame.
base::Vector3 go_go_hand_for(const GoGoSettings& settings, const base::Vector3& room_chest,
                             const base::Vector3& room_point);
/// The chest of a person whose eyes are there.
base::Vector3 chest_of(const GoGoSettings& settings, const base::Pose& room_from_head);

}  // namespace icome::interaction
