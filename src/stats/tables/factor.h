#pragma once
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace icome::stats {

/// The level of an observation without one, which is left out.
inline constexpr int kNoLevel = -1;

/// A categorical column: the level of each observation.
struct Factor {
  std::string name;                 // unique among those of an analysis
  std::vector<std::string> levels;  // in the order that tables and type I contrasts follow
  std::vector<int> of;              // one for each observation: an index of `levels`, or kNoLevel
  bool measured = false;            // a trait of people (gender, age group), not set by the study's design:
                                    // generalised eta squared counts its variance (Olejnik and Algina 2003)
};

/// Observations without missing values or levels, with the levels that occur among them.
struct CompleteCases {
  std::vector<double> values;
  std::vector<Factor> factors;        // with only the levels that occur, in the order given
  std::size_t missing = 0;            // observations left out: NaN, or without a level
  std::vector<std::string> warnings;  // on what was left out
};

/// Fails when a column is not as long as there are observations, a level's index is out of range, two factors
/// have the same name, or there are more than 2^62 combinations of their levels.
base::Result<void> check_factors(std::span<const Factor> factors, std::size_t observations);

/// Leaves out every observation whose value is NaN or that lacks a level of a factor, then the levels that
/// no observation has. Fails as check_factors() and check_magnitudes() do, and when nothing or only one level
/// of a factor is left.
base::Result<CompleteCases> complete_cases(std::span<const double> values, std::span<const Factor> factors);

/// The column of texts as a Factor; levels in order of first appearance, an empty text is missing.
Factor factor_of(std::string name, std::span<const std::string> column);

}  // namespace icome::stats
