#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/stats/stats_text.h"
#include "apps/study/study_page_parts.h"

namespace icome::apps {
namespace {

constexpr int kThesisDecimals = 1;

/// "Avg. elapsed time" and "Total #errors", as the thesis has its rows.
std::string thesis_row_name(const study::DependentVariable& variable, bool total) {
  return fmt::format("{} {}", total ? "Total" : "Avg.", quantity_name(variable));
}

/// The decimals of the thesis in its units; more where a number is so small that one would hide it.
std::string thesis_cell(const std::optional<double>& level, bool total) {
  if (!level) return "-";
  return fixed_text(*level, total ? 0 : std::max(kThesisDecimals, std::min(3, decimals_for(*level))));
}

/// P as the thesis has it: "< .001", ".14".
std::string thesis_p(const study::Tested& test) { return test.result ? p_cell(test.result->p) : "-"; }

std::string thesis_place(const study::Study& study, const study::ThesisTable& table) {
  const study::IndependentVariable& factor = study.independent[table.factor];
  const std::string name = name_of(factor.name, factor.id);
  if (!table.within_level) return fmt::format("{}, all measurements", name);
  const study::IndependentVariable& other = study.independent[table.within_level->first];
  const study::Level& level = other.levels[table.within_level->second];
  return fmt::format("{}, within {}: {}", name, name_of(other.name, other.id), name_of(level.name, level.id));
}

/// Table 6.1: a row a level, a column each for all measurements and for the last trials.
void write_timings(StudyPage& page, const study::ThesisTable& all, const study::ThesisTable& last) {
  const study::Study& study = page.data().study;
  const study::IndependentVariable& factor = study.independent[all.factor];
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    const study::ThesisRow &every = all.rows[i], &final = last.rows[i];
    const study::DependentVariable& variable = study.dependent[every.variable];
    if (variable.from != "time") continue;
    PageTable table;
    table.caption = fmt::format("As table 6.1: average {} by {}.", quantity_name(variable),
                                name_of(factor.name, factor.id));
    table.headings = {"", "All measurements", "Last trial"};
    for (std::size_t level = 0; level < factor.levels.size(); ++level)
      table.rows.push_back({name_of(factor.levels[level].name, factor.levels[level].id),
                            thesis_cell(every.levels[level], false),
                            thesis_cell(final.levels[level], false)});
    table.rows.push_back({"P-value", thesis_p(every.test), thesis_p(final.test)});
    table.notes = {fmt::format("{} and {} trials; the last one of each person in each condition.",
                               every.trials, final.trials)};
    page.table(table);
  }
}

std::string choices_note(const study::Study& study, const study::ThesisTable& table) {
  std::string counts;
  for (std::size_t level = 0; level < table.choices.size(); ++level) {
    const study::ChoiceCount& count = table.choices[level];
    const study::Level& it = study.independent[table.factor].levels[level];
    const double share = count.choices > 0 ? 100.0 * double(count.wrong) / double(count.choices) : 0.0;
    counts += fmt::format("{}{} of {} ({:.1f} %) {}", counts.empty() ? "" : ", ", count.wrong, count.choices,
                          share, name_of(it.name, it.id));
  }
  const std::string outcome = table.choices_test.result
                                  ? unbroken(p_text(table.choices_test.result->p)) + " (chi-squared)."
                                  : fmt::format("no P, as {}", table.choices_test.why);
  return fmt::format("Choices that were wrong: {}; {}", counts, outcome);
}

/// Tables 6.2, 6.4 and 6.5: a row a quantity, a column a level.
void write_quantities(StudyPage& page, const study::ThesisTable& results, const char* like) {
  const study::Study& study = page.data().study;
  PageTable table;
  table.caption = fmt::format("As {}: {}.", like, thesis_place(study, results));
  table.headings = {""};
  for (const study::Level& level : study.independent[results.factor].levels)
    table.headings.push_back(name_of(level.name, level.id));
  table.headings.emplace_back("P-value");
  for (const study::ThesisRow& row : results.rows) {
    std::vector<std::string> cells = {thesis_row_name(study.dependent[row.variable], row.total)};
    for (const std::optional<double>& level : row.levels) cells.push_back(thesis_cell(level, row.total));
    cells.push_back(thesis_p(row.test));
    table.rows.push_back(std::move(cells));
    const std::string note = row.test.result
                                 ? fmt::format("P: {}.", row.test.result->test)
                                 : fmt::format("{}: no P, as {}", table.rows.back().front(), row.test.why);
    if (std::ranges::find(table.notes, note) == table.notes.end()) table.notes.push_back(note);
  }
  if (!results.choices.empty()) table.notes.push_back(choices_note(study, results));
  page.table(table);
}

/// Table 6.3: the lower triangle.
void write_trial_correlations(StudyPage& page) {
  const study::ThesisCorrelations& found = page.analysis().thesis_correlations;
  const study::Study& study = page.data().study;
  const auto count = Eigen::Index(found.variables.size());
  if (count < 2) return;
  PageTable table;
  table.caption = "As table 6.3: correlations over all trials, Pearson's r.";
  table.headings = {""};
  const auto name = [&](Eigen::Index i) {
    const study::DependentVariable& variable = study.dependent[found.variables[std::size_t(i)]];
    return thesis_row_name(variable, variable.from == "errors");
  };
  for (Eigen::Index i = 0; i + 1 < count; ++i) table.headings.push_back(name(i));
  for (Eigen::Index i = 0; i < count; ++i) {
    std::vector<std::string> row = {name(i)};
    for (Eigen::Index k = 0; k + 1 < count; ++k)
      row.push_back(k > i                          ? ""
                    : k == i                       ? "1.0"
                    : std::isfinite(found.r(i, k)) ? share_text(found.r(i, k))
                                                   : "-");
    table.rows.push_back(std::move(row));
  }
  page.table(table);
}

}  // namespace

void write_thesis_form(StudyPage& page) {
  const auto& tables = page.analysis().thesis_tables;
  if (tables.empty() || page.analysis().participants.trials == 0) return;
  const bool several = page.data().study.independent.size() > 1;
  page.heading("In the form of the thesis");
  page.paragraph(
      "As tables 6.1 to 6.5 of the thesis, to be compared with these: every trial counts as an observation "
      "of "
      "its own. Trials of one person are not independent, so these P-values say more than the data do; they "
      "decide nothing. Figures 6.2 to 6.5 are those of the questions below.");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    if (tables[i].trials == study::TrialChoice::Last) write_timings(page, tables[i - 1], tables[i]);
    if (tables[i].trials == study::TrialChoice::All && tables[i].within_level)
      write_quantities(page, tables[i], "table 6.5");
    if (tables[i].trials == study::TrialChoice::All && !tables[i].within_level)
      write_quantities(page, tables[i], several ? "tables 6.2 and 6.4" : "table 6.2, of one factor");
  }
  write_trial_correlations(page);
}

}  // namespace icome::apps
