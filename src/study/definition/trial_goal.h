#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/result.h"
#include "base/vector.h"
#include "study/definition/stage_element.h"
#include "study/definition/trial_plan.h"
#include "world/world.h"

namespace icome::study {

/// An object of the scene that can be touched, or a widget of the scene's element that can be chosen.
struct Thing {
  std::string name;     // its own, or that of the object that it is part of; of a widget "element/widget"
  base::Bounds bounds;  // m, stage frame; of a widget of a menu that is not open empty
  bool target = false;
  bool wrong = false;
  world::ObjectId object = {};                  // of an object of the scene
  const interaction::Widget* widget = nullptr;  // of the goal's element; null: it is an object
};

/// The haptic element of a trial.
struct TrialElement {
  std::string id;
  std::shared_ptr<const interaction::Element> element;  // chosen from as the trial has it; never null
  std::size_t language = 0;
};

/// The goal of a trial in its scene.
struct TrialGoal {
  std::vector<Thing> things;
  Choosing choosing = Choosing::Touch;
  bool forces = true;
  bool head = true;
  bool speech = false;                          // things are chosen by saying their names, too
  std::optional<bool> stereo;                   // each eye gets a picture; none: as it was chosen
  base::Vector3 start = base::Vector3::Zero();  // m, stage frame
  std::optional<TrialElement> element = {};
  double near = 0.01;      // m; see Task
  double depth = 0.002;    // m
  double vicinity = 0.03;  // m
  double limit = 60.0;     // s
  double hold = 0.0;       // s

  /// Is something of the element the target?
  bool is_in_element() const;
  /// The number of a widget's thing; -1: it is none.
  int thing_of(const interaction::Widget& widget) const;
  /// The distance from a point to the end of the approach to an object, m: to the target or, when one is
  /// chosen from several by click or push, to the nearest of these. Infinite where there is none.
  double distance_to_vicinity(const base::Vector3& tip) const;
  /// The index of the target or wrong object that is nearest within `near`; -1: none.
  int nearest(const base::Vector3& tip) const;
};

/// The name with trial variables in braces replaced by the ids of their values in this trial.
std::string name_in_trial(const Study& study, const TrialPlan& plan, const std::string& name);

/// Does a name match a pattern, in which * stands for any letters?
bool is_meant(const std::string& pattern, const std::string& name);

/// The objects that are hidden in this trial, by Task::shown.
std::vector<world::ObjectId> hidden_things(const Study& study, const TrialPlan& plan,
                                           const world::World& world);

/// The goal of a trial in a world without hidden_things(), with the element of its scene (null: it has none).
/// Fails when the study has no task or no thing is the target, naming the things that there are, and when the
/// target is disabled in the element.
base::Result<TrialGoal> trial_goal(const Study& study, const Participant& participant, const TrialPlan& plan,
                                   const world::World& world, const StageElement* element = nullptr);

}  // namespace icome::study
