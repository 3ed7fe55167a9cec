#pragma once
#include <optional>
#include <utility>

#include "base/result.h"
#include "study/analysis/analysis_parts.h"

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

/// The two choices that a binomial test compares, in the order in which they are named: by an expectation or
/// by name, or the only two. Nothing where three are there and none is named.
std::optional<std::pair<std::size_t, std::size_t>> compared_answers(const Hypothesis& hypothesis,
                                                                    const Item& item);
/// The chi-squared test of thesis 6.4.2 over the answers that were given, where it agrees with what a
/// binomial test asks: all of them, and the two that are compared alone, are unequal at the hypothesis's
/// level. What it says for the sake of ties is left out.
std::optional<TestResult> shares_that_agree(const Question& question);

/// All that speaks against taking a test of a factor's levels at its word, as clauses: interactions with
/// other factors that are significant, and, of tests of means, assumptions that fail.
std::vector<std::string> doubts_of(const Question& question, const PersonTable& table,
                                   const TestResult& result);
/// "F(1.31, 7.88) = 13.34, p = .003".
std::string result_words(const TestResult& result);
/// "p = .003", "p < .001".
std::string p_words(double p);

/// By a test of means or ranks. Fails where it does not fit.
base::Result<TestResult> test_numbers(const Question& question);
/// By a test of counts of answers. Fails where it does not fit.
base::Result<TestResult> test_counts(const Question& question);

}  // namespace icome::study
