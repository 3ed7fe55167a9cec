#include <fmt/format.h>

#include <cmath>

#include "stats/tables/sums.h"
#include "stats/tests/rank_tests.h"
#include "stats/tests/t_tests.h"
#include "study/analysis/analysis_question.h"

namespace icome::study {
namespace {

stats::Alternative alternative_of(const Hypothesis& hypothesis) {
  if (hypothesis.direction == Direction::Less) return stats::Alternative::Less;
  return hypothesis.direction == Direction::Greater ? stats::Alternative::Greater
                                                    : stats::Alternative::TwoSided;
}

/// The numbers that a hypothesis is about, of people who have all of them.
base::Result<PersonTable> numbers_of(const Question& question) {
  ItemPlace place;
  PersonTable table;
  if (is_measured(question.dependent)) {
    table = measured_table(question.data, question.dependent, TrialChoice::All);
  } else if (find_item(question.data.study, question.dependent.from, place)) {
    const ItemKind kind = question.data.study.questionnaires[place.questionnaire].items[place.item].kind;
    if (kind != ItemKind::Rating && kind != ItemKind::Number)
      return base::fail("the answers are no numbers; test = \"chisq\" compares counts.");
    table = answered_table(question.data, place);
  } else {
    return base::fail("nothing measures the variable.");
  }
  if (question.factor == nullptr) return base::fail("it names no factor whose levels could be compared.");
  if (!question.factor->between && table.within.empty())
    return base::fail("the question was asked once, not in each condition.");
  table = complete_rows(table);
  if (table.people.empty()) return base::fail("nobody has a number in every condition.");
  return table;
}

/// The people's means at the two levels that are compared.
struct LevelPair {
  std::vector<double> first, second;
};

base::Result<LevelPair> pair_of(const Question& question, const PersonTable& table, const char* test) {
  const auto levels = compared_levels(question);
  if (!levels) return base::fail(fmt::format("{} compares two levels; write which in `expected`.", test));
  const auto samples = by_level(table, *question.factor);
  for (const std::size_t level : {levels->first, levels->second})
    if (samples[level].empty())
      return base::fail(fmt::format("nobody is of {}.", plain_name(question.factor->levels[level])));
  return LevelPair{samples[levels->first], samples[levels->second]};
}

base::Result<TestResult> t_test(const Question& question, const PersonTable& table,
                                stats::Alternative alternative) {
  const auto pair = pair_of(question, table, "a t-test");
  if (!pair) return tl::unexpected(pair.error());
  const auto& [first, second] = *pair;
  stats::TTestSettings settings;
  settings.alternative = alternative;
  const bool between = question.factor->between;
  const auto test =
      between ? stats::welch_t_test(first, second, settings) : stats::paired_t_test(first, second, settings);
  if (!test) return tl::unexpected(test.error());
  TestResult result = plain_result(between ? "Welch's t-test" : "paired t-test", "t", test->t, {test->df},
                                   test->p, between ? first.size() + second.size() : first.size());
  result.effect = between ? "Cohen's d_s" : "Cohen's d_z";
  result.effect_size = test->d;
  result.effect_interval = test->d_interval;
  result.direction = test->t;
  return result;
}

base::Result<TestResult> wilcoxon_test(const Question& question, const PersonTable& table,
                                       stats::Alternative alternative) {
  const auto pair = pair_of(question, table, "Wilcoxon's test");
  if (!pair) return tl::unexpected(pair.error());
  const auto& [first, second] = *pair;
  if (!question.factor->between) return signed_ranks_of(first, second, alternative);
  stats::RankTestSettings settings;
  settings.alternative = alternative;
  const auto test = stats::rank_sum_test(first, second, settings);
  if (!test) return tl::unexpected(test.error());
  TestResult result = plain_result("Wilcoxon's rank sum test", "U", test->statistic, {}, test->p,
                                   first.size() + second.size());
  result.effect = "rank-biserial r";
  result.effect_size = test->rank_biserial;
  result.direction = test->rank_biserial;
  return result;
}

base::Result<TestResult> kruskal_test(const Question& question, const PersonTable& table) {
  const IndependentVariable& factor = *question.factor;
  std::vector<std::vector<double>> groups = by_level(table, factor);
  std::vector<std::string> notes;
  for (std::size_t level = 0; level < groups.size(); ++level)
    if (groups[level].empty())
      notes.push_back(fmt::format("nobody is of {}, which is left out.", plain_name(factor.levels[level])));
  std::erase_if(groups, [](const std::vector<double>& group) { return group.empty(); });
  if (groups.size() < 2)
    return base::fail(fmt::format("there are people of one level of {} only.", plain_name(factor)));
  const auto test = stats::kruskal_wallis(groups);
  if (!test) return tl::unexpected(test.error());
  TestResult result =
      plain_result("Kruskal-Wallis test", "H", test->h, {test->df}, test->p, table.people.size());
  result.effect = "ε²";
  result.effect_size = test->epsilon_squared;
  if (factor.levels.size() == 2) result.direction = test->mean_ranks[0] - test->mean_ranks[1];
  result.notes = std::move(notes);
  return result;
}

base::Result<TestResult> variance_test(const Question& question, const PersonTable& table) {
  auto result = main_effect(table, *question.factor);
  if (!result || question.factor->levels.size() != 2) return result;
  const auto samples = by_level(table, *question.factor);
  if (!samples[0].empty() && !samples[1].empty())
    result->direction = stats::mean(samples[0]) - stats::mean(samples[1]);
  return result;
}

/// The test for an expectation about two of several levels: that of these two, as the test of all can be
/// significant because of the others. The test of all is reported in a note.
base::Result<TestResult> decided_by_pair(const Question& question, const PersonTable& table,
                                         base::Result<TestResult> all) {
  const bool two = question.factor->levels.size() == 2;
  if (question.hypothesis.direction == Direction::Differ) return all;
  const auto levels = compared_levels(question);
  if (!levels) return base::fail("`expected` names a level that was left out of the study.");
  if (two) {
    if (all && levels->first > levels->second) all->direction = -all->direction;
    return all;
  }
  auto pair = question.test == Test::Anova ? t_test(question, table, stats::Alternative::TwoSided)
                                           : wilcoxon_test(question, table, stats::Alternative::TwoSided);
  if (!pair) return pair;
  const std::size_t count = question.factor->levels.size();
  if (!all) {
    pair->notes.push_back(fmt::format("All {} levels: not computed, as {}", count, all.error().message));
    return pair;
  }
  pair->notes.push_back(fmt::format("All {} levels: {}, {}.", count, all->test, result_words(*all)));
  pair->notes.insert(pair->notes.end(), all->notes.begin(), all->notes.end());
  return pair;
}

base::Result<TestResult> test_table(const Question& question, const PersonTable& table) {
  const bool between = question.factor->between;
  switch (question.test) {
    case Test::TTest:
      return t_test(question, table, alternative_of(question.hypothesis));
    case Test::Wilcoxon:
      return wilcoxon_test(question, table, alternative_of(question.hypothesis));
    case Test::Kruskal:
      if (!between)
        return base::fail(
            "Kruskal and Wallis's test compares different people; test = \"friedman\" the same.");
      return decided_by_pair(question, table, kruskal_test(question, table));
    case Test::Friedman:
      if (between)
        return base::fail("Friedman's test compares the same people; test = \"kruskal\" different ones.");
      return decided_by_pair(question, table, friedman_of(by_level(table, *question.factor)));
    default:
      return decided_by_pair(question, table, variance_test(question, table));
  }
}

}  // namespace

base::Result<TestResult> test_numbers(const Question& question) {
  const auto table = numbers_of(question);
  if (!table) return tl::unexpected(table.error());
  auto result = test_table(question, *table);
  if (result) result->doubts = doubts_of(question, *table, *result);
  return result;
}

}  // namespace icome::study
