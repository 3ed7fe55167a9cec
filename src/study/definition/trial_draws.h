#pragma once
#include <cstddef>
#include <vector>

#include "study/definition/study.h"

namespace icome::study {

/// The values that may be drawn for a trial, one vector for each draw (TrialPlan::values), as far as they
/// change the names of things. If there are some hundreds of draws, each value occurs at least with some of
/// the others. Precondition: the study has a task.
std::vector<std::vector<std::size_t>> possible_draws(const Study& study);

/// Does anybody practise?
bool is_practised(const Trials& trials);

}  // namespace icome::study
