#include "stats/models/repeated_measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "stats/models/model_terms.h"
#include "stats/tables/subject_table.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

/// Orthonormal columns that sum to zero (Helmert's), levels x (levels - 1).
Eigen::MatrixXd helmert(int levels) {
  Eigen::MatrixXd contrasts = Eigen::MatrixXd::Zero(levels, levels - 1);
  for (int column = 0; column < levels - 1; ++column) {
    const double below = column + 1.0, scale = std::sqrt(below * (below + 1.0));
    contrasts.col(column).head(column + 1).setConstant(1.0 / scale);
    contrasts(column + 1, column) = -below / scale;
  }
  return contrasts;
}

/// A within term's orthonormal contrasts between cells, cells x its degrees of freedom.
Eigen::MatrixXd within_contrasts(std::span<const Factor> within, const Term& term) {
  Eigen::MatrixXd contrasts = Eigen::MatrixXd::Ones(1, 1);
  for (std::size_t i = 0; i < within.size(); ++i) {
    const int levels = static_cast<int>(within[i].levels.size());
    Eigen::MatrixXd factor = Eigen::MatrixXd::Constant(levels, 1, 1.0 / std::sqrt(levels));
    if (contains(term, {static_cast<int>(i)})) factor = helmert(levels);
    Eigen::MatrixXd grown(contrasts.rows() * factor.rows(), contrasts.cols() * factor.cols());
    for (Eigen::Index r = 0; r < contrasts.rows(); ++r) {
      for (Eigen::Index c = 0; c < contrasts.cols(); ++c) {
        grown.block(r * factor.rows(), c * factor.cols(), factor.rows(), factor.cols()) =
            contrasts(r, c) * factor;
      }
    }
    contrasts = std::move(grown);
  }
  return contrasts;
}

/// The between-subjects model with the grand mean. Fails when it cannot be fitted.
base::Result<ModelDirections> between_model(const SubjectTable& table, SumsOfSquares type) {
  const std::span<const Factor> between = table.between;
  if (between.size() > 16) return base::fail("there are more than 16 between factors: leave some out");
  std::vector<Term> terms = model_terms(static_cast<int>(between.size()), static_cast<int>(between.size()));
  terms.insert(terms.begin(), Term{});
  double parameters = 0.0;
  for (const Term& term : terms) parameters += column_count(between, term);
  if (parameters > 1000.0) {
    return base::fail(
        fmt::format("the between factors make {} groups, which is too many: leave some out", parameters));
  }
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(table.means.rows()));
  for (std::size_t row = 0; row < rows.size(); ++row) {
    for (const Factor& factor : between) rows[row].push_back(factor.of[row]);
  }
  std::vector<Eigen::MatrixXd> columns;
  for (const Term& term : terms) columns.push_back(term_columns(between, term, rows));
  ModelDirections model = model_directions(terms, columns, type);
  if (model.all.size() >= table.means.rows()) {
    return base::fail(
        fmt::format("{} subjects in {} groups leave nothing for the error: measure more subjects",
                    table.means.rows(), model.all.size()));
  }
  return model;
}

void warn_of_groups(RepeatedMeasures& result, const SubjectTable& table, const ModelDirections& model) {
  for (const TermDirections& term : model.terms) {
    const double asked = column_count(table.between, term.term);
    const auto df = static_cast<double>(term.directions.cols());
    if (df == asked) continue;
    const std::string name = term.term.empty() ? fmt::format("the mean of all groups, which '{}' rests on,",
                                                             table.within.front().name)
                                               : fmt::format("'{}'", term_name(table.between, term.term));
    result.warnings.push_back(fmt::format(
        "Groups without subjects leave {} {} of its {} degrees of freedom{}.", name, df, asked,
        result.type == SumsOfSquares::TypeIII ? ", and what type III tests depends on them: prefer type II"
                                              : ""));
  }
}

/// Computes the numbers of a row that follow from its sums of squares and its error.
void complete_repeated_row(RepeatedMeasuresTerm& row, double nothing) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  if (row.ss < nothing) row.ss = 0.0;
  row.ms = row.df > 0 ? row.ss / row.df : kNone;
  row.error_ms = row.error_ss / row.error_df;
  row.f = row.ms / row.error_ms;  // infinite over zero, NaN where both are
  row.p = f_above(row.f, row.df, row.error_df);
  row.partial_eta_sq = row.df > 0 ? row.ss / (row.ss + row.error_ss) : kNone;
  row.p_greenhouse_geisser = row.p_huynh_feldt = row.p;
  if (!row.sphericity) return;
  const double gg = row.sphericity->greenhouse_geisser;
  row.p_greenhouse_geisser = f_above(row.f, gg * row.df, gg * row.error_df);
  // Not std::min, which would take 1 for a NaN.
  const double hf = row.sphericity->huynh_feldt > 1.0 ? 1.0 : row.sphericity->huynh_feldt;
  row.p_huynh_feldt = f_above(row.f, hf * row.df, hf * row.error_df);
}

std::string repeated_term_name(const SubjectTable& table, const Term& between, const Term& within) {
  if (between.empty()) return term_name(table.within, within);
  if (within.empty()) return term_name(table.between, between);
  return fmt::format("{}:{}", term_name(table.between, between), term_name(table.within, within));
}

