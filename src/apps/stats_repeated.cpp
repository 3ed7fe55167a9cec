#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "apps/stats_data.h"
#include "apps/stats_effects.h"
#include "apps/stats_factors.h"
#include "apps/stats_report.h"
#include "apps/stats_text.h"
#include "stats/repeated_measures.h"

namespace icome::apps {
namespace {

using stats::RepeatedMeasures;
using stats::RepeatedMeasuresTerm;

StatsJson sphericity_json(const RepeatedMeasuresTerm& term) {
  if (!term.sphericity) return nullptr;
  const stats::Sphericity& it = *term.sphericity;
  return {{"mauchly_w", it.mauchly_w},
          {"p", it.p},
          {"greenhouse_geisser", it.greenhouse_geisser},
          {"huynh_feldt", it.huynh_feldt},
          {"lower_bound", it.lower_bound}};
}

StatsJson repeated_term_json(const RepeatedMeasuresTerm& term) {
  StatsJson json = effect_json(term);
  json["error"] = squares_json(term.error_df, term.error_ss, term.error_ms);
  json["sphericity"] = sphericity_json(term);
  json["p_greenhouse_geisser"] = term.p_greenhouse_geisser;
  json["p_huynh_feldt"] = term.p_huynh_feldt;
  return json;
}

StatsJson repeated_json(const RepeatedMeasures& analysis, const FactorialData& data) {
  StatsJson json;
  json["test"] = "repeated measures anova";
  json["response"] = data.response;
  json["type"] = int(analysis.type) + 1;
  json["table"] = StatsJson::array();
  for (const RepeatedMeasuresTerm& term : analysis.terms) json["table"].push_back(repeated_term_json(term));
  const RepeatedMeasuresTerm& last = analysis.terms.back();
  json["residual"] = squares_json(last.error_df, last.error_ss, last.error_ms);
  const stats::AnovaResidual& people = analysis.between_subjects;
  json["between_subjects"] = squares_json(people.df, people.ss, people.ms);
  json["total_ss"] = analysis.total_ss;
  json["n"] = analysis.observations;
  json["subjects"] = analysis.subjects;
  json["missing"] = analysis.missing;
  return json;
}

std::string repeated_table_text(const RepeatedMeasures& analysis) {
  TextTable table({"", "df", "error df", "SS", "error SS", "F", "p", "p (GG)", "p (HF)", "\u03b7\u00b2p",
                   "\u03b7\u00b2G"});
  double largest = 0.0;
  for (const RepeatedMeasuresTerm& term : analysis.terms)
    largest = std::max({largest, term.ss, term.error_ss});
  const int decimals = decimals_for(largest, 5);
  for (const RepeatedMeasuresTerm& it : analysis.terms) {
    const bool corrected = it.sphericity.has_value();
    table.add({it.term, std::to_string(it.df), std::to_string(it.error_df), fixed_text(it.ss, decimals),
               fixed_text(it.error_ss, decimals), fixed_text(it.f, 2), p_cell(it.p),
               corrected ? p_cell(it.p_greenhouse_geisser) : "", corrected ? p_cell(it.p_huynh_feldt) : "",
               share_text(it.partial_eta_sq), share_text(it.generalised_eta_sq)});
  }
  return table.text();
}

/// The sentence for a paper: with Greenhouse and Geisser's degrees of freedom where sphericity is in doubt.
std::string repeated_sentence(const RepeatedMeasuresTerm& it) {
  const bool doubtful = it.sphericity && it.sphericity->p < 0.05;
  const double epsilon = doubtful ? it.sphericity->greenhouse_geisser : 1.0;
  return fmt::format("F({}, {}) = {}, {}, \u03b7\u00b2p = {}{}", df_text(it.df * epsilon),
                     df_text(it.error_df * epsilon), fixed_text(it.f, 2),
                     p_text(doubtful ? it.p_greenhouse_geisser : it.p), share_text(it.partial_eta_sq),
                     doubtful ? ", after Greenhouse and Geisser" : "");
}

std::string sphericity_text(const RepeatedMeasures& analysis) {
  TextTable table({"sphericity", "Mauchly's W", "p", "\u03b5 (GG)", "\u03b5 (HF)"});
  bool any = false;
  for (const RepeatedMeasuresTerm& it : analysis.terms) {
    if (!it.sphericity) continue;
    any = true;
    table.add({it.term, share_text(it.sphericity->mauchly_w, 3), p_cell(it.sphericity->p),
               share_text(it.sphericity->greenhouse_geisser, 3),
               share_text(std::min(it.sphericity->huynh_feldt, 1.0), 3)});
  }
  return any ? table.text() : std::string();
}

/// Takes the values of these subjects away, so that means, checks and chart are of those who were analysed.
void leave_out(FactorialData& data, const std::vector<std::string>& subjects) {
  const std::set<std::string> gone(subjects.begin(), subjects.end());
  for (std::size_t i = 0; i < data.values.size(); ++i) {
    const int subject = data.subject.of[i];
    if (subject != stats::kNoLevel && gone.contains(data.subject.levels[std::size_t(subject)]))
      data.values[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

base::Result<StatsReport> report_repeated_measures(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  if (options.subject.empty())
    return tl::unexpected(missing_option(*table, "--subject, who --within is of,"));
  auto data = read_factorial(*table, options);
  if (!data) return tl::unexpected(data.error());
  const auto analysis = stats::repeated_measures_anova(data->values, data->subject, data->within,
                                                       data->factors, stats::SumsOfSquares(options.type - 1));
  if (!analysis) return base::fail(fmt::format("{}: {}", table->source(), analysis.error().message));

  StatsReport report;
  report.warnings = analysis->warnings;
  report.json = repeated_json(*analysis, *data);
  report.text =
      fmt::format("Analysis of variance of {} with repeated measures, {}, {}\n\n", data->response,
                  count_text(analysis->subjects, "subject"), count_text(analysis->observations, "value"));
  report.text += repeated_table_text(*analysis) + "\n";
  for (const RepeatedMeasuresTerm& it : analysis->terms)
    report.text += fmt::format("  {}: {}\n", it.term, repeated_sentence(it));
  leave_out(*data, analysis->left_out);
  *data = people_means(*data);
  add_cells(report, *data, options.confidence);
  add_assumptions(report, *data, true);
  report.text += sphericity_text(*analysis);
  if (!options.plot.empty()) {
    auto chart = factorial_chart(*data, options);
    if (!chart) return tl::unexpected(chart.error());
    chart->title =
        fmt::format("{}: {}", analysis->terms.back().term, repeated_sentence(analysis->terms.back()));
    report.chart = std::move(*chart);
  }
  return report;
}

}  // namespace icome::apps
