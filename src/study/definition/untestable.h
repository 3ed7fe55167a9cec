#pragma once
#include <string>

#include "study/definition/study.h"

namespace icome::study {

/// Why the analysis can never compute the test that a hypothesis names, whoever takes part and whatever they
/// do: what is measured, or how often it is asked, does not fit the test. Goes after "hypothesis 'x' cannot
/// be tested: "; empty where it can be, or where it names no test, variable or factor that could tell.
std::string why_untestable(const Study& study, const Hypothesis& hypothesis);

}  // namespace icome::study
