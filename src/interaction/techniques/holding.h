#pragma once
#include <optional>
#include <string_view>

#include "interaction/techniques/selecting.h"
#include "interaction/techniques/two_hands.h"

namespace icome::interaction {

/// Ways to move a selected object (thesis 2.2, 2.3.1).
enum class Holding : std::uint8_t {
  Hand,         // goes with the hand in all six degrees of freedom
  GoGo,         // goes with the virtual hand of an arm that grows
  AlongRay,     // hangs on the ray from the hand, and slides along it
  Miniature,    // goes with its copy, which the hand moves
  TwoHands,     // goes with one hand; between two it is moved, turned and scaled
  ScaledWorld,  // the world shrinks until it is at hand, and grows again afterwards (Mine 1997)
};
inline constexpr std::array kAllHolding = {Holding::Hand,      Holding::GoGo,     Holding::AlongRay,
                                           Holding::Miniature, Holding::TwoHands, Holding::ScaledWorld};
std::string_view name_of(Holding holding);

struct HoldingSettings {
  double reel_speed = 1.5;   // 1/s: an object on a ray goes away by this power of e in a second; 0.5 to 3
  double nearest = 0.05;     // m, to which it can be pulled
  double farthest = 1000.0;  // m, to which it can be pushed; to so far from the eyes anything can be moved
  TwoHandSettings two_hands = {};
};

/// The inputs of holding at one moment.
struct HoldingMoment {
  const TechniqueInput& input;
  const SelectingSettings& sizes;
  const HoldingSettings& settings;
  const base::Affine3& world_from_room;
  const base::Bounds& world_bounds;  // what the miniature shows
  double seconds;                    // since the last step
};

/// An object in the hand. A plain value. Whenever a hand joins, lets go, is lost by its tracker or found
/// again, holding begins anew from where the object is then, so nothing jumps.
class Hold {
 public:
  /// Hand 0 holds; with TwoHands both may.
  Hold(Holding holding, const PointedAt& grasped);

  TargetId id() const { return id_; }
  /// The object's place now, from its place at the last step; both in the world's frame.
  base::Affine3 follow(const HoldingMoment& now, const base::Affine3& world_from_target);

 private:
  using Hands = std::array<bool, 2>;
  Hands hands_now(const TechniqueInput& input) const;
  void begin(const HoldingMoment& now, const base::Affine3& world_from_target);
  Pose hand(const HoldingMoment& now, std::size_t which) const;
  base::Affine3 shown_from_world(const HoldingMoment& now) const;
  base::Affine3 slid() const;

  Holding holding_;
  TargetId id_;
  Vector3 grasped_;  // m, world frame, when it was selected
  Hands by_ = {false, false};
  // One hand: where the object (or its copy) is in the hand, and how far it slid along the ray.
  base::Affine3 hand_from_target_ = base::Affine3::Identity();
  double length_start_ = 1.0, length_ = 1.0;
  double shown_scale_ = 1.0;  // of what the hand moves, when it was taken
  // Two hands: where it was when both had it.
  std::optional<TwoHandGrip> grip_;
  base::Affine3 start_ = base::Affine3::Identity();
};

/// Factor by which the room must grow about the eyes for the grasped point to come to the hand's distance,
/// as if the world shrank (Mine, Brooks and Sequin 1997); within 1/1000 and 1000.
double growth_to_reach(const Vector3& eyes, const Vector3& hand, const Vector3& grasped);

}  // namespace icome::interaction
