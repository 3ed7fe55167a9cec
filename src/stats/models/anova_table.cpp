#include "stats/models/anova_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "stats/tables/sums.h"
#include "stats/tests/tails.h"

namespace icome::stats {
namespace {

double quotient(double above, double below) {
  if (below > 0.0) return above / below;
  return above > 0.0 ? std::numeric_limits<double>::infinity() : std::numeric_limits<double>::quiet_NaN();
}

bool is_measured(const AnovaTerm& term, std::span<const Factor> factors) {
  return std::any_of(term.factors.begin(), term.factors.end(),
                     [&](int factor) { return factors[static_cast<std::size_t>(factor)].measured; });
}

void complete_row(AnovaTerm& term, const Anova& anova) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const AnovaResidual& residual = anova.residual;
  const auto n = static_cast<double>(anova.n);
  const double df = term.df;
  term.ms = term.df > 0 ? term.ss / df : kNone;
  term.f = residual.df > 0 && term.df > 0 ? quotient(term.ms, residual.ms) : kNone;
  term.p = f_above(term.f, df, residual.df);
  term.eta_sq = term.df > 0 ? quotient(term.ss, anova.total_ss) : kNone;
  term.partial_eta_sq = term.df > 0 ? quotient(term.ss, term.ss + residual.ss) : kNone;
  const double excess = term.df > 0 ? term.ss - df * residual.ms : kNone;  // df (F - 1) MSE
  term.omega_sq = excess / (anova.total_ss + residual.ms);
  term.partial_omega_sq = excess / (excess + n * residual.ms);
}

void add_generalised_eta(Anova& anova, std::span<const Factor> factors) {
  double measured_ss = 0.0;
  for (const AnovaTerm& term : anova.terms) {
    if (is_measured(term, factors)) measured_ss += term.ss;
  }
  for (AnovaTerm& term : anova.terms) {
    const double others = measured_ss + anova.residual.ss;
    term.generalised_eta_sq = quotient(term.ss, is_measured(term, factors) ? others : others + term.ss);
    if (term.df == 0) term.generalised_eta_sq = std::numeric_limits<double>::quiet_NaN();
  }
}

void warn_of_error(Anova& anova) {
  if (anova.residual.df == 0) {
    anova.warnings.push_back(
        fmt::format("No degrees of freedom are left for the error, so that there is no F: {}.",
                    anova.terms.size() > 1 ? "leave out the highest interaction"
                                           : "each level has one observation only"));
  } else if (!(anova.total_ss > 0.0)) {
    anova.warnings.push_back("All values are equal: there is nothing to explain.");
  } else if (anova.residual.ss < 1e-10 * anova.total_ss) {
    anova.warnings.push_back("The error is (nearly) zero: F and p of such a perfect fit mean little.");
  }
}

}  // namespace

AnovaStart started_anova(const CompleteCases& cases, SumsOfSquares type) {
  AnovaStart start{{}, summed_to_cells(cases), 0.0};
  std::vector<double> sums, between, within;
  for (const Cell& cell : start.cells.cells) sums.push_back(static_cast<double>(cell.n) * cell.mean);
  const double grand = sum(sums) / static_cast<double>(cases.values.size());
  for (Cell& cell : start.cells.cells) {
    cell.mean -= grand;
    between.push_back(static_cast<double>(cell.n) * cell.mean * cell.mean);
    within.push_back(cell.ss);
  }
  start.within_ss = sum(within);
  start.anova.type = type;
  start.anova.total_ss = sum(between) + start.within_ss;
  start.anova.n = cases.values.size();
  start.anova.missing = cases.missing;
  start.anova.cells = start.cells.cells.size();
  start.anova.warnings = cases.warnings;
  return start;
}

void complete_table(Anova& anova, std::span<const Factor> factors) {
  AnovaResidual& residual = anova.residual;
  // Less than this is rounding of the projections, which would make an F of its own over an error of zero.
  const double nothing = 1e-26 * anova.total_ss;
  if (residual.ss < nothing) residual.ss = 0.0;
  for (AnovaTerm& term : anova.terms) {
    if (term.ss < nothing) term.ss = 0.0;
  }
  residual.ms = residual.df > 0 ? residual.ss / residual.df : std::numeric_limits<double>::quiet_NaN();
  for (AnovaTerm& term : anova.terms) complete_row(term, anova);
  add_generalised_eta(anova, factors);
  warn_of_error(anova);
}

}  // namespace icome::stats
