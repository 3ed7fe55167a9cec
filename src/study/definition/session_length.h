#pragma once
#include "study/definition/study.h"

namespace icome::study {

/// Trials that are measured in each condition.
std::size_t trials_a_condition(const Trials& trials);

/// What a session of one person takes about, in s; see check_study() for what is assumed.
double session_length(const Study& study);

}  // namespace icome::study
