#include <fmt/format.h>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "stats/tables/descriptives.h"
#include "stats/tests/assumptions.h"
#include "stats/tests/t_tests.h"

namespace icome::apps {
namespace {

stats::Alternative alternative_of(const StatsOptions& options) {
  if (options.alternative == "less") return stats::Alternative::Less;
  return options.alternative == "greater" ? stats::Alternative::Greater : stats::Alternative::TwoSided;
}

/// A test, its name and its data.
struct TRun {
  std::string name;
  std::string what;
  Samples samples;
  base::Result<stats::TTest> test;
};

std::string standardiser_name(stats::Standardiser standardiser) {
  switch (standardiser) {
    case stats::Standardiser::SampleSd:
      return "standard deviation";
    case stats::Standardiser::PooledSd:
      return "pooled standard deviation";
    case stats::Standardiser::DifferenceSd:
      return "standard deviation of the differences";
  }
  return {};
}

TRun run_one_sample(Samples samples, const StatsOptions& options, const stats::TTestSettings& settings) {
  const auto test = stats::one_sample_t_test(samples.values[0], settings);
  std::string what = fmt::format("{} against {:g}", samples.names[0], options.mean);
  return {"One-sample t-test", std::move(what), std::move(samples), test};
}

TRun run_two_samples(Samples samples, const StatsOptions& options, const stats::TTestSettings& settings) {
  const auto test = options.pooled ? stats::pooled_t_test(samples.values[0], samples.values[1], settings)
                                   : stats::welch_t_test(samples.values[0], samples.values[1], settings);
  std::string what = fmt::format("{}: {} less {}", samples.response, samples.names[0], samples.names[1]);
  return {options.pooled ? "T-test with equal variances" : "Welch's t-test", std::move(what),
          std::move(samples), test};
}

TRun run_pairs(Samples samples, const stats::TTestSettings& settings) {
  const auto test = stats::paired_t_test(samples.values[0], samples.values[1], settings);
  std::string what =
      fmt::format("{}: {} less {}, by pairs", samples.response, samples.names[0], samples.names[1]);
  return {"Paired t-test", std::move(what), std::move(samples), test};
}

base::Result<Samples> samples_of_t_test(const stats::DataTable& table, const StatsOptions& options) {
  StatsOptions asked = options;
  // A response without groups is tested as one column.
  if (asked.columns.empty() && asked.factors.empty() && asked.within.empty() && !asked.response.empty())
    asked.columns = {asked.response};
  auto samples = asked.paired ? read_matched_samples(table, asked) : read_samples(table, asked);
  if (!samples) return samples;
  const std::size_t groups = samples->names.size();
  if (groups > 2)
    return base::fail(
        fmt::format("{}: a t-test compares two groups, and there are {}; use icome stats anova.",
                    table.source(), groups));
  if (groups < 2 && (asked.paired || asked.columns.empty()))
    return base::fail(fmt::format("{}: a t-test compares two groups, and there is {}.", table.source(),
                                  groups == 0 ? "none" : "one only"));
  return samples;
}

StatsJson t_groups_json(const Samples& samples) {
  StatsJson groups = StatsJson::array();
  for (std::size_t i = 0; i < samples.names.size(); ++i) {
    const auto it = stats::describe(samples.values[i]);
    if (it)
      groups.push_back({{"name", base::as_utf8(samples.names[i])},
                        {"n", it->n},
                        {"mean", it->mean},
                        {"sd", it->standard_deviation}});
  }
  return groups;
}

std::string t_groups_text(const Samples& samples) {
  TextTable table({"", "n", "mean", "SD"});
  for (std::size_t i = 0; i < samples.names.size(); ++i) {
    const auto it = stats::describe(samples.values[i]);
    if (!it) continue;
    const int decimals = decimals_for(it->standard_deviation);
    table.add({samples.names[i], std::to_string(it->n), fixed_text(it->mean, decimals),
               fixed_text(it->standard_deviation, decimals)});
  }
  return table.text();
}

/// Adds tests of normality of what the test takes as normal: each sample, or the differences.
void add_t_assumptions(StatsReport& report, const TRun& run, bool paired) {
  std::vector<std::vector<double>> sets = run.samples.values;
  std::vector<std::string> names = run.samples.names;
  if (paired) {
    for (std::size_t i = 0; i < sets[0].size(); ++i) sets[0][i] -= sets[1][i];
    sets.pop_back();
    names = {"differences"};
  }
  report.text += "\nAssumptions\n";
  StatsJson json = StatsJson::array();
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const auto test = stats::shapiro_wilk(sets[i]);
    if (test) json.push_back({{"name", base::as_utf8(names[i])}, {"w", test->w}, {"p", test->p}});
    report.text +=
        test ? fmt::format("  normal, Shapiro-Wilk, {}: W = {}, {}\n", names[i], share_text(test->w, 3),
                           p_text(test->p))
             : fmt::format("  normal, Shapiro-Wilk, {}: not tested: {}\n", names[i], test.error().message);
  }
  report.json["assumptions"] = {{"shapiro_wilk", std::move(json)}};
  if (sets.size() < 2) return;
  const auto levene = stats::brown_forsythe_test(sets);
  if (!levene) return;
  report.json["assumptions"]["brown_forsythe"] = {
      {"f", levene->statistic}, {"df", levene->df}, {"error_df", levene->error_df}, {"p", levene->p}};
  report.text += fmt::format("  equal variances, Brown-Forsythe: F({}, {}) = {}, {}\n", df_text(levene->df),
                             df_text(levene->error_df), fixed_text(levene->statistic, 2), p_text(levene->p));
}

std::string t_sentence(const stats::TTest& test) {
  return fmt::format("t({}) = {}, {}, d = {}", df_text(test.df), fixed_text(test.t, 2), p_text(test.p),
                     fixed_text(test.d, 2));
}

StatsReport t_report(const TRun& run, const StatsOptions& options) {
  const stats::TTest& test = *run.test;
  StatsReport report;
  report.warnings = run.samples.warnings;
  report.json = {{"test", run.name},
                 {"alternative", options.alternative},
                 {"t", test.t},
                 {"df", test.df},
                 {"p", test.p},
                 {"difference", test.difference},
                 {"standard_error", test.standard_error},
                 {"confidence", options.confidence},
                 {"interval", {test.interval.low, test.interval.high}},
                 {"d", test.d},
                 {"d_interval", {test.d_interval.low, test.d_interval.high}},
                 {"groups", t_groups_json(run.samples)}};
  const int decimals = decimals_for(test.standard_error);
  report.text = fmt::format("{}, {}\n\n{}\n", run.name, run.what, t_groups_text(run.samples));
  report.text += fmt::format("  {}, {} CI {}\n", t_sentence(test), percent_text(options.confidence),
                             interval_text(test.d_interval.low, test.d_interval.high, 2));
  report.text += fmt::format("  {} {}, {} CI {}\n", run.samples.names.size() == 1 ? "mean" : "difference",
                             fixed_text(test.difference, decimals), percent_text(options.confidence),
                             interval_text(test.interval.low, test.interval.high, decimals));
  report.text += fmt::format("  d: in units of the {}\n", standardiser_name(test.standardiser));
  return report;
}

}  // namespace

base::Result<StatsReport> report_t_test(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  auto samples = samples_of_t_test(*table, options);
  if (!samples) return tl::unexpected(samples.error());
  stats::TTestSettings settings;
  settings.null_value = options.mean;
  settings.alternative = alternative_of(options);
  settings.confidence = options.confidence;
  const TRun run = samples->names.size() == 1 ? run_one_sample(std::move(*samples), options, settings)
                   : options.paired           ? run_pairs(std::move(*samples), settings)
                                              : run_two_samples(std::move(*samples), options, settings);
  if (!run.test) return base::fail(fmt::format("{}: {}", table->source(), run.test.error().message));
  StatsReport report = t_report(run, options);
  add_t_assumptions(report, run, options.paired);
  if (!options.plot.empty()) {
    const auto kind = chart_kind(options, {ChartKind::Box, ChartKind::Bars});
    if (!kind) return tl::unexpected(kind.error());
    report.chart = chart_of_samples(run.samples, *kind, options.confidence);
    report.chart->title = fmt::format("{}: {}", run.name, t_sentence(*run.test));
  }
  return report;
}

}  // namespace icome::apps
