#pragma once
#include "study/definition/study.h"

namespace icome::study {

/// The number of measured trials in each condition.
std::size_t trials_a_condition(const Trials& trials);

/// The approximate length of a session of one person, s; see check_study() for the assumptions.
double session_length(const Study& study);

}  // namespace icome::study
