#pragma once
#include <optional>
#include <utility>

#include "base/result.h"
#include "study/analysis_parts.h"

namespace icome::study {

/// A hypothesis with what it speaks of.
struct Question {
  const StudyData& data;
  const Hypothesis& hypothesis;
  const DependentVariable& dependent;
  const IndependentVariable* factor = nullptr;  // null: counts are held against equal ones
  Test test = Test::Anova;                      // that was named, or else fits; not None
};

/// The two levels that are compared: those with an expectation, or the only two.
std::optional<std::pair<std::size_t, std::size_t>> compared_levels(const Question& question);

/// By a test of means or ranks. Fails where it does not fit.
base::Result<TestResult> test_numbers(const Question& question);
/// By a test of counts of answers. Fails where it does not fit.
base::Result<TestResult> test_counts(const Question& question);

}  // namespace icome::study
