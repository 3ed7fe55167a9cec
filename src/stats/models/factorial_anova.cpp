#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "stats/models/anova.h"
#include "stats/models/anova_table.h"
#include "stats/models/model_terms.h"

namespace icome::stats {
namespace {

/// The terms of the model, the grand mean first. Fails without factors and when the model is too large.
base::Result<std::vector<Term>> terms_of_model(std::span<const Factor> factors, int highest,
                                               std::size_t cells) {
  if (factors.empty()) return base::fail("there is no factor: give at least one");
  if (highest < 1)
    return base::fail("a term has at least one factor: let the highest interaction be 1 or more");
  // The number of terms alone is 2^factors.
  if (factors.size() > 16) return base::fail("there are more than 16 factors: leave some out");
  std::vector<Term> terms = model_terms(static_cast<int>(factors.size()), highest);
  terms.insert(terms.begin(), Term{});
  double parameters = 0.0;
  for (const Term& term : terms) parameters += column_count(factors, term);
  if (parameters > 1000.0 || parameters * parameters * static_cast<double>(cells) > 1e10) {
    return base::fail(
        fmt::format("the model has {} parameters for {} cells, which is too many: leave out "
                    "interactions or factors",
                    parameters, cells));
  }
  return terms;
}

/// The columns of the terms with the response beside them: a row for each cell, times the square root of
/// its number of observations.
struct WeightedCells {
  std::vector<Eigen::Index> first_columns;  // one for each term, then the response's
  Eigen::MatrixXd columns;
};

Eigen::MatrixXd weighted_rows(std::span<const Factor> factors, std::span<const Term> terms,
                              std::span<const Cell> cells, const WeightedCells& design) {
  std::vector<std::vector<int>> levels;
  Eigen::VectorXd roots(static_cast<Eigen::Index>(cells.size())), means(roots.size());
  for (const Cell& cell : cells) {
    const auto row = static_cast<Eigen::Index>(levels.size());
    roots[row] = std::sqrt(static_cast<double>(cell.n));
    means[row] = cell.mean;
    levels.push_back(cell.levels);
  }
  Eigen::MatrixXd rows(roots.size(), design.first_columns.back() + 1);
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const Eigen::Index first = design.first_columns[i];
    rows.middleCols(first, design.first_columns[i + 1] - first) = term_columns(factors, terms[i], levels);
  }
  rows.rightCols(1) = means;
  return roots.asDiagonal() * rows;
}

/// The design of a model. With more cells than columns it is the triangular factor of a QR decomposition,
/// which keeps the columns' lengths and angles. Cells are added in blocks, so that their whole matrix is
/// never in memory.
WeightedCells weighted_cells(std::span<const Factor> factors, std::span<const Term> terms,
                             std::span<const Cell> cells) {
  WeightedCells design{{0}, {}};
  for (const Term& term : terms) {
    design.first_columns.push_back(design.first_columns.back() +
                                   static_cast<Eigen::Index>(column_count(factors, term)));
  }
  const auto width = static_cast<std::size_t>(design.first_columns.back() + 1);
  if (cells.size() <= width) {
    design.columns = weighted_rows(factors, terms, cells, design);
    return design;
  }
  design.columns.resize(0, static_cast<Eigen::Index>(width));
  const std::size_t block = std::max<std::size_t>(4 * width, 256);
  for (std::size_t first = 0; first < cells.size(); first += block) {
    const auto some = cells.subspan(first, std::min(block, cells.size() - first));
    Eigen::MatrixXd rows(design.columns.rows() + static_cast<Eigen::Index>(some.size()),
                         static_cast<Eigen::Index>(width));
    rows.topRows(design.columns.rows()) = design.columns;
    rows.bottomRows(static_cast<Eigen::Index>(some.size())) = weighted_rows(factors, terms, some, design);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(rows);
    const Eigen::Index kept = std::min(rows.rows(), rows.cols());
    design.columns = qr.matrixQR().topRows(kept).triangularView<Eigen::Upper>();
  }
  return design;
}

void warn_of_empty_cells(Anova& anova, std::span<const Factor> factors) {
  double combinations = 1.0;
  for (const Factor& factor : factors) combinations *= static_cast<double>(factor.levels.size());
  const double empty = combinations - static_cast<double>(anova.cells);
  if (empty <= 0.0) return;
  anova.warnings.push_back(
      fmt::format("{} of {} combinations of levels have no observation.", empty, combinations));
  if (anova.type == SumsOfSquares::TypeIII) {
    anova.warnings.push_back(
        "With empty combinations, what type III sums of squares test depends on which ones: prefer type II.");
  }
}

AnovaTerm fitted_term(Anova& anova, std::span<const Factor> factors, const TermDirections& fitted,
                      const Eigen::VectorXd& response) {
  AnovaTerm term;
  term.term = term_name(factors, fitted.term);
  term.factors = fitted.term;
  term.df = static_cast<int>(fitted.directions.cols());
  term.ss = (fitted.directions.transpose() * response).squaredNorm();
  const double asked = column_count(factors, fitted.term);
  if (term.df == 0) {
    anova.warnings.push_back(fmt::format("'{}' cannot be estimated from these combinations.", term.term));
  } else if (term.df < asked) {
    anova.warnings.push_back(fmt::format("'{}' is estimated in part: {} of its {} degrees of freedom.",
                                         term.term, term.df, asked));
  }
  return term;
}

}  // namespace

base::Result<Anova> factorial_anova(std::span<const double> values, std::span<const Factor> factors,
                                    const AnovaSettings& settings) {
  const auto cases = complete_cases(values, factors);
  if (!cases) return base::fail(cases.error().message);
  AnovaStart start = started_anova(*cases, settings.type);
  const std::span<const Factor> used = cases->factors;
  const auto terms = terms_of_model(used, settings.highest_interaction, start.cells.cells.size());
  if (!terms) return base::fail(terms.error().message);
  if (factors.size() == 1) {
    auto anova = one_way_anova(values, factors.front());
    if (anova) anova->type = settings.type;
    return anova;
  }
  const WeightedCells design = weighted_cells(used, *terms, start.cells.cells);
  const Eigen::VectorXd response = design.columns.rightCols(1);
  std::vector<Eigen::MatrixXd> columns;
  for (std::size_t i = 0; i < terms->size(); ++i) {
    const Eigen::Index first = design.first_columns[i];
    columns.push_back(design.columns.middleCols(first, design.first_columns[i + 1] - first));
  }
  const ModelDirections model = model_directions(*terms, columns, settings.type);
  Anova anova = std::move(start.anova);
  warn_of_empty_cells(anova, used);
  for (const TermDirections& fitted : model.terms) {
    if (!fitted.term.empty()) anova.terms.push_back(fitted_term(anova, used, fitted, response));
  }
  anova.residual.df = static_cast<int>(anova.n) - static_cast<int>(model.all.size());
  anova.residual.ss = start.within_ss;
  // A model without the highest interactions leaves a part of the cell means unexplained.
  if (model.all.size() < response.size()) anova.residual.ss += model.all.without(response).squaredNorm();
  complete_table(anova, used);
  return anova;
}

}  // namespace icome::stats
