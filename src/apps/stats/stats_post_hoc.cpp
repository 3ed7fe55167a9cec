#include <fmt/format.h>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "stats/models/post_hoc.h"

namespace icome::apps {
namespace {

std::string comparison_table(const Samples& samples, const std::vector<stats::PairComparison>& pairs,
                             const StatsOptions& options, bool tukey) {
  TextTable table({"", "difference", fmt::format("{} CI", percent_text(options.confidence)),
                   tukey ? "q" : "t", "p adjusted"});
  for (const stats::PairComparison& pair : pairs) {
    const int decimals = decimals_for(pair.interval.high - pair.interval.low);
    table.add({fmt::format("{} - {}", samples.names[pair.second], samples.names[pair.first]),
               fixed_text(pair.difference, decimals),
               interval_text(pair.interval.low, pair.interval.high, decimals), fixed_text(pair.statistic, 2),
               p_cell(pair.p)});
  }
  return table.text();
}

StatsJson comparison_json(const Samples& samples, const stats::PairComparison& pair, bool tukey) {
  return {{"first", base::as_utf8(samples.names[pair.first])},
          {"second", base::as_utf8(samples.names[pair.second])},
          {"difference", pair.difference},
          {tukey ? "q" : "t", pair.statistic},
          {"df", pair.df},
          {"interval", {pair.interval.low, pair.interval.high}},
          {"p_adjusted", pair.p}};
}

base::Result<std::vector<stats::PairComparison>> compared(const Samples& samples,
                                                          const StatsOptions& options) {
  if (options.method != "holm") return stats::tukey_hsd(samples.values, options.confidence);
  const auto error = options.paired ? stats::PairwiseError::Paired : stats::PairwiseError::Pooled;
  return stats::pairwise_t_tests(samples.values, stats::Adjustment::Holm, error, options.confidence);
}

}  // namespace

base::Result<StatsReport> report_post_hoc(const StatsOptions& asked) {
  StatsOptions options = asked;
  const bool tukey = options.method != "holm";
  if (tukey && options.paired)
    return base::fail("Tukey's test is for separate groups; with --paired choose --method holm.");
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  const auto samples = options.paired ? read_matched_samples(*table, options) : read_samples(*table, options);
  if (!samples) return tl::unexpected(samples.error());
  const auto pairs = compared(*samples, options);
  if (!pairs) return base::fail(fmt::format("{}: {}", table->source(), pairs.error().message));
  const std::string name = tukey            ? "Tukey's honest significant differences"
                           : options.paired ? "Paired t-tests after Holm"
                                            : "Pairwise t-tests after Holm";
  StatsReport report;
  report.warnings = samples->warnings;
  report.json = {{"test", tukey ? "Tukey" : "Holm"}, {"confidence", options.confidence}};
  report.json["comparisons"] = StatsJson::array();
  std::size_t significant = 0;
  for (const stats::PairComparison& pair : *pairs) {
    report.json["comparisons"].push_back(comparison_json(*samples, pair, tukey));
    significant += pair.p < 0.05 ? 1U : 0U;
  }
  const std::string sentence =
      fmt::format("{} of {} differ, p adjusted < .05", significant, count_text(pairs->size(), "pair"));
  report.text = fmt::format("{}, {} by {}\n\n{}\n  {}\n", name, samples->response, samples->factor,
                            comparison_table(*samples, *pairs, options, tukey), sentence);
  if (options.plot.empty()) return report;
  const auto kind = chart_kind(options, {ChartKind::Bars, ChartKind::Box});
  if (!kind) return tl::unexpected(kind.error());
  report.chart = chart_of_samples(*samples, *kind, options.confidence);
  report.chart->title = fmt::format("{}: {}", name, sentence);
  return report;
}

}  // namespace icome::apps
