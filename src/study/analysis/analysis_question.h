#pragma once
#include <optional>
#include <utility>

#include "base/result.h"
#include "study/analysis/analysis_parts.h"

namespace icome::study {

/// A hypothesis with its data, variables and test.
struct Question {
  const StudyData& data;
  const Hypothesis& hypothesis;
  const DependentVariable& dependent;
  const IndependentVariable* factor = nullptr;  // null: counts are compared with equal ones
  Test test = Test::Anova;                      // the one named, or else the one that fits; not None
};

/// The two levels that are compared: those of the expectation, or the only two.
std::optional<std::pair<std::size_t, std::size_t>> compared_levels(const Question& question);

/// The two choices that a binomial test compares, in the order in which they are named: by an expectation or
/// by name, or the only two. Nothing if there are three and none is named.
std::optional<std::pair<std::size_t, std::size_t>> compared_answers(const Hypothesis& hypothesis,
                                                                    const Item& item);
/// The chi-squared test of thesis 6.4.2 over the answers that were given, if it agrees with the question
/// of a binomial test: all of them, and the two that are compared alone, are unequal at the hypothesis's
/// level. A result that is due to ties is left out.
std::optional<TestResult> shares_that_agree(const Question& question);

/// Reasons for caution about a test of a factor's levels, as clauses: interactions with other factors
/// that are significant, and, for tests of means, assumptions that fail.
std::vector<std::string> doubts_of(const Question& question, const PersonTable& table,
                                   const TestResult& result);
/// "F(1.31, 7.88) = 13.34, p = .003".
std::string result_words(const TestResult& result);
/// "p = .003", "p < .001".
std::string p_words(double p);

/// Tests a hypothesis on means or ranks. Fails if the test does not fit.
base::Result<TestResult> test_numbers(const Question& question);
/// Tests a hypothesis on counts of answers. Fails if the test does not fit.
base::Result<TestResult> test_counts(const Question& question);

}  // namespace icome::study
