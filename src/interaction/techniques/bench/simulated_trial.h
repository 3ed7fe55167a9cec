#pragma once
#include "interaction/techniques/bench/aiming.h"
#include "interaction/techniques/bench/fitts_figures.h"

namespace icome::interaction {

/// A target that a simulated person is to select next.
struct TrialTask {
  TargetId target = 0;
  Aiming::Goal goal = {};
  Vector3 start = Vector3::Zero();          // m: the last target's centre
  Vector3 start_control = Vector3::Zero();  // the steering of hand or head
};

/// The outcome of a trial.
struct TrialRun {
  FittsTrial trial;
  Vector3 end_control = Vector3::Zero();
  int movements = 0;                        // the first, and corrections
  std::vector<TechniqueInput> stream = {};  // all that the technique was given
};

/// A simulated person selects a target with a technique: reacts, moves by minimum jerk to where signal-
/// dependent noise lets the movement end, sees the highlighted thing, and corrects until it is the
/// target; then presses the button, which jolts. All the while the hand trembles. The technique's own
/// step() tells the highlighted and the selected target. The same random numbers give the same run.
TrialRun simulated_trial(const Technique& technique, const PersonModel& person, const Aiming& aiming,
                         const TechniqueScene& scene, const TrialTask& task, base::Random& random);

}  // namespace icome::interaction
