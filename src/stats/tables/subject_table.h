#pragma once
#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "stats/tables/factor.h"

namespace icome::stats {

/// Observations of repeated measures as a table: a row for each subject, a column for each within cell.
struct SubjectTable {
  Eigen::MatrixXd means;                // less the centre of all observations
  std::vector<Factor> within, between;  // with the levels that occur; `of` of between is by row
  std::vector<std::string> left_out;    // subjects without an observation in every within cell
  std::size_t observations = 0;         // in the table
  std::vector<std::string> warnings;
};

/// Averages the observations of each subject in each within cell (the last factor's levels run fastest) and
/// leaves out missing values and incomplete subjects. Fails as complete_cases() does, without within
/// factors, when a subject is in two groups, with more than 1,000 within cells or 5e7 cells in all, and when
/// fewer than two subjects are left.
base::Result<SubjectTable> subject_table(std::span<const double> values, const Factor& subject,
                                         std::span<const Factor> within, std::span<const Factor> between);

}  // namespace icome::stats
