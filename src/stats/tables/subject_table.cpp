#include "stats/tables/subject_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "stats/tables/cells.h"

namespace icome::stats {
namespace {

/// The number of combinations of the factors' levels, at most 1e9.
double within_cell_count(std::span<const Factor> within) {
  double count = 1.0;
  for (const Factor& factor : within) count *= static_cast<double>(factor.levels.size());
  return std::min(count, 1e9);
}

/// The factor's level for each subject. Fails when a subject has two levels.
base::Result<std::vector<int>> levels_by_subject(const Factor& factor, const Factor& subject) {
  std::vector<int> levels(subject.levels.size(), kNoLevel);
  for (std::size_t row = 0; row < subject.of.size(); ++row) {
    int& level = levels[static_cast<std::size_t>(subject.of[row])];
    if (level != kNoLevel && level != factor.of[row]) {
      return base::fail(
          fmt::format("'{}' of '{}' is both '{}' and '{}' of '{}': give each subject its own name, or '{}' "
                      "as a within factor",
                      subject.levels[static_cast<std::size_t>(subject.of[row])], subject.name,
                      factor.levels[static_cast<std::size_t>(level)],
                      factor.levels[static_cast<std::size_t>(factor.of[row])], factor.name, factor.name));
    }
    level = factor.of[row];
  }
  return levels;
}

/// Means and numbers of observations, by subject and within cell.
struct AveragedCells {
  Eigen::MatrixXd means;
  Eigen::MatrixXd counts;
};

AveragedCells averaged(const CompleteCases& cases, Eigen::Index subjects, Eigen::Index columns) {
  AveragedCells result{Eigen::MatrixXd::Zero(subjects, columns), Eigen::MatrixXd::Zero(subjects, columns)};
  const Cells cells = summed_to_cells(cases);
  for (const Cell& cell : cells.cells) {
    Eigen::Index column = 0;
    for (std::size_t i = 1; i < cell.levels.size(); ++i) {
      column = column * static_cast<Eigen::Index>(cases.factors[i].levels.size()) + cell.levels[i];
    }
    result.means(cell.levels[0], column) = cell.mean;
    result.counts(cell.levels[0], column) = static_cast<double>(cell.n);
  }
  return result;
}

/// The rows of subjects that have an observation in every cell. Names the others in table.left_out and warns.
std::vector<Eigen::Index> complete_subjects(const AveragedCells& cells, const Factor& subject,
                                            SubjectTable& table) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index row = 0; row < cells.counts.rows(); ++row) {
    if (cells.counts.row(row).minCoeff() > 0.0) {
      rows.push_back(row);
    } else {
      table.left_out.push_back(subject.levels[static_cast<std::size_t>(row)]);
    }
  }
  if (!table.left_out.empty()) {
    constexpr std::size_t kNamed = 20;
    const std::size_t named = std::min(table.left_out.size(), kNamed);
    const std::string more = named < table.left_out.size() ? ", ..." : "";
    table.warnings.push_back(fmt::format(
        "{} without an observation in every cell left out: {}{}.",
        table.left_out.size() == 1 ? "1 subject" : fmt::format("{} subjects", table.left_out.size()),
        fmt::join(std::span(table.left_out).first(named), ", "), more));
  }
  return rows;
}

void take_rows(const AveragedCells& cells, const std::vector<Eigen::Index>& rows, SubjectTable& table) {
  table.means = cells.means(rows, Eigen::all);
  const Eigen::MatrixXd counts = cells.counts(rows, Eigen::all);
  table.observations = static_cast<std::size_t>(counts.sum());
  if (counts.maxCoeff() > 1.0) {
    table.warnings.push_back(fmt::format("{} observations are averaged to {}, one for each subject and cell.",
                                         table.observations, counts.size()));
  }
}

}  // namespace

base::Result<SubjectTable> subject_table(std::span<const double> values, const Factor& subject,
                                         std::span<const Factor> within, std::span<const Factor> between) {
  if (within.empty())
    return base::fail("there is no within-subjects factor: give one, or leave out the subject");
  std::vector<Factor> given{subject};
  given.insert(given.end(), within.begin(), within.end());
  given.insert(given.end(), between.begin(), between.end());
  auto cases = complete_cases(values, given);
  if (!cases) return base::fail(cases.error().message);
  SubjectTable table;
  table.warnings = cases->warnings;
  const auto first_between = cases->factors.begin() + 1 + static_cast<std::ptrdiff_t>(within.size());
  std::vector<Factor> groups(first_between, cases->factors.end());
  cases->factors.erase(first_between, cases->factors.end());
  const Factor& people = cases->factors.front();
  table.within.assign(cases->factors.begin() + 1, cases->factors.end());
  const double columns = within_cell_count(table.within);
  const auto subjects = static_cast<double>(people.levels.size());
  if (columns > 1000.0 || columns * subjects > 5e7) {
    return base::fail(
        fmt::format("{} within cells of {} subjects are too many: leave out factors", columns, subjects));
  }
  const AveragedCells cells =
      averaged(*cases, static_cast<Eigen::Index>(people.levels.size()), static_cast<Eigen::Index>(columns));
  const std::vector<Eigen::Index> rows = complete_subjects(cells, people, table);
  if (rows.size() < 2) {
    return base::fail(fmt::format("{} of {} subjects have an observation in each of {} cells: two are needed",
                                  rows.size(), subjects, columns));
  }
  take_rows(cells, rows, table);
  for (Factor& group : groups) {
    const auto levels = levels_by_subject(group, people);
    if (!levels) return base::fail(levels.error().message);
    group.of.clear();
    for (const Eigen::Index row : rows) group.of.push_back((*levels)[static_cast<std::size_t>(row)]);
  }
  // Some groups may have lost all of their subjects.
  auto left = complete_cases(std::vector<double>(rows.size(), 0.0), groups);
  if (!left) return base::fail(left.error().message);
  table.between = std::move(left->factors);
  table.warnings.insert(table.warnings.end(), left->warnings.begin(), left->warnings.end());
  return table;
}

}  // namespace icome::stats
