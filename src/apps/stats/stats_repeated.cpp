#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_effects.h"
#include "apps/stats/stats_factors.h"
#include "apps/stats/stats_levels.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "stats/models/effect_sizes.h"
#include "stats/models/repeated_measures.h"

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

/// A share of variance that a term explains, and the population's interval of it.
struct EffectShare {
  const char* name;  // of the member in JSON
  const char* sign;  // in text
  double value;
  base::Result<stats::EffectInterval> interval;
};

std::vector<EffectShare> shares_of(const RepeatedMeasuresTerm& term) {
  const auto interval = [&](double rest) {
    return stats::share_interval(term.f, term.df, term.error_df, term.error_ms, rest, kEffectConfidence);
  };
  return {{"partial_eta_sq", "\u03b7\u00b2p", term.partial_eta_sq,
           stats::partial_eta_sq_interval(term.f, term.df, term.error_df, kEffectConfidence)},
          {"generalised_eta_sq", "\u03b7\u00b2G", term.generalised_eta_sq,
           interval(term.generalised_eta_sq_rest)},
          {"omega_sq", "\u03c9\u00b2", term.omega_sq, interval(term.omega_sq_rest)},
          {"partial_omega_sq", "\u03c9\u00b2p", term.partial_omega_sq, interval(term.partial_omega_sq_rest)}};
}

StatsJson repeated_term_json(const RepeatedMeasuresTerm& term) {
  StatsJson json = effect_json(term);
  for (const EffectShare& share : shares_of(term))
    json[fmt::format("{}_interval", share.name)] =
        share.interval ? StatsJson({share.interval->low, share.interval->high}) : StatsJson(nullptr);
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
  const auto interval = stats::partial_eta_sq_interval(it.f, it.df, it.error_df, kEffectConfidence);
  return fmt::format("F({}, {}) = {}, {}, \u03b7\u00b2p = {}{}{}", df_text(it.df * epsilon),
                     df_text(it.error_df * epsilon), fixed_text(it.f, 2),
                     p_text(doubtful ? it.p_greenhouse_geisser : it.p), share_text(it.partial_eta_sq),
                     interval ? fmt::format(", {} CI [{}, {}]", percent_text(kEffectConfidence),
                                            share_text(interval->low), share_text(interval->high))
                              : std::string(),
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

/// Every share of variance with its interval, a row a term.
std::string effects_text(const RepeatedMeasures& analysis) {
  std::vector<std::string> headings = {""};
  for (const EffectShare& share : shares_of(analysis.terms.front())) {
    headings.emplace_back(share.sign);
    headings.push_back(fmt::format("{} CI", percent_text(kEffectConfidence)));
  }
  TextTable table(headings);
  for (const RepeatedMeasuresTerm& term : analysis.terms) {
    std::vector<std::string> row = {term.term};
    for (const EffectShare& share : shares_of(term)) {
      row.push_back(share_text(share.value));
      row.push_back(share.interval ? fmt::format("[{}, {}]", share_text(share.interval->low),
                                                 share_text(share.interval->high))
                                   : std::string("-"));
    }
    table.add(std::move(row));
  }
  return fmt::format("\nEffect sizes, partial, generalised and omega squared\n{}", table.text());
}

/// Adds a warning where a share stands outside of its interval.
void note_shares(StatsReport& report, const RepeatedMeasures& analysis) {
  const auto stands_outside = [](const EffectShare& share) {
    return share.interval && (share.value < share.interval->low || share.value > share.interval->high);
  };
  if (std::ranges::any_of(analysis.terms, [&](const RepeatedMeasuresTerm& term) {
        return std::ranges::any_of(shares_of(term), stands_outside);
      }))
    report.warnings.emplace_back(
        "Intervals of effect sizes are of the population's, which are not below 0 and less than what few "
        "values "
        "show; so a value itself can stand outside.");
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
  report.text += effects_text(*analysis);
  note_shares(report, *analysis);
  leave_out(*data, analysis->left_out);
  *data = people_means(*data);
  add_cells(report, *data, options.confidence);
  add_assumptions(report, *data, true);
  report.text += sphericity_text(*analysis);
  if (const auto compared = add_level_comparisons(report, *data, options); !compared)
    return base::fail(fmt::format("{}: {}", table->source(), compared.error().message));
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
