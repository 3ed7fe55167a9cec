#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "study/definition/trial_plan.h"
#include "world/world.h"

namespace icome::study {

/// An object of the scene that can be touched.
struct Thing {
  std::string name;     // its own, or that of the object that it is part of
  base::Bounds bounds;  // m, stage frame
  bool target = false;
  bool wrong = false;
  world::ObjectId object = {};
};

/// The goal of a trial in its scene.
struct TrialGoal {
  std::vector<Thing> things;
  Choosing choosing = Choosing::Touch;
  bool forces = true;
  bool head = true;
  std::optional<bool> stereo;                   // each eye gets a picture; none: as it was chosen
  base::Vector3 start = base::Vector3::Zero();  // m, stage frame
  double near = 0.01;                           // m; see Task
  double depth = 0.002;                         // m
  double vicinity = 0.03;                       // m
  double limit = 60.0;                          // s
  double hold = 0.0;                            // s

  /// The distance from a point to the end of the approach, m: to the target or, when one is chosen from
  /// several by click or push, to the nearest of these.
  double distance_to_vicinity(const base::Vector3& tip) const;
  /// The index of the target or wrong thing that is nearest within `near`; -1: none.
  int nearest(const base::Vector3& tip) const;
};

/// The name with trial variables in braces replaced by the ids of their values in this trial.
std::string name_in_trial(const Study& study, const TrialPlan& plan, const std::string& name);

/// Does a name match a pattern, in which * stands for any letters?
bool is_meant(const std::string& pattern, const std::string& name);

/// The objects that are hidden in this trial, by Task::shown.
std::vector<world::ObjectId> hidden_things(const Study& study, const TrialPlan& plan,
                                           const world::World& world);

/// The goal of a trial in a world without hidden_things(). Fails when the study has no task or no thing is
/// the target, naming the things that there are.
base::Result<TrialGoal> trial_goal(const Study& study, const Participant& participant, const TrialPlan& plan,
                                   const world::World& world);

}  // namespace icome::study
