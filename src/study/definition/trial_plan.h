#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// A person who takes part, known only by an id.
struct Participant {
  std::string id;                    // letters and digits, "007"; files call it sub-007
  std::size_t number = 0;            // number of people enrolled before
  std::size_t group = 0;             // of crossings(study, true)
  std::size_t order_row = 0;         // number of people of the group enrolled before
  std::size_t language = 0;          // of Study::languages
  std::vector<std::string> control;  // ids of levels, or numbers, in the order of Study::control
};

/// The plan of a trial, before it is done.
struct TrialPlan {
  std::size_t position = 0;   // of its condition in the person's order
  std::size_t condition = 0;  // of crossings(study, false)
  bool practice = false;
  std::size_t number = 0;            // in its condition, practice and measured trials apart
  std::optional<std::size_t> scene;  // of Trials::scenes; none: the practice scene, or no scene at all
  std::vector<std::size_t> values;   // one for each of Trials::variables
  bool operator==(const TrialPlan&) const = default;
};

/// The conditions in the order in which the person has them.
std::vector<std::size_t> conditions_of(const Study& study, const Participant& participant);

/// The values drawn for practice and measured trials depend only on the study, the person and the place of
/// the trial: the same plan can be made again after an interruption.
TrialPlan measured_trial(const Study& study, const Participant& participant, std::size_t position,
                         std::size_t number);
TrialPlan practice_trial(const Study& study, const Participant& participant, std::size_t position,
                         std::size_t number);

/// The scene that a trial takes place in; null if there is none.
const TrialScene* scene_of(const Study& study, const TrialPlan& plan);

}  // namespace icome::study