/// Appends the rows that share the error of one within term (of subjects, for the empty term) and
/// returns that error.
AnovaResidual append_stratum(RepeatedMeasures& result, const SubjectTable& table,
                             const ModelDirections& model, const Term& within) {
  const Eigen::MatrixXd scores = table.means * within_contrasts(table.within, within);
  const Eigen::MatrixXd residuals = model.all.without(scores);
  const int error_df = static_cast<int>(scores.rows() - model.all.size());
  // Less than this is rounding.
  const double nothing = 1e-26 * table.means.squaredNorm();
  double error_ss = residuals.squaredNorm();
  if (error_ss < nothing) error_ss = 0.0;
  std::optional<Sphericity> sphericity;
  if (scores.cols() > 1 && error_ss > 0.0) sphericity = sphericity_of(residuals, error_df);
  if (sphericity && std::isnan(sphericity->mauchly_w)) {
    result.warnings.push_back(
        fmt::format("There are too few subjects, or their differences too alike, for Mauchly's test of '{}': "
                    "it needs {} more "
                    "subjects than groups.",
                    term_name(table.within, within), scores.cols()));
  }
  if (error_ss == 0.0 && !(within.empty() && table.between.empty())) {
    result.warnings.push_back(fmt::format("The error of '{}' is zero: its F means nothing.",
                                          within.empty() ? "subjects" : term_name(table.within, within)));
  }
  for (const TermDirections& effect : model.terms) {
    if (within.empty() && effect.term.empty()) continue;
    RepeatedMeasuresTerm row;
    row.term = repeated_term_name(table, effect.term, within);
    row.within = within;
    row.between = effect.term;
    row.df = static_cast<int>(effect.directions.cols() * scores.cols());
    row.ss = (effect.directions.transpose() * scores).squaredNorm();
    row.error_df = error_df * static_cast<int>(scores.cols());
    row.error_ss = error_ss;
    row.sphericity = sphericity;
    complete_repeated_row(row, nothing);
    result.terms.push_back(std::move(row));
  }
  const int df = error_df * static_cast<int>(scores.cols());
  return {df, error_ss, error_ss / df};
}

bool is_row_measured(const RepeatedMeasuresTerm& row, const SubjectTable& table) {
  const auto any = [](const std::vector<int>& term, const std::vector<Factor>& factors) {
    return std::any_of(term.begin(), term.end(),
                       [&](int factor) { return factors[static_cast<std::size_t>(factor)].measured; });
  };
  return any(row.within, table.within) || any(row.between, table.between);
}

/// Adds generalised eta squared to the rows; `error_ss` sums the errors of all strata, subjects' among them.
void add_generalised_etas(RepeatedMeasures& result, const SubjectTable& table, double error_ss) {
  double others = error_ss;
  for (const RepeatedMeasuresTerm& row : result.terms) {
    if (is_row_measured(row, table)) others += row.ss;
  }
  for (RepeatedMeasuresTerm& row : result.terms) {
    const double all = is_row_measured(row, table) ? others : others + row.ss;
    row.generalised_eta_sq_rest = all - row.ss;
    row.generalised_eta_sq = row.df > 0 ? row.ss / all : std::numeric_limits<double>::quiet_NaN();
  }
}

/// Adds shares of the variance of all cells, the differences between subjects included (Olejnik and Algina
/// 2003). Partial omega follows R's MOTE; with one within factor alone omega is equal to it, and with
/// several factors omega is compared with all of their variance in the same way.
void add_shares_of_total(RepeatedMeasures& result, const SubjectTable& table) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  result.total_ss = (table.means.array() - table.means.mean()).matrix().squaredNorm();
  const AnovaResidual& subjects = result.between_subjects;
  for (RepeatedMeasuresTerm& row : result.terms) {
    const bool has_share = row.df > 0 && result.total_ss > 0.0;
    const double excess = has_share ? row.ss - row.df * row.error_ms : kNone;
    const double other_ss = row.within.empty() ? 0.0 : row.error_ss;  // otherwise subjects' is its error
    row.eta_sq = has_share ? row.ss / result.total_ss : kNone;
    const double total = result.total_ss + subjects.ms;
    const double partial = row.ss + other_ss + subjects.ss + subjects.ms;
    row.omega_sq = excess / total;
    row.partial_omega_sq = excess / partial;
    row.omega_sq_rest = total - excess;
    row.partial_omega_sq_rest = partial - excess;
  }
}

}  // namespace

base::Result<RepeatedMeasures> repeated_measures_anova(std::span<const double> values, const Factor& subject,
                                                       std::span<const Factor> within,
                                                       std::span<const Factor> between, SumsOfSquares type) {
  const auto table = subject_table(values, subject, within, between);
  if (!table) return base::fail(table.error().message);
  const auto model = between_model(*table, type);
  if (!model) return base::fail(model.error().message);
  RepeatedMeasures result;
  result.type = type;
  result.subjects = static_cast<std::size_t>(table->means.rows());
  result.observations = table->observations;
  result.missing = values.size() - table->observations;
  result.left_out = table->left_out;
  result.warnings = table->warnings;
  warn_of_groups(result, *table, *model);
  result.between_subjects = append_stratum(result, *table, *model, {});
  double error_ss = result.between_subjects.ss;
  const int factors = static_cast<int>(within.size());
  for (const Term& term : model_terms(factors, factors)) {
    error_ss += append_stratum(result, *table, *model, term).ss;
  }
  add_generalised_etas(result, *table, error_ss);
  add_shares_of_total(result, *table);
  return result;
}

}  // namespace icome::stats
