#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "stats/tables/sums.h"
#include "stats/tests/assumptions.h"
#include "study/analysis/analysis_question.h"

namespace icome::study {
namespace {

constexpr double kDoubt = 0.05;  // an assumption with a smaller p is reported to fail

/// Keeps only the conditions, or people, of two levels; the factor keeps its place.
PersonTable only_levels(const PersonTable& table, const IndependentVariable& factor, std::size_t first,
                        std::size_t second) {
  const auto taken = [&](std::size_t level) { return level == first || level == second; };
  if (factor.between) {
    const auto place = std::size_t(std::ranges::find(table.between, &factor) - table.between.begin());
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < table.groups.size(); ++row)
      if (taken(table.groups[row][place])) rows.push_back(row);
    return rows_of(table, rows);
  }
  const auto place = std::size_t(std::ranges::find(table.within, &factor) - table.within.begin());
  PersonTable part{table.within, table.between, {}, table.people, table.groups, {}};
  part.values.resize(table.values.size());
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    if (!taken(table.columns[column][place])) continue;
    part.columns.push_back(table.columns[column]);
    for (std::size_t row = 0; row < table.values.size(); ++row)
      part.values[row].push_back(table.values[row][column]);
  }
  return part;
}

/// "Menu × Forces".
std::string factors_text(const Study& study, const std::vector<std::string>& ids) {
  std::string text;
  for (const std::string& id : ids) {
    const auto factor = std::ranges::find(study.independent, id, &IndependentVariable::id);
    text += fmt::format("{}{}", text.empty() ? "" : " × ",
                        factor == study.independent.end() ? id : plain_name(*factor));
  }
  return text;
}

void add_interactions(const Question& question, const PersonTable& table, std::vector<std::string>& doubts) {
  const Study& study = question.data.study;
  for (const Interaction& interaction : interactions_of(table, *question.factor)) {
    if (interaction.result.p >= question.hypothesis.alpha) continue;
    std::vector<std::string> others = interaction.factors;
    std::erase(others, question.factor->id);
    doubts.push_back(fmt::format("it depends on {}, by the interaction {}: {}", factors_text(study, others),
                                 factors_text(study, interaction.factors), result_words(interaction.result)));
  }
}

/// The values that a t-test of two levels assumes to be normal: differences of the same people, or the
/// deviations of each group from its mean.
std::vector<double> pair_residuals(const PersonTable& table, const IndependentVariable& factor,
                                   std::size_t first, std::size_t second) {
  const auto levels = by_level(table, factor);
  std::vector<double> residuals;
  if (!factor.between) {
    for (std::size_t i = 0; i < levels[first].size(); ++i)
      residuals.push_back(levels[first][i] - levels[second][i]);
    return residuals;
  }
  for (const std::size_t level : {first, second})
    for (const double value : levels[level]) residuals.push_back(value - stats::mean(levels[level]));
  return residuals;
}

void add_normality(const std::vector<double>& residuals, const char* what, std::vector<std::string>& doubts) {
  const auto test = stats::shapiro_wilk(residuals);
  if (test && test->p < kDoubt)
    doubts.push_back(fmt::format("{} are not normal (Shapiro-Wilk {})", what, p_words(test->p)));
}

/// Adds doubts about an analysis of variance: unequal variances of groups, or a lack of sphericity.
void add_variances(const Question& question, const PersonTable& table, std::vector<std::string>& doubts) {
  if (question.factor->between) {
    const auto levene = stats::levene_test(means_by_group(table));
    if (levene && levene->p < kDoubt)
      doubts.push_back(fmt::format("groups do not vary alike (Levene {})", p_words(levene->p)));
    return;
  }
  const auto effect = main_effect_with_sphericity(table, *question.factor);
  if (effect && effect->sphericity && effect->sphericity->p < kDoubt)
    doubts.push_back(
        fmt::format("differences between conditions do not vary alike (Mauchly {}), for which p "
                    "is corrected",
                    p_words(effect->sphericity->p)));
}

}  // namespace

std::vector<std::string> doubts_of(const Question& question, const PersonTable& table,
                                   const TestResult& result) {
  std::vector<std::string> doubts;
  const auto levels = compared_levels(question);
  const IndependentVariable& factor = *question.factor;
  const bool of_pair = levels && factor.levels.size() > 2;
  add_interactions(question, of_pair ? only_levels(table, factor, levels->first, levels->second) : table,
                   doubts);
  if (question.test != Test::Anova && question.test != Test::TTest) return doubts;
  const bool by_t = result.statistic == "t";
  const bool differences = !factor.between && (by_t || factor.levels.size() == 2);
  add_normality(
      by_t ? pair_residuals(table, factor, levels->first, levels->second) : residuals_of(table, factor),
      differences ? "differences" : "residuals", doubts);
  if (!by_t) add_variances(question, table, doubts);
  if (question.dependent.scale == Scale::Ordinal)
    doubts.emplace_back("these are means of an ordinal variable, which a test of ranks fits");
  return doubts;
}

std::string p_words(double p) {
  if (p < 0.001) return "p < .001";
  return p > 0.9994 ? "p > .999" : fmt::format("p = .{:03.0f}", 1000.0 * p);
}

std::string result_words(const TestResult& result) {
  std::string df;
  for (const double number : result.df)
    df += fmt::format("{}{:.{}f}", df.empty() ? "" : ", ", number, number == std::round(number) ? 0 : 2);
  return fmt::format("{}({}) = {:.2f}, {}", result.statistic, df, result.value, p_words(result.p));
}

}  // namespace icome::study
