#include "stats/models/anova.h"

#include <fmt/format.h>

#include <array>

#include "stats/models/anova_table.h"
#include "stats/tables/sums.h"
#include "stats/tests/tails.h"

namespace icome::stats {

base::Result<Anova> one_way_anova(std::span<const double> values, const Factor& factor) {
  const auto cases = complete_cases(values, std::span(&factor, 1));
  if (!cases) return base::fail(cases.error().message);
  AnovaStart start = started_anova(*cases, SumsOfSquares::TypeII);
  Anova anova = std::move(start.anova);
  const int levels = static_cast<int>(cases->factors.front().levels.size());
  AnovaTerm term;
  term.term = factor.name;
  term.factors = {0};
  term.df = levels - 1;
  std::vector<double> squares;
  for (const Cell& cell : start.cells.cells) {
    squares.push_back(static_cast<double>(cell.n) * cell.mean * cell.mean);
  }
  term.ss = sum(squares);
  anova.terms = {term};
  anova.residual = {static_cast<int>(anova.n) - levels, start.within_ss, 0.0};
  complete_table(anova, std::span(&factor, 1));
  return anova;
}

base::Result<WelchAnova> welch_anova(std::span<const double> values, const Factor& factor) {
  const auto cases = complete_cases(values, std::span(&factor, 1));
  if (!cases) return base::fail(cases.error().message);
  const Cells cells = summed_to_cells(*cases);
  std::vector<double> weights, weighted;
  for (const Cell& cell : cells.cells) {
    const auto n = static_cast<double>(cell.n);
    if (cell.n < 2 || !(cell.ss > 0.0)) {
      return base::fail(
          fmt::format("the observations of '{}' do not vary: without equal variances each level "
                      "needs two that differ",
                      cases->factors[0].levels[static_cast<std::size_t>(cell.levels[0])]));
    }
    weights.push_back(n * (n - 1.0) / cell.ss);
    weighted.push_back(weights.back() * cell.mean);
  }
  const double weight = sum(weights), centre = sum(weighted) / weight;
  const auto levels = static_cast<double>(cells.cells.size());
  std::vector<double> between, uncertain;
  for (std::size_t i = 0; i < cells.cells.size(); ++i) {
    const Cell& cell = cells.cells[i];
    const double deviation = cell.mean - centre, rest = 1.0 - weights[i] / weight;
    between.push_back(weights[i] * deviation * deviation);
    uncertain.push_back(rest * rest / static_cast<double>(cell.n - 1));
  }
  const double doubt = sum(uncertain) / (levels * levels - 1.0);
  WelchAnova result{
      0.0, levels - 1.0, 1.0 / (3.0 * doubt), 0.0, cases->values.size(), cases->missing, cases->warnings};
  result.f = sum(between) / (levels - 1.0) / (1.0 + 2.0 * (levels - 2.0) * doubt);
  result.p = f_above(result.f, result.df, result.error_df);
  return result;
}

}  // namespace icome::stats
