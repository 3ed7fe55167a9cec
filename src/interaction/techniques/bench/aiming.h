#pragma once
#include <optional>

#include "interaction/techniques/bench/person.h"
#include "interaction/techniques/technique.h"

namespace icome::interaction {

/// How a simulated person steers one way of selecting: by three numbers, which are where the hand is (m, room
/// frame) or where hand or head point (rad to the right and up; the third is 0). The person stands upright in
/// a room that is the world, looks along -z and, for the miniature, holds it in the other hand.
class Aiming {
 public:
  Aiming(const Technique& technique, const PersonModel& person);

  /// Of the person; world frame, m.
  static Vector3 eyes();
  static Vector3 pointing_hand();

  /// Is it a hand that goes places, or does something point?
  bool goes() const;
  const LimbModel& limb(const PersonModel& person) const;
  /// What the devices say then.
  TechniqueInput input(const Vector3& control, double time, bool grab) const;
  /// The steering for which the technique is right at a place of the world; nothing: out of reach.
  std::optional<Vector3> control_for(const TechniqueScene& scene, const Vector3& place) const;
  /// Where in the world the technique is, as near to that place as what points comes.
  Vector3 reached(const TechniqueScene& scene, const Vector3& control, const Vector3& place) const;
  /// How far away the place is where the person looks while aiming at a place of the world, m: that of its
  /// copy in a miniature.
  double viewing_distance(const TechniqueScene& scene, const Vector3& place) const;
  /// What it selects.
  TargetId picked(const TechniqueScene& scene, const Vector3& control) const;

  /// A steering that selects a target and by how much it may be off, in the limb's unit.
  struct Goal {
    Vector3 control;
    double tolerance;
  };
  /// The person aims at the middle of the target, or, where that does not select it, at where it does best;
  /// nothing: it cannot be selected.
  std::optional<Goal> goal_for(const TechniqueScene& scene, TargetId target) const;

 private:
  double tolerance(const TechniqueScene& scene, TargetId target, const Vector3& control) const;

  Technique technique_;
  double arm_length_;
};

}  // namespace icome::interaction
