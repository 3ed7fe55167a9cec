#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stats/models/anova.h"
#include "stats/tables/sums.h"
#include "stats/tests/contingency.h"
#include "stats/tests/correlation.h"
#include "study/analysis/analysis_parts.h"

namespace icome::study {
namespace {

/// Keeps the trials at one level of a factor.
TrialList trials_at(const TrialList& all, std::size_t factor, std::size_t level) {
  TrialList some;
  some.levels.resize(all.levels.size());
  for (std::size_t trial = 0; trial < all.values.size(); ++trial) {
    if (all.levels[factor][trial] != level) continue;
    some.values.push_back(all.values[trial]);
    for (std::size_t i = 0; i < all.levels.size(); ++i) some.levels[i].push_back(all.levels[i][trial]);
  }
  return some;
}

TrialList trials_of_table(const StudyData& data, const ThesisTable& what, std::size_t variable) {
  const TrialList all = measured_trials(data, data.study.dependent[variable], what.trials);
  return what.within_level ? trials_at(all, what.within_level->first, what.within_level->second) : all;
}

/// The numbers of each level's trials, without those that have none.
std::vector<std::vector<double>> values_by_level(const TrialList& trials, std::size_t factor,
                                                 std::size_t levels) {
  std::vector<std::vector<double>> by_level(levels);
  for (std::size_t i = 0; i < trials.values.size(); ++i)
    if (std::isfinite(trials.values[i])) by_level[trials.levels[factor][i]].push_back(trials.values[i]);
  return by_level;
}

stats::Factor stats_factor(const IndependentVariable& factor, const std::vector<std::size_t>& levels) {
  stats::Factor column;
  column.name = factor.id;
  for (const Level& level : factor.levels) column.levels.push_back(level.id);
  for (const std::size_t level : levels) column.of.push_back(int(level));
  return column;
}

/// The main effect of a factor by an analysis of variance over all measurements, of all factors that the
/// table's trials differ in.
base::Result<TestResult> effect_over_trials(const StudyData& data, const ThesisTable& what,
                                            const TrialList& trials) {
  std::vector<stats::Factor> factors;
  int place = 0;
  for (std::size_t i = 0; i < trials.levels.size(); ++i) {
    if (what.within_level && what.within_level->first == i) continue;
    if (i == what.factor) place = int(factors.size());
    factors.push_back(stats_factor(data.study.independent[i], trials.levels[i]));
  }
  const auto anova = factors.size() == 1 ? stats::one_way_anova(trials.values, factors.front())
                                         : stats::factorial_anova(trials.values, factors);
  if (!anova) return tl::unexpected(anova.error());
  const auto term = std::ranges::find(anova->terms, std::vector{place}, &stats::AnovaTerm::factors);
  if (term == anova->terms.end() || !std::isfinite(term->f) || !std::isfinite(term->p))
    return base::fail("there is nothing to compare, as nothing varies.");
  const std::string ways = factors.size() == 1 ? "one-way" : factors.size() == 2 ? "two-way" : "factorial";
  return plain_result(fmt::format("{} ANOVA over trials", ways), "F", term->f,
                      {double(term->df), double(anova->residual.df)}, term->p, anova->n);
}

ThesisRow thesis_row(const StudyData& data, const ThesisTable& what, std::size_t variable) {
  const TrialList trials = trials_of_table(data, what, variable);
  ThesisRow row;
  row.variable = variable;
  row.total = data.study.dependent[variable].from == "errors";
  for (const std::vector<double>& values :
       values_by_level(trials, what.factor, data.study.independent[what.factor].levels.size())) {
    row.trials += values.size();
    const auto value = [&] { return row.total ? stats::sum(values) : stats::mean(values); };
    row.levels.push_back(values.empty() ? std::nullopt : std::optional(value()));
  }
  row.test = tested(effect_over_trials(data, what, trials));
  return row;
}

/// Do the levels differ in their shares of wrong choices? (Pearson's chi-squared.)
base::Result<TestResult> wrong_shares(const std::vector<ChoiceCount>& counts) {
  stats::CountTable table;
  std::size_t choices = 0;
  for (const ChoiceCount& count : counts) {
    if (count.choices == 0) continue;
    table.push_back({double(count.wrong), double(count.choices - count.wrong)});
    choices += count.choices;
  }
  const auto test = stats::contingency_test(table);
  if (!test) return tl::unexpected(test.error());
  return plain_result("Pearson's chi-squared test over choices", "χ²", test->chi_squared, {test->df}, test->p,
                      choices);
}

/// Counts the choices of the table's trials: the wrong ones, and one that was right in each trial that came
/// to its end.
void count_choices(const StudyData& data, ThesisTable& table) {
  const auto is_errors = [](const DependentVariable& variable) { return variable.from == "errors"; };
  const auto errors = std::ranges::find_if(data.study.dependent, is_errors);
  if (errors == data.study.dependent.end()) return;
  DependentVariable time = *errors;
  time.from = "time";  // which only completed trials have
  time.unit = "s";
  const TrialList wrong = trials_of_table(data, table, std::size_t(errors - data.study.dependent.begin()));
  TrialList right = measured_trials(data, time, table.trials);
  if (table.within_level) right = trials_at(right, table.within_level->first, table.within_level->second);
  table.choices.resize(data.study.independent[table.factor].levels.size());
  for (std::size_t i = 0; i < wrong.values.size(); ++i) {
    ChoiceCount& count = table.choices[wrong.levels[table.factor][i]];
    count.wrong += std::size_t(wrong.values[i]);
    count.choices += std::size_t(wrong.values[i]) + (std::isfinite(right.values[i]) ? 1U : 0U);
  }
  table.choices_test = tested(wrong_shares(table.choices));
}

ThesisTable filled_thesis_table(const StudyData& data, ThesisTable table) {
  for (std::size_t i = 0; i < data.study.dependent.size(); ++i)
    if (is_measured(data.study.dependent[i])) table.rows.push_back(thesis_row(data, table, i));
  count_choices(data, table);
  return table;
}

}  // namespace

std::vector<ThesisTable> thesis_tables(const StudyData& data) {
  std::vector<ThesisTable> tables;
  const std::vector<IndependentVariable>& factors = data.study.independent;
  if (std::ranges::none_of(data.study.dependent, is_measured)) return tables;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    tables.push_back(filled_thesis_table(data, {i, TrialChoice::All, {}, {}, {}, {}}));
    tables.push_back(filled_thesis_table(data, {i, TrialChoice::Last, {}, {}, {}, {}}));
    for (std::size_t other = 0; other < factors.size(); ++other)
      for (std::size_t level = 0; other != i && level < factors[other].levels.size(); ++level)
        tables.push_back(
            filled_thesis_table(data, {i, TrialChoice::All, std::pair{other, level}, {}, {}, {}}));
  }
  return tables;
}

ThesisCorrelations thesis_correlations(const StudyData& data) {
  ThesisCorrelations found;
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < data.study.dependent.size(); ++i) {
    if (!is_measured(data.study.dependent[i])) continue;
    found.variables.push_back(i);
    columns.push_back(measured_trials(data, data.study.dependent[i], TrialChoice::All).values);
  }
  const auto count = Eigen::Index(columns.size());
  found.r = Eigen::MatrixXd::Constant(count, count, NAN);
  found.counts = Eigen::MatrixXi::Zero(count, count);
  if (count == 0 || columns.front().empty()) return found;
  if (const auto matrix = stats::correlation_matrix(columns)) {
    found.r = matrix->r;
    found.counts = matrix->counts;
  }
  return found;
}

}  // namespace icome::study
