#pragma once
#include "speech/grammar/grammar.h"
#include "study/definition/trial_goal.h"

namespace icome::study {

/// The sentences by which things of a trial are chosen: "the red ball", "choose red".
struct SpokenChoices {
  static constexpr const char* kSentence = "choice";  // its rule
  speech::Grammar grammar = {};

  /// The thing of the goal that is chosen by words; -1: none.
  int chosen(const std::vector<std::string>& words) const;
};

/// The choices among the things of a goal that are the target or wrong, each by its name, or that of a widget
/// as it is written there. Fails where a target's name has no words, and where another thing, which is
/// none, has the same words.
base::Result<SpokenChoices> spoken_choices(const TrialGoal& goal);

}  // namespace icome::study
