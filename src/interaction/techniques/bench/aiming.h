#pragma once
#include <optional>

#include "interaction/techniques/bench/person.h"
#include "interaction/techniques/technique.h"

namespace icome::interaction {

/// A simulated person's steering of one way of selecting, by three numbers: the place of the hand (m, room
/// frame) or the direction of hand or head (rad to the right and up; the third is 0). The person stands
/// upright in a room that is the world, looks along -z and, for the miniature, holds it in the other hand.
class Aiming {
 public:
  Aiming(const Technique& technique, const PersonModel& person);

  /// Places of the person; world frame, m.
  static Vector3 eyes();
  static Vector3 pointing_hand();

  /// Is it a hand that goes places, or does something point?
  bool goes() const;
  const LimbModel& limb(const PersonModel& person) const;
  /// The devices' input for a steering.
  TechniqueInput input(const Vector3& control, double time, bool grab) const;
  /// The steering for which the technique is right at a place of the world; nothing: out of reach.
  std::optional<Vector3> control_for(const TechniqueScene& scene, const Vector3& place) const;
  /// The point of the world that the technique reaches; of a pointing ray, the one nearest to that place.
  Vector3 reached(const TechniqueScene& scene, const Vector3& control, const Vector3& place) const;
  /// Distance (m) of the place where the person looks while aiming at a place of the world: for a
  /// miniature, that of its copy.
  double viewing_distance(const TechniqueScene& scene, const Vector3& place) const;
  /// The target that a steering selects.
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
