#include <algorithm>
#include <cmath>
#include <set>

#include "stats/models/post_hoc.h"
#include "stats/tables/sums.h"
#include "stats/tests/correlation.h"
#include "study/analysis/analysis_parts.h"

namespace icome::study {
namespace {

/// The rows of people who are not more than two standard deviations from the mean of any level (the thesis's
/// footnote in 6.4.1).
std::vector<std::size_t> usual_rows(const PersonTable& table, const IndependentVariable& factor) {
  std::set<std::size_t> unusual;
  for (std::size_t level = 0; level < factor.levels.size(); ++level) {
    const PersonTable part = at_level(table, factor, level);
    const std::vector<double> means = person_means(part);
    const auto report = stats::describe_outliers(means);
    if (!report) continue;  // nobody is there
    for (const std::size_t outlier : report->outliers) unusual.insert(part.people[outlier]);
  }
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.people.size(); ++row)
    if (!unusual.contains(table.people[row])) rows.push_back(row);
  return rows;
}

/// The part of a table that a result table is about.
PersonTable part_of(const StudyData& data, PersonTable table, const ResultTable& what) {
  if (!what.within_level) return table;
  return at_level(table, data.study.independent[what.within_level->first], what.within_level->second);
}

/// Compares all pairs of levels, by paired t-tests of the same people or by Welch's of different people.
std::vector<LevelComparison> compare_levels(const std::vector<std::vector<double>>& levels, bool between) {
  std::vector<LevelComparison> pairs;
  if (levels.size() < 3) return pairs;
  std::vector<std::vector<double>> groups;
  std::vector<std::size_t> which;
  for (std::size_t level = 0; level < levels.size(); ++level) {
    if (levels[level].empty()) continue;
    groups.push_back(levels[level]);
    which.push_back(level);
  }
  const auto error = between ? stats::PairwiseError::Separate : stats::PairwiseError::Paired;
  const auto tests = stats::pairwise_t_tests(groups, stats::Adjustment::Holm, error);
  if (!tests) return pairs;  // some do not vary
  for (const stats::PairComparison& test : *tests)
    if (std::isfinite(test.p)) pairs.push_back({which[test.first], which[test.second], test.p});
  return pairs;
}

ResultRow mean_row(const StudyData& data, const ResultTable& what, std::size_t variable) {
  const IndependentVariable& factor = data.study.independent[what.factor];
  const PersonTable table =
      complete_rows(part_of(data, measured_table(data, data.study.dependent[variable], what.trials), what));
  ResultRow row;
  row.variable = variable;
  row.people = table.people.size();
  const auto levels = by_level(table, factor);
  for (const std::vector<double>& means : levels)
    row.levels.push_back(means.empty() ? std::nullopt : std::optional(stats::mean(means)));
  row.test = tested(main_effect(table, factor));
  row.pairs = compare_levels(levels, factor.between);
  const std::vector<std::size_t> usual = usual_rows(table, factor);
  row.outliers = table.people.size() - usual.size();
  if (row.outliers > 0) row.without_outliers = tested(main_effect(rows_of(table, usual), factor));
  return row;
}

/// The row of totals of counts of the same people. Nothing if levels differ in their numbers of trials, as
/// with groups of unequal size: such totals say how many trials there were. Otherwise the totals are the
/// means times a number, and the test of the means is theirs.
std::optional<ResultRow> total_row(const StudyData& data, const ResultTable& what, const ResultRow& means) {
  const IndependentVariable& factor = data.study.independent[what.factor];
  const DependentVariable& variable = data.study.dependent[means.variable];
  const PersonTable table =
      complete_rows(part_of(data, measured_table(data, variable, what.trials, TrialSum::Total), what));
  ResultRow row = means;
  row.total = true;
  row.levels.clear();
  std::set<std::size_t> sizes;
  for (std::size_t level = 0; level < factor.levels.size(); ++level) {
    const PersonTable part = at_level(table, factor, level);
    sizes.insert(part.people.size() * part.columns.size());
    double total = 0.0;
    for (const std::vector<double>& values : part.values) total += stats::sum(values);
    row.levels.push_back(means.levels[level] ? std::optional(total) : std::nullopt);
  }
  if (sizes.size() > 1) return {};
  return row;
}

ResultTable filled(const StudyData& data, ResultTable table) {
  for (std::size_t i = 0; i < data.study.dependent.size(); ++i) {
    if (!is_measured(data.study.dependent[i])) continue;
    table.rows.push_back(mean_row(data, table, i));
    if (data.study.dependent[i].from == "errors") {
      const std::optional<ResultRow> totals = total_row(data, table, table.rows.back());
      if (totals) table.rows.push_back(*totals);
    }
  }
  return table;
}

}  // namespace

std::vector<ResultTable> result_tables(const StudyData& data) {
  std::vector<ResultTable> tables;
  const std::vector<IndependentVariable>& factors = data.study.independent;
  if (std::ranges::none_of(data.study.dependent, is_measured)) return tables;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    tables.push_back(filled(data, {i, TrialChoice::All, {}, {}}));
    tables.push_back(filled(data, {i, TrialChoice::Last, {}, {}}));
  }
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (std::size_t other = 0; other < factors.size(); ++other)
      for (std::size_t level = 0; other != i && level < factors[other].levels.size(); ++level)
        tables.push_back(filled(data, {i, TrialChoice::All, std::pair{other, level}, {}}));
  return tables;
}

std::vector<VarianceAnalysis> analyse_variances(const StudyData& data) {
  std::vector<VarianceAnalysis> all;
  if (data.study.independent.size() < 2) return all;
  for (std::size_t i = 0; i < data.study.dependent.size(); ++i)
    if (is_measured(data.study.dependent[i]))
      all.push_back(
          analyse_variance(data.study, measured_table(data, data.study.dependent[i], TrialChoice::All), i));
  return all;
}

CorrelationTable correlate_quantities(const StudyData& data) {
  CorrelationTable table;
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < data.study.dependent.size(); ++i) {
    const DependentVariable& variable = data.study.dependent[i];
    if (!is_measured(variable)) continue;
    table.variables.push_back(i);
    // A person who lacks a condition has a NaN as mean, which leaves that person out.
    columns.push_back(person_means(measured_table(data, variable, TrialChoice::All)));
  }
  const std::size_t count = columns.size();
  table.r = table.p = Eigen::MatrixXd::Constant(Eigen::Index(count), Eigen::Index(count), NAN);
  table.counts = Eigen::MatrixXi::Zero(Eigen::Index(count), Eigen::Index(count));
  if (count == 0 || columns.front().empty()) return table;
  if (const auto matrix = stats::correlation_matrix(columns)) {
    table.r = matrix->r;
    table.p = matrix->p;
    table.counts = matrix->counts;
  }
  return table;
}

}  // namespace icome::study
