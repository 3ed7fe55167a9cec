#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"
#include "stats/models/within_intervals.h"
#include "study/definition/conditions.h"

namespace icome::apps {
namespace {

constexpr int kDigits = 4;

std::string row_name(const study::DependentVariable& variable, const study::ResultRow& row) {
  if (row.total) return fmt::format("{}, total", quantity_name(variable));
  return fmt::format("{}, mean{}", quantity_name(variable), variable.from == "errors" ? " a trial" : "");
}

/// The cells of the levels, all with as many decimals as the largest needs.
std::vector<std::string> level_cells(const study::ResultRow& row) {
  double largest = 0.0;
  for (const std::optional<double>& level : row.levels)
    if (level) largest = std::max(largest, std::abs(*level));
  const int decimals = row.total ? 0 : std::min(3, decimals_for(largest, kDigits));
  std::vector<std::string> cells;
  for (const std::optional<double>& level : row.levels)
    cells.push_back(level ? fixed_text(*level, decimals) : "-");
  return cells;
}

void add_once(std::vector<std::string>& notes, const std::string& note) {
  if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
}

/// The note of the thesis's footnote in 6.4.1, which asks for results with and without outliers.
std::string outlier_note(const study::DependentVariable& variable, const study::ResultRow& row) {
  const std::string people = row.outliers == 1 ? "one person" : fmt::format("{} people", row.outliers);
  const std::string without = row.without_outliers.result ? unbroken(p_text(row.without_outliers.result->p))
                                                          : std::string("not computed");
  return fmt::format("{}: {} more than 2 SD from the mean of a level; without, {}.",
                     name_of(variable.name, variable.id), people, without);
}

/// "A and B p = .012, ...": the pairs of levels, which show where three or more differ.
std::string pairs_note(const study::IndependentVariable& factor, const std::string& variable,
                       const study::ResultRow& row) {
  std::string pairs;
  for (const study::LevelComparison& pair : row.pairs) {
    const study::Level &first = factor.levels[pair.first], &second = factor.levels[pair.second];
    pairs += fmt::format("{}{} and {} {}", pairs.empty() ? "" : "; ", name_of(first.name, first.id),
                         name_of(second.name, second.id), unbroken(p_text(pair.p)));
  }
  return fmt::format("{} ({} t-tests of pairs, after Holm): {}.", variable,
                     factor.between ? "Welch's" : "paired", pairs);
}

std::vector<std::string> notes_of(const study::Study& study, const study::ResultTable& table) {
  std::vector<std::string> notes;
  for (const study::ResultRow& row : table.rows) {
    if (!row.test.result) continue;
    add_once(notes,
             fmt::format("P: {}, main effect of {}.", row.test.result->test,
                         name_of(study.independent[table.factor].name, study.independent[table.factor].id)));
  }
  bool same = true;
  for (const study::ResultRow& row : table.rows) same = same && row.people == table.rows.front().people;
  if (same && !table.rows.empty()) notes.push_back(fmt::format("n = {} people.", table.rows.front().people));
  for (const study::ResultRow& row : table.rows) {
    if (row.total) continue;
    const study::DependentVariable& variable = study.dependent[row.variable];
    const std::string name = name_of(variable.name, variable.id);
    if (!same) notes.push_back(fmt::format("{}: n = {}.", name, row.people));
    if (!row.test.result) notes.push_back(fmt::format("{}: no P, as {}", name, row.test.why));
    if (!row.pairs.empty()) notes.push_back(pairs_note(study.independent[table.factor], name, row));
    if (row.outliers > 0) notes.push_back(outlier_note(variable, row));
    if (row.test.result)
      for (const std::string& note : row.test.result->notes)
        add_once(notes, fmt::format("{}: {}", name, as_sentence(note)));
  }
  return notes;
}

void write_table(StudyPage& page, const study::ResultTable& results) {
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = table_title(study, results) + ".";
  table.headings = {""};
  for (const study::Level& level : study.independent[results.factor].levels)
    table.headings.push_back(name_of(level.name, level.id));
  table.headings.emplace_back("P-value");
  for (const study::ResultRow& row : results.rows) {
    std::vector<std::string> cells = level_cells(row);
    cells.insert(cells.begin(), row_name(study.dependent[row.variable], row));
    cells.push_back(row.test.result ? p_cell(row.test.result->p) : "-");
    table.rows.push_back(std::move(cells));
  }
  table.notes = notes_of(study, results);
  page.table(table);
}

std::string term_name(const study::Study& study, const study::AnalysisTerm& term) {
  std::string name;
  for (const std::size_t factor : term.factors) {
    const study::IndependentVariable& variable = study.independent[factor];
    name += fmt::format("{}{}", name.empty() ? "" : " \u00d7 ", name_of(variable.name, variable.id));
  }
  return name;
}

/// All terms of the analysis of a variable, interactions too.
void write_variance(StudyPage& page, const study::VarianceAnalysis& variance) {
  const study::Study& study = page.data().study;
  const study::DependentVariable& variable = study.dependent[variance.variable];
  PageTable table;
  table.headings = {"", "F", "P-value", "Effect"};
  std::string test;
  std::size_t people = 0;
  for (const study::AnalysisTerm& term : variance.terms) {
    if (!term.test.result) {
      table.rows.push_back({term_name(study, term), "-", "-", "-"});
      add_once(table.notes, fmt::format("{}: {}", term_name(study, term), term.test.why));
      continue;
    }
    const study::TestResult& result = *term.test.result;
    test = result.test;
    people = result.people;
    table.rows.push_back(
        {term_name(study, term), statistic_text(result), p_cell(result.p), effect_text(result)});
    for (const std::string& note : result.notes)
      add_once(table.notes, fmt::format("{}: {}", term_name(study, term), as_sentence(note)));
  }
  if (people > 0) table.notes.insert(table.notes.begin(), fmt::format("n = {} people.", people));
  table.caption =
      fmt::format("{}: all terms of the {}, interactions (\u00d7) with them.",
                  name_of(variable.name, variable.id), test.empty() ? "analysis of variance" : test);
  page.table(table);
}

/// The rows of a group's people, less their overall differences where each has several conditions.
std::vector<std::vector<double>> comparable(const std::vector<std::vector<double>>& rows) {
  if (rows.empty() || rows.front().size() < 2) return rows;
  const auto moved = stats::without_person_differences(rows);
  return moved ? *moved : rows;
}

/// Means of conditions (along x) and groups (by colour); with one condition the groups stand along x.
StatsChart chart_of(const study::StudyData& data, const study::DependentVariable& variable,
                    const study::PersonTable& table) {
  const study::Study& study = data.study;
  StatsChart chart;
  chart.kind = ChartKind::Bars;
  chart.title = fmt::format("{} people", table.people.size());
  chart.y_label = quantity_name(variable);
  const auto groups = study::crossings(study, true);
  const bool repeated = table.columns.size() > 1;
  chart.within_people = repeated;
  chart.x_label = repeated ? "condition" : "group";
  for (std::size_t i = 0; i < (repeated ? table.columns.size() : groups.size()); ++i)
    chart.groups.push_back(condition_name(study, !repeated, i));
  for (std::size_t i = 0; i < (repeated ? groups.size() : 1); ++i)
    chart.series.push_back(repeated && groups.size() > 1 ? condition_name(study, true, i) : std::string());
  if (chart.series.size() > 1) chart.series_label = "group";
  chart.values.assign(chart.series.size(), std::vector<std::vector<double>>(chart.groups.size()));
  for (std::size_t group = 0; group < groups.size(); ++group) {
    std::vector<std::vector<double>> rows;
    for (std::size_t row = 0; row < table.values.size(); ++row)
      if (table.groups[row] == groups[group]) rows.push_back(table.values[row]);
    for (const std::vector<double>& row : comparable(rows))
      for (std::size_t column = 0; column < row.size(); ++column)
        chart.values[repeated ? group : 0][repeated ? column : group].push_back(row[column]);
  }
  return chart;
}

void write_quantity_figure(StudyPage& page, const study::DependentVariable& variable) {
  const study::PersonTable table =
      complete_rows(study::measured_table(page.data(), variable, study::TrialChoice::All));
  if (table.people.empty()) return;
  const StatsChart chart = chart_of(page.data(), variable, table);
  const std::string between(chart.series.size() > 1 ? ", not between groups" : "");
  const std::string intervals =
      chart.within_people
          ? fmt::format(
                "whiskers are 95 % within-subject confidence intervals (Cousineau 2005, corrected after "
                "Morey 2008), which show differences between conditions{}",
                between)
          : std::string("whiskers are 95 % confidence intervals");
  page.figure(chart, fmt::format("{} by {}. Bars are means over people; {}.", quantity_name(variable),
                                 chart.x_label, intervals));
}

/// "8 people"; "6 to 8 people" where pairs of quantities differ.
std::string pair_counts_text(const Eigen::MatrixXi& counts) {
  int least = counts(1, 0), most = least;
  for (Eigen::Index i = 0; i < counts.rows(); ++i) {
    for (Eigen::Index k = 0; k < i; ++k) {
      least = std::min(least, counts(i, k));
      most = std::max(most, counts(i, k));
    }
  }
  return least == most ? fmt::format("{} people", most) : fmt::format("{} to {} people", least, most);
}

}  // namespace

void write_results(StudyPage& page) {
  if (page.analysis().tables.empty()) return;
  page.heading("Results");
  const study::ParticipantSummary& people = page.analysis().participants;
  page.paragraph(fmt::format(
      "Values are means of people's means over measured trials; a person counts who has done all trials of "
      "every condition that is compared, and has a number there. P-values of tables are plain and decide "
      "nothing: the hypotheses below do. {}",
      people.not_completed == 0
          ? fmt::format("All {} measured trials were completed.", people.trials)
          : fmt::format("{} of {} measured trials were not completed: they do not count in times.",
                        people.not_completed, people.trials)));
  for (const study::ResultTable& table : page.analysis().tables) write_table(page, table);
  for (const study::VarianceAnalysis& variance : page.analysis().variances) write_variance(page, variance);
  for (const study::DependentVariable& variable : page.data().study.dependent)
    if (study::is_measured(variable)) write_quantity_figure(page, variable);
}

void write_correlations(StudyPage& page) {
  const study::CorrelationTable& found = page.analysis().correlations;
  const Eigen::Index count = Eigen::Index(found.variables.size());
  if (count < 2) return;
  page.subheading("Correlations");
  PageTable table;
  table.caption = "Correlations between people's means: Pearson's r, with its P-value.";
  table.headings = {""};
  for (Eigen::Index i = 0; i + 1 < count; ++i) {
    const study::DependentVariable& variable = page.data().study.dependent[found.variables[std::size_t(i)]];
    table.headings.push_back(name_of(variable.name, variable.id));
  }
  for (Eigen::Index i = 0; i < count; ++i) {
    const study::DependentVariable& variable = page.data().study.dependent[found.variables[std::size_t(i)]];
    std::vector<std::string> row = {name_of(variable.name, variable.id)};
    for (Eigen::Index k = 0; k + 1 < count; ++k) {
      const bool known = k < i && std::isfinite(found.r(i, k));
      row.push_back(k == i  ? "1.0"
                    : known ? fmt::format("{} ({})", share_text(found.r(i, k)), p_cell(found.p(i, k)))
                    : k < i ? "-"
                            : "");
    }
    table.rows.push_back(std::move(row));
  }
  table.notes = {fmt::format("n = {}; P-values are not adjusted.", pair_counts_text(found.counts))};
  if (study::crossings(page.data().study, true).size() > 1)
    table.notes.emplace_back("All groups of people are pooled: what differs between groups correlates too.");
  page.table(table);
}

}  // namespace icome::apps
