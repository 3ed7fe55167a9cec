#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// A reason why a study cannot be run, or a weakness to think about.
struct Finding {
  Place place;
  std::string sentence;
};

/// The probability that the planned number of people shows a medium effect.
struct HypothesisPower {
  std::string hypothesis;
  double effect = 0.5;     // Cohen's d, of pairs d_z
  double power = 0.0;      // with the planned number; 0 where none is planned
  std::size_t needed = 0;  // people in all for a power of 0.8
};

/// The numbers of a study and the findings about it.
struct StudyCheck {
  std::size_t conditions = 1;   // of each person
  std::size_t groups = 1;       // of people
  std::size_t orders = 1;       // of the conditions, in each group
  std::size_t balanced_by = 1;  // the number of people should be a multiple of this
  std::size_t trials = 0;       // measured, of a person
  double session = 0.0;         // s, about, of a person
  std::vector<HypothesisPower> powers;
  std::vector<Finding> reasons;   // reasons why it cannot be run as it is
  std::vector<Finding> warnings;  // it can be run all the same
};

/// Computes the numbers of a study, and finds its unmet needs and the weaknesses of its design.
///
/// The session has trials of the given length, each after its hold; breaks; reading at 200 words a minute;
/// 10 s a closed question and 45 s an open one. The power is of t-tests for a medium effect (Cohen's d =
/// 0.5), for hypotheses about a factor of two levels tested by an analysis of variance or a t-test.
StudyCheck check_study(const Study& study);

}  // namespace icome::study
