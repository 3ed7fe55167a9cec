#pragma once
#include <span>
#include <vector>

#include "stats/tables/factor.h"

namespace icome::stats {

/// The observations that share a level of every factor, summed up to the numbers that analysis of variance
/// needs.
struct Cell {
  std::vector<int> levels;  // one for each factor
  std::size_t n = 0;        // at least 1
  double mean = 0.0;        // less the centre of all cells, so that digits are not spent on their common part
  double ss = 0.0;          // squared deviations from this mean
};

struct Cells {
  double centre = 0.0;      // near the mean of all observations
  std::vector<Cell> cells;  // combinations of levels that occur, the last factor's levels running fastest
};

/// The index of each observation's combination among the combinations of levels that occur; kNoLevel where a
/// level is missing. The combinations' levels are appended to `combinations`, ordered as in Cells.
/// The product of the numbers of levels is at most 2^62.
std::vector<int> combined_levels(std::span<const Factor> factors, std::size_t observations,
                                 std::vector<std::vector<int>>& combinations);

/// The values sorted by group, each group's in their first order: group i from starts[i] to starts[i + 1].
struct GroupedValues {
  std::vector<double> values;
  std::vector<std::size_t> starts;
  std::span<const double> group(std::size_t i) const {
    return std::span(values).subspan(starts[i], starts[i + 1] - starts[i]);
  }
};

/// Values by group; those of kNoLevel are left out.
GroupedValues grouped(std::span<const double> values, std::span<const int> group_of, std::size_t groups);

/// Sums complete observations to cells.
Cells summed_to_cells(const CompleteCases& cases);

}  // namespace icome::stats
