#include <algorithm>
#include <limits>

#include "stats/models/post_hoc.h"
#include "study/analysis/analysis_question.h"

namespace icome::study {
namespace {

std::size_t level_named(const IndependentVariable& factor, const std::string& id) {
  return std::size_t(std::ranges::find(factor.levels, id, &Level::id) - factor.levels.begin());
}

/// The test that a hypothesis names, or else the one that fits its variables.
Test test_of(const Hypothesis& hypothesis, const DependentVariable& dependent,
             const IndependentVariable* factor) {
  if (hypothesis.test != Test::None) return hypothesis.test;
  if (!is_measured(dependent) && dependent.scale == Scale::Nominal) return Test::ChiSquared;
  if (dependent.scale != Scale::Ordinal || factor == nullptr) return Test::Anova;
  if (factor->levels.size() == 2) return Test::Wilcoxon;
  return factor->between ? Test::Kruskal : Test::Friedman;
}

bool counts_answers(Test test) {
  return test == Test::ChiSquared || test == Test::Fisher || test == Test::McNemar || test == Test::Binomial;
}

/// Does the test's result have the direction that the hypothesis gives? Nothing if either is missing.
std::optional<bool> as_expected(const Question& question, const Tested& test) {
  if (question.hypothesis.direction == Direction::Differ || !test.result) return {};
  const double difference = test.result->direction;
  return question.hypothesis.direction == Direction::Less ? difference < 0.0 : difference > 0.0;
}

Decision decide(const HypothesisResult& result, double alpha) {
  if (!result.p_holm) return Decision::NotComputed;
  if (*result.p_holm >= alpha || result.held_back) return Decision::NotShown;
  // A one-sided test can find nothing but the expected direction.
  return result.one_sided || result.as_expected.value_or(true) ? Decision::Shown : Decision::Opposite;
}

HypothesisResult test_hypothesis(const StudyData& data, std::size_t index) {
  const Hypothesis& hypothesis = data.study.hypotheses[index];
  HypothesisResult result;
  result.hypothesis = index;
  const auto dependent =
      std::ranges::find(data.study.dependent, hypothesis.dependent, &DependentVariable::id);
  if (dependent == data.study.dependent.end()) {
    result.test.why = "it names no variable of the study.";
    return result;
  }
  const auto found = std::ranges::find(data.study.independent, hypothesis.factor, &IndependentVariable::id);
  const IndependentVariable* const factor = found == data.study.independent.end() ? nullptr : &*found;
  const Question question{data, hypothesis, *dependent, factor, test_of(hypothesis, *dependent, factor)};
  result.test = tested(counts_answers(question.test) ? test_counts(question) : test_numbers(question));
  result.primary = hypothesis.primary;
  if (hypothesis.beside == Test::ChiSquared && result.test.result)
    result.beside = shares_that_agree(question);
  result.as_expected = as_expected(question, result.test);
  result.one_sided =
      hypothesis.direction != Direction::Differ &&
      (question.test == Test::TTest || question.test == Test::Wilcoxon || question.test == Test::Binomial);
  if (result.one_sided && result.test.result) result.test.result->test += ", one-sided";
  return result;
}

/// Adjusts p after Holm (1979) over all hypotheses that were tested; if one is primary, its own p is its
/// adjusted one, and the others, adjusted among each other, are shown only after it (serial gatekeeping:
/// Westfall and Krishen 2001). Either way the probability that any is shown wrongly stays below the level.
void adjust_p(const Study& study, std::vector<HypothesisResult>& results) {
  std::vector<double> p;
  bool open = true;
  for (HypothesisResult& result : results) {
    const std::optional<TestResult>& test = result.test.result;
    p.push_back(test && !result.primary ? test->p : std::numeric_limits<double>::quiet_NaN());
    if (!result.primary) continue;
    if (test) result.p_holm = test->p;
    open = test && test->p < study.hypotheses[result.hypothesis].alpha;
  }
  const std::vector<double> adjusted = stats::holm(p);
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].test.result || results[i].primary) continue;
    results[i].p_holm = adjusted[i];
    results[i].held_back = !open && adjusted[i] < study.hypotheses[results[i].hypothesis].alpha;
  }
}

}  // namespace

std::optional<std::pair<std::size_t, std::size_t>> compared_levels(const Question& question) {
  const IndependentVariable& factor = *question.factor;
  if (question.hypothesis.direction == Direction::Differ)
    return factor.levels.size() == 2 ? std::optional(std::pair<std::size_t, std::size_t>{0, 1})
                                     : std::nullopt;
  const std::size_t first = level_named(factor, question.hypothesis.first);
  const std::size_t second = level_named(factor, question.hypothesis.second);
  if (std::max(first, second) >= factor.levels.size()) return {};
  return std::pair{first, second};
}

std::vector<HypothesisResult> test_hypotheses(const StudyData& data) {
  std::vector<HypothesisResult> results;
  for (std::size_t i = 0; i < data.study.hypotheses.size(); ++i) results.push_back(test_hypothesis(data, i));
  adjust_p(data.study, results);
  for (HypothesisResult& result : results)
    result.decision = decide(result, data.study.hypotheses[result.hypothesis].alpha);
  return results;
}

}  // namespace icome::study
