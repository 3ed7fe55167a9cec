#include <cmath>
#include <map>

#include "stats/tables/sums.h"
#include "stats/tests/assumptions.h"
#include "study/analysis/analysis_parts.h"

namespace icome::study {
namespace {

/// The rows of each group of people.
std::vector<std::vector<std::size_t>> rows_by_group(const PersonTable& table) {
  std::map<Crossing, std::vector<std::size_t>> rows;
  for (std::size_t row = 0; row < table.groups.size(); ++row) rows[table.groups[row]].push_back(row);
  std::vector<std::vector<std::size_t>> all;
  for (auto& [group, of_group] : rows) all.push_back(std::move(of_group));
  return all;
}

/// Adds the residuals of values (a row a person) after the means of people and of columns; of two
/// columns, where both residuals of a person are opposite, the differences less their mean.
void add_residuals(const std::vector<std::vector<double>>& rows, std::vector<double>& residuals) {
  const std::size_t columns = rows.front().size();
  std::vector<double> means(columns);
  for (const std::vector<double>& row : rows)
    for (std::size_t i = 0; i < columns; ++i) means[i] += row[i] / double(rows.size());
  const double grand = stats::mean(means);
  for (const std::vector<double>& row : rows) {
    const double person = stats::mean(row);
    if (columns == 2) {
      residuals.push_back(row[0] - row[1] - means[0] + means[1]);
      continue;
    }
    for (std::size_t i = 0; i < columns; ++i) residuals.push_back(row[i] - person - means[i] + grand);
  }
}

}  // namespace

std::vector<double> residuals_of(const PersonTable& table, const IndependentVariable& factor) {
  std::vector<double> residuals;
  for (const std::vector<std::size_t>& rows : rows_by_group(table)) {
    const PersonTable group = rows_of(table, rows);
    if (factor.between) {
      const std::vector<double> means = person_means(group);
      for (const double value : means) residuals.push_back(value - stats::mean(means));
      continue;
    }
    const auto levels = by_level(group, factor);
    std::vector<std::vector<double>> people(rows.size());
    for (const std::vector<double>& level : levels)
      for (std::size_t i = 0; i < people.size(); ++i) people[i].push_back(level[i]);
    add_residuals(people, residuals);
  }
  return residuals;
}

std::vector<std::vector<double>> means_by_group(const PersonTable& table) {
  std::vector<std::vector<double>> groups;
  for (const std::vector<std::size_t>& rows : rows_by_group(table))
    groups.push_back(person_means(rows_of(table, rows)));
  return groups;
}

namespace {

AssumptionCheck shapiro_of(const PersonTable& table, const IndependentVariable& factor,
                           AssumptionCheck check) {
  const auto test = stats::shapiro_wilk(residuals_of(table, factor));
  if (!test) {
    check.why = test.error().message;
    return check;
  }
  check.value = test->w;
  check.p = test->p;
  return check;
}

AssumptionCheck levene_of(const PersonTable& table, AssumptionCheck check) {
  const auto test = stats::levene_test(means_by_group(table));
  if (!test) {
    check.why = test.error().message;
    return check;
  }
  check.value = test->statistic;
  check.p = test->p;
  return check;
}

AssumptionCheck mauchly_of(const PersonTable& table, const IndependentVariable& factor,
                           AssumptionCheck check) {
  const auto effect = main_effect_with_sphericity(table, factor);
  if (!effect) {
    check.why = effect.error().message;
    return check;
  }
  if (!effect->sphericity || !std::isfinite(effect->sphericity->p)) {
    check.why = "there are too few people.";
    return check;
  }
  check.value = effect->sphericity->mauchly_w;
  check.p = effect->sphericity->p;
  return check;
}

}  // namespace

std::vector<AssumptionCheck> check_assumptions(const StudyData& data) {
  std::vector<AssumptionCheck> checks;
  for (std::size_t i = 0; i < data.study.dependent.size(); ++i) {
    if (!is_measured(data.study.dependent[i])) continue;
    const PersonTable table = complete_rows(measured_table(data, data.study.dependent[i], TrialChoice::All));
    for (std::size_t j = 0; j < data.study.independent.size(); ++j) {
      const IndependentVariable& factor = data.study.independent[j];
      const bool pairs = !factor.between && factor.levels.size() == 2;
      const std::string normal(pairs ? "differences are normal" : "residuals are normal");
      checks.push_back(shapiro_of(table, factor, {i, j, "Shapiro-Wilk", normal, "W", 0.0, 1.0, {}}));
      if (factor.between)
        checks.push_back(levene_of(table, {i, j, "Levene", "groups vary alike", "F", 0.0, 1.0, {}}));
      else if (!pairs)
        checks.push_back(
            mauchly_of(table, factor,
                       {i, j, "Mauchly", "differences between conditions vary alike", "W", 0.0, 1.0, {}}));
    }
  }
  return checks;
}

}  // namespace icome::study
