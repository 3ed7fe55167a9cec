#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stats/models/anova.h"
#include "stats/models/sphericity.h"
#include "stats/tables/factor.h"

namespace icome::stats {

/// One row of the table.
struct RepeatedMeasuresTerm {
  std::string term;         // "group:angle"; between factors first
  std::vector<int> within;  // indices of the within factors in it, ascending
  std::vector<int> between;
  int df = 0;
  double ss = 0.0, ms = 0.0;
  int error_df = 0;  // its own error: of subjects, or of subjects by the within factors in it
  double error_ss = 0.0, error_ms = 0.0;
  double f = 0.0, p = 0.0;          // p: as if spherical
  double eta_sq = 0.0;              // SS / total SS
  double partial_eta_sq = 0.0;      // SS / (SS + error SS)
  double generalised_eta_sq = 0.0;  // Olejnik and Algina (2003)
  double omega_sq = 0.0;            // (SS - df error MS) / (total SS + subjects' MS)
  double partial_omega_sq = 0.0;    // (SS - df error MS) / (SS + error SS + subjects' SS and MS, each once)
  // The denominators of these shares without the effect (its SS; for omega the excess of its SS over its
  // error); for share_interval().
  double generalised_eta_sq_rest = 0.0, omega_sq_rest = 0.0, partial_omega_sq_rest = 0.0;
  std::optional<Sphericity> sphericity;  // of a within part with more than one degree of freedom
  double p_greenhouse_geisser = 0.0;     // both degrees of freedom times epsilon; p where there is no epsilon
  double p_huynh_feldt = 0.0;            // with Huynh and Feldt's epsilon, at most 1
};

/// A table of analysis of variance with repeated measures.
struct RepeatedMeasures {
  SumsOfSquares type = SumsOfSquares::TypeII;
  std::vector<RepeatedMeasuresTerm> terms;  // between-subjects terms first
  AnovaResidual between_subjects;           // the residual of the differences between subjects
  double total_ss = 0.0;                    // of the cells of all subjects about their grand mean
  std::size_t subjects = 0;                 // used
  std::size_t observations = 0;             // used, before averaging
  std::size_t missing = 0;                  // left out: NaN, without a level, or of a subject left out
  std::vector<std::string> left_out;        // subjects without an observation in every within cell
  std::vector<std::string> warnings;        // sentences to print below the table
};

/// Analysis of variance of any number of within-subjects factors, with any number of between-subjects factors
/// (a mixed design) or none, all with their interactions. Several observations of a subject in one cell are
/// averaged, and subjects without one in every within cell are left out; the warnings say both. If groups are
/// unequal, `type` tells what between-subjects terms, and their interactions with within factors, are
/// adjusted for; a within-subjects effect is of the plain mean of subjects in types I and II and of the
/// unweighted mean of groups in III. Fails as complete_cases() does, without within factors, when a subject
/// is in two groups, when fewer subjects are left than groups plus one, or when there are more than 1,000
/// within cells, 16 factors or 1,000 between-subjects parameters.
base::Result<RepeatedMeasures> repeated_measures_anova(std::span<const double> values, const Factor& subject,
                                                       std::span<const Factor> within,
                                                       std::span<const Factor> between = {},
                                                       SumsOfSquares type = SumsOfSquares::TypeII);

}  // namespace icome::stats
