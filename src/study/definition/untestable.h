#pragma once
#include <string>

#include "study/definition/study.h"

namespace icome::study {

/// The reason why the analysis can never compute the test that a hypothesis names, whoever takes part and
/// whatever they do: the measure, or how often it is asked, does not fit the test. Goes after "hypothesis
/// 'x' cannot be tested: "; empty if it can be, or names no test, variable or factor that could tell.
std::string why_untestable(const Study& study, const Hypothesis& hypothesis);

}  // namespace icome::study
