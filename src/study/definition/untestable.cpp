#include "study/definition/untestable.h"

#include <fmt/format.h>

#include <algorithm>

#include "study/analysis/analysis_question.h"
#include "study/definition/conditions.h"
#include "study/records/trial_table.h"

namespace icome::study {
namespace {

// The cases that test_numbers() and test_counts() refuse (analysis_numbers.cpp, analysis_counts.cpp).

/// A question, and whether each person answers it in several conditions.
struct AskedItem {
  const Item& item;
  bool in_conditions = false;  // asked after each condition, of which there may be only one
  bool repeated = false;       // asked after each of several conditions
};

std::string numbers_misfit(const AskedItem& asked, const IndependentVariable& factor) {
  if (asked.item.kind != ItemKind::Rating && asked.item.kind != ItemKind::Number)
    return fmt::format("the answers to '{}' are no numbers; chisq compares how many gave each",
                       asked.item.id);
  if (!factor.between && !asked.in_conditions)
    return fmt::format("'{}' is asked once, and the levels of '{}' are compared; ask after each condition",
                       asked.item.id, factor.id);
  return {};
}

/// McNemar's test needs the same people's choices under the two levels of the only within factor.
std::string changes_misfit(const Study& study, const AskedItem& asked, const IndependentVariable& factor) {
  if (factor.between)
    return fmt::format("mcnemar compares answers of the same people, and '{}' is between; use chisq",
                       factor.id);
  if (!asked.repeated)
    return fmt::format("'{}' is asked once, and mcnemar compares answers after each condition",
                       asked.item.id);
  if (asked.item.kind == ItemKind::Rating)
    return fmt::format("mcnemar compares choices, and '{}' is a rating; use wilcoxon", asked.item.id);
  if (factors_of(study, false).size() > 1)
    return fmt::format("mcnemar needs '{}' to be the only within factor", factor.id);
  if (factor.levels.size() != 2)
    return fmt::format("mcnemar compares two levels, and '{}' has {}", factor.id, factor.levels.size());
  return {};
}

std::string counts_misfit(const Study& study, Test test, const AskedItem& asked,
                          const IndependentVariable* factor) {
  if (asked.item.kind == ItemKind::Choices)
    return fmt::format("several answers to '{}' can be chosen, so their counts depend on each other",
                       asked.item.id);
  if (asked.item.kind != ItemKind::Choice && asked.item.kind != ItemKind::Rating)
    return fmt::format("'{}' has no choices that could be counted", asked.item.id);
  if (test == Test::Binomial && asked.item.kind == ItemKind::Rating)
    return fmt::format("binomial compares choices, and '{}' is a rating; use wilcoxon", asked.item.id);
  if (test == Test::McNemar) return factor == nullptr ? std::string() : changes_misfit(study, asked, *factor);
  if (factor != nullptr && !factor->between)
    return asked.repeated ? "the same people answer in each condition; mcnemar compares those"
                          : fmt::format("'{}' is asked once, so no counts belong to the levels of '{}'",
                                        asked.item.id, factor->id);
  if (asked.repeated)
    return fmt::format("everybody answers '{}' after each condition, so counts depend on each other",
                       asked.item.id);
  return {};
}

}  // namespace

std::string why_untestable(const Study& study, const Hypothesis& hypothesis) {
  const auto dependent = std::ranges::find(study.dependent, hypothesis.dependent, &DependentVariable::id);
  if (dependent == study.dependent.end() || hypothesis.test == Test::None) return {};
  const auto found = std::ranges::find(study.independent, hypothesis.factor, &IndependentVariable::id);
  const IndependentVariable* const factor = found == study.independent.end() ? nullptr : &*found;
  const bool counts = hypothesis.test == Test::ChiSquared || hypothesis.test == Test::Fisher ||
                      hypothesis.test == Test::McNemar || hypothesis.test == Test::Binomial;
  if (is_measured(*dependent))
    return counts ? fmt::format(
                        "trials measure '{}' as a number, and its test counts choices; compare means "
                        "or ranks",
                        dependent->id)
                  : std::string();
  ItemPlace place;
  if (!find_item(study, dependent->from, place)) return {};
  const Questionnaire& questionnaire = study.questionnaires[place.questionnaire];
  const bool in_conditions = questionnaire.when == AskWhen::AfterCondition;
  const AskedItem asked{questionnaire.items[place.item], in_conditions,
                        in_conditions && crossing_count(study, false, 1) > 1};
  if (counts) {
    std::string misfit = counts_misfit(study, hypothesis.test, asked, factor);
    if (!misfit.empty() || hypothesis.test != Test::Binomial) return misfit;
    return compared_answers(hypothesis, asked.item)
               ? std::string()
               : fmt::format(
                     "'{}' has {} answers, and binomial compares two; write which, as answers = "
                     "[\"a\", \"b\"]",
                     asked.item.id, asked.item.choices.size());
  }
  return factor == nullptr ? std::string() : numbers_misfit(asked, *factor);
}

}  // namespace icome::study
