#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_effects.h"
#include "apps/stats/stats_factors.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "stats/models/anova.h"
#include "stats/models/effect_sizes.h"
#include "stats/tests/assumptions.h"

namespace icome::apps {
namespace {

using stats::Anova;
using stats::AnovaTerm;

StatsJson effect_interval_json(const AnovaTerm& term, const Anova& anova) {
  const auto interval = stats::partial_eta_sq_interval(term.f, term.df, anova.residual.df, kEffectConfidence);
  return interval ? StatsJson({interval->low, interval->high}) : StatsJson(nullptr);
}

StatsJson anova_term_json(const AnovaTerm& term, const Anova& anova) {
  StatsJson json = effect_json(term);
  json["partial_eta_sq_interval"] = effect_interval_json(term, anova);
  return json;
}

StatsJson anova_json(const Anova& anova, const FactorialData& data) {
  StatsJson json;
  json["test"] = "anova";
  json["response"] = data.response;
  json["type"] = int(anova.type) + 1;
  json["table"] = StatsJson::array();
  for (const AnovaTerm& term : anova.terms) json["table"].push_back(anova_term_json(term, anova));
  json["residual"] = squares_json(anova.residual.df, anova.residual.ss, anova.residual.ms);
  json["total_ss"] = anova.total_ss;
  json["n"] = anova.n;
  json["missing"] = anova.missing;
  return json;
}

std::string anova_table_text(const Anova& anova) {
  const bool several = anova.terms.size() > 1;
  TextTable table(
      {"", "df", "SS", "MS", "F", "p", several ? "\u03b7\u00b2p" : "\u03b7\u00b2", "\u03c9\u00b2"});
  double largest = anova.residual.ss;
  for (const AnovaTerm& term : anova.terms) largest = std::max(largest, term.ss);
  const auto squares = [&](double value) {
    const std::string text = fixed_text(value, decimals_for(largest, 5));
    return value != 0.0 && std::abs(value) < 1e-3 * largest ? figure(value, 4) : text;
  };
  for (const AnovaTerm& term : anova.terms)
    table.add({term.term, std::to_string(term.df), squares(term.ss), squares(term.ms), fixed_text(term.f, 2),
               p_cell(term.p), share_text(several ? term.partial_eta_sq : term.eta_sq),
               share_text(term.omega_sq)});
  table.add({"Residual", std::to_string(anova.residual.df), squares(anova.residual.ss),
             squares(anova.residual.ms), "", "", "", ""});
  return table.text();
}

std::string anova_sentence(const AnovaTerm& term, const Anova& anova, bool several) {
  std::string text = fmt::format(
      "F({}, {}) = {}, {}, {} = {}", term.df, anova.residual.df, fixed_text(term.f, 2), p_text(term.p),
      several ? "\u03b7\u00b2p" : "\u03b7\u00b2", share_text(several ? term.partial_eta_sq : term.eta_sq));
  const auto interval = stats::partial_eta_sq_interval(term.f, term.df, anova.residual.df, kEffectConfidence);
  if (interval)
    text += fmt::format(", 90 % CI [{}, {}]", share_text(interval->low), share_text(interval->high));
  return text;
}

/// Adds a warning where an effect size stands outside of its interval.
void note_intervals(StatsReport& report, const Anova& anova, bool several) {
  const auto stands_outside = [&](const AnovaTerm& term) {
    const auto interval =
        stats::partial_eta_sq_interval(term.f, term.df, anova.residual.df, kEffectConfidence);
    const double share = several ? term.partial_eta_sq : term.eta_sq;
    return interval && (share < interval->low || share > interval->high);
  };
  if (std::ranges::any_of(anova.terms, stands_outside))
    report.warnings.push_back(
        "The interval of \u03b7\u00b2 is of the population's, which is less than what few values show of it; "
        "so the value itself can stand outside.");
}

/// The title of the chart: the last term, which is that of the most factors.
std::string anova_title(const Anova& anova) {
  const bool several = anova.terms.size() > 1;
  const AnovaTerm& term = anova.terms.back();
  return fmt::format("{}: {}", term.term, anova_sentence(term, anova, several));
}

/// Welch's test beside the table.
struct WelchPart {
  StatsJson json;
  std::string sentence;
};

base::Result<WelchPart> welch_part(const FactorialData& data) {
  if (data.factors.size() != 1) return base::fail("--welch is of one --factor.");
  const auto test = stats::welch_anova(data.values, data.factors.front());
  if (!test) return tl::unexpected(test.error());
  return WelchPart{{{"f", test->f}, {"df", test->df}, {"error_df", test->error_df}, {"p", test->p}},
                   fmt::format("Welch's F({}, {}) = {}, {}", df_text(test->df), df_text(test->error_df),
                               fixed_text(test->f, 2), p_text(test->p))};
}

base::Result<Anova> analysed(const FactorialData& data, const StatsOptions& options) {
  if (data.factors.size() == 1) return stats::one_way_anova(data.values, data.factors.front());
  stats::AnovaSettings settings;
  settings.type = stats::SumsOfSquares(options.type - 1);
  if (options.no_interactions) settings.highest_interaction = 1;
  return stats::factorial_anova(data.values, data.factors, settings);
}

}  // namespace

base::Result<StatsReport> report_anova(const StatsOptions& asked) {
  if (!asked.within.empty()) return report_repeated_measures(asked);
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  const auto data = read_factorial(*table, options);
  if (!data) return tl::unexpected(data.error());
  if (data->factors.empty()) return tl::unexpected(missing_option(*table, "a --factor"));
  const auto anova = analysed(*data, options);
  if (!anova) return base::fail(fmt::format("{}: {}", table->source(), anova.error().message));

  StatsReport report;
  report.warnings = anova->warnings;
  report.json = anova_json(*anova, *data);
  const bool several = anova->terms.size() > 1;
  report.text = fmt::format(
      "Analysis of variance of {}, {}{}\n\n", data->response, count_text(anova->n, "value"),
      several ? fmt::format(", sums of squares of type {}", std::string(std::size_t(anova->type) + 1, 'I'))
              : std::string());
  report.text += anova_table_text(*anova) + "\n";
  for (const AnovaTerm& term : anova->terms)
    report.text += fmt::format("  {}: {}\n", term.term, anova_sentence(term, *anova, several));
  note_intervals(report, *anova, several);
  std::string title = anova_title(*anova);
  if (options.welch) {
    auto welch = welch_part(*data);
    if (!welch) return base::fail(fmt::format("{}: {}", table->source(), welch.error().message));
    title = fmt::format("{}: {}", anova->terms.front().term, welch->sentence);
    report.text += fmt::format("  {}, whatever the variances\n", title);
    report.json["welch"] = std::move(welch->json);
  }
  const bool full_model = !several || !options.no_interactions;
  add_cells(report, *data, options.confidence);
  add_assumptions(report, *data, full_model);
  if (!options.plot.empty()) {
    auto chart = factorial_chart(*data, options);
    if (!chart) return tl::unexpected(chart.error());
    chart->title = std::move(title);
    report.chart = std::move(*chart);
  }
  return report;
}

}  // namespace icome::apps
