#pragma once
#include <vector>

#include "base/random.h"
#include "interaction/techniques/technique_scene.h"

namespace icome::interaction {

/// A pointing task: the size and the distance of targets, and the number of others among them.
struct FittsCondition {
  double size = 0.06;     // m, diameter of a target
  double distance = 1.2;  // m, from the eyes to the middle of the ring
  int distractors = 0;    // at most so many stand within three sizes of every target
};

/// Balls on a ring before the person, one after the other on its other side (ISO 9241-411, multi-directional
/// tapping); the ring leans towards the person by 30 degrees, so that depth counts. Distractors are balls of
/// the same size that stand around the targets, but hide none of them from eyes and hand.
struct FittsLayout {
  TechniqueScene scene;
  std::vector<TargetId> order;  // of the targets: each movement goes from one to the next, then round
};

inline constexpr int kRingTargets = 9;
/// The ring's diameter, as a share of its distance.
inline constexpr double kRingShare = 0.8;

/// Eyes and hand in the world's frame. The same condition and random numbers give the same layout.
FittsLayout fitts_layout(const FittsCondition& condition, const Vector3& eyes, const Vector3& hand,
                         base::Random& random);

}  // namespace icome::interaction
