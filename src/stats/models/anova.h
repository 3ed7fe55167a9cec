#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "stats/tables/factor.h"

namespace icome::stats {

/// The adjustment of a term for other terms; all types agree if the cells have equal numbers of observations.
enum class SumsOfSquares : std::uint8_t {
  TypeI,    // for the terms before it, so that the factors' order matters (R's aov)
  TypeII,   // for every term that does not contain it (Yates 1934)
  TypeIII,  // for every other term, so that cell means count equally (Yates' weighted squares of means)
};

/// One row of the table. Effect sizes are of the sample; omega may be below 0, which means "none".
struct AnovaTerm {
  std::string term;          // "wool", "wool:tension"
  std::vector<int> factors;  // indices of the factors in it, ascending
  int df = 0;
  double ss = 0.0, ms = 0.0;        // square of the values' unit
  double f = 0.0;                   // NaN where there is nothing to compare with
  double p = 0.0;                   // probability of this F or a larger one if there is no effect
  double eta_sq = 0.0;              // SS / total SS
  double partial_eta_sq = 0.0;      // SS / (SS + residual SS)
  double generalised_eta_sq = 0.0;  // Olejnik and Algina (2003)
  double omega_sq = 0.0;            // (SS - df MSE) / (total SS + MSE)
  double partial_omega_sq = 0.0;    // df (F - 1) / (df (F - 1) + n)
};

/// The variance that the terms leave unexplained.
struct AnovaResidual {
  int df = 0;
  double ss = 0.0, ms = 0.0;
};

/// A table of between-subjects analysis of variance.
struct Anova {
  SumsOfSquares type = SumsOfSquares::TypeII;
  std::vector<AnovaTerm> terms;  // main effects first, then interactions of two, ...
  AnovaResidual residual;
  double total_ss = 0.0;              // about the grand mean; the rows add up to it only in type I
  std::size_t n = 0;                  // observations used
  std::size_t missing = 0;            // left out: NaN or without a level
  std::size_t cells = 0;              // combinations of levels with observations
  std::vector<std::string> warnings;  // sentences to print below the table
};

struct AnovaSettings {
  SumsOfSquares type = SumsOfSquares::TypeII;
  int highest_interaction = std::numeric_limits<int>::max();  // factors in one term; 1: main effects only
};

/// One-way analysis of variance (thesis equations 6.4 to 6.22), model I. Exact sums: matches the certified F
/// of NIST's SmLs sets to 9 digits or more where the values' own rounding permits. Any number of levels, in
/// one pass over the values. Fails as complete_cases() does.
base::Result<Anova> one_way_anova(std::span<const double> values, const Factor& factor);

/// Analysis of variance of one or more between-subjects factors with their interactions, with any numbers of
/// observations in the cells. The observations are summed to cells first, and the terms' sums of squares are
/// squared lengths of orthogonal projections of the cell means (QR, sum-to-zero contrasts), never differences
/// of large sums. Warns of empty cells, terms that cannot be estimated (fewer df than their levels need; NaN
/// where none is left) and an error of zero. Fails as complete_cases() does, without factors, and when the
/// model has more than 16 factors, 1,000 parameters, or 1e10 squared parameters times cells.
base::Result<Anova> factorial_anova(std::span<const double> values, std::span<const Factor> factors,
                                    const AnovaSettings& settings = {});

/// One-way analysis of variance that does not assume equal variances.
struct WelchAnova {
  double f = 0.0;
  double df = 0.0;        // levels - 1
  double error_df = 0.0;  // need not be whole
  double p = 0.0;
  std::size_t n = 0, missing = 0;
  std::vector<std::string> warnings;
};

/// Welch (1951); R's oneway.test. Fails as complete_cases() does, and when a level has one observation or
/// observations that do not vary.
base::Result<WelchAnova> welch_anova(std::span<const double> values, const Factor& factor);

}  // namespace icome::stats
