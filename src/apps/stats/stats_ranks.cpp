#include <fmt/format.h>

#include "apps/stats/stats_data.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"
#include "stats/tables/descriptives.h"
#include "stats/tests/rank_tests.h"

namespace icome::apps {
namespace {

/// The groups that rank tests compare, with their mean ranks.
struct RankGroups {
  Samples samples;
  std::vector<double> mean_ranks;  // empty where there are none
};

StatsJson rank_groups_json(const RankGroups& groups) {
  StatsJson json = StatsJson::array();
  for (std::size_t i = 0; i < groups.samples.names.size(); ++i) {
    const std::vector<double>& values = groups.samples.values[i];
    StatsJson group = {{"name", base::as_utf8(groups.samples.names[i])}, {"n", values.size()}};
    if (const auto it = stats::describe(values)) group["median"] = it->median;
    if (!groups.mean_ranks.empty()) group["mean_rank"] = groups.mean_ranks[i];
    json.push_back(std::move(group));
  }
  return json;
}

std::string rank_groups_text(const RankGroups& groups) {
  TextTable table({"", "n", "median", "quartiles", groups.mean_ranks.empty() ? "" : "mean rank"});
  for (std::size_t i = 0; i < groups.samples.names.size(); ++i) {
    const auto it = stats::describe(groups.samples.values[i]);
    if (!it) continue;
    const int decimals = decimals_for(it->standard_deviation);
    table.add({groups.samples.names[i], std::to_string(it->n), fixed_text(it->median, decimals),
               interval_text(it->lower_quartile, it->upper_quartile, decimals),
               groups.mean_ranks.empty() ? "" : fixed_text(groups.mean_ranks[i], 2)});
  }
  return table.text();
}

/// The report of head, groups and sentence, with the chart where one is asked for.
base::Result<StatsReport> rank_report(const RankGroups& groups, StatsJson json, const std::string& name,
                                      const std::string& sentence, const StatsOptions& options) {
  StatsReport report;
  report.warnings = groups.samples.warnings;
  report.json = std::move(json);
  report.json["groups"] = rank_groups_json(groups);
  report.text = fmt::format("{}, {} by {}\n\n{}\n  {}\n", name, groups.samples.response,
                            groups.samples.factor, rank_groups_text(groups), sentence);
  if (options.plot.empty()) return report;
  const auto kind = chart_kind(options, {ChartKind::Box, ChartKind::Bars});
  if (!kind) return tl::unexpected(kind.error());
  report.chart = chart_of_samples(groups.samples, *kind, options.confidence);
  report.chart->title = fmt::format("{}: {}", name, sentence);
  return report;
}

stats::RankTestSettings rank_settings(const StatsOptions& options) {
  stats::RankTestSettings settings;
  settings.null_shift = options.mean;
  settings.alternative = options.alternative == "less"      ? stats::Alternative::Less
                         : options.alternative == "greater" ? stats::Alternative::Greater
                                                            : stats::Alternative::TwoSided;
  return settings;
}

std::string rank_sentence(const stats::RankTest& test, bool signed_ranks) {
  const std::string how =
      test.exact ? std::string(", exact") : fmt::format(", z = {}", fixed_text(test.z, 2));
  return fmt::format("{} = {}{}, {}, rank-biserial r = {}", signed_ranks ? "V" : "U", figure(test.statistic),
                     how, p_text(test.p), share_text(test.rank_biserial));
}

}  // namespace

base::Result<StatsReport> report_wilcoxon(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  auto samples = options.paired ? read_matched_samples(*table, options) : read_samples(*table, options);
  if (!samples) return tl::unexpected(samples.error());
  if (samples->names.size() != 2)
    return base::fail(fmt::format("{}: Wilcoxon's tests compare two groups, and there are {}; {}.",
                                  table->source(), samples->names.size(),
                                  options.paired ? "use icome stats friedman" : "use icome stats kruskal"));
  const RankGroups groups{std::move(*samples), {}};
  const auto& values = groups.samples.values;
  const auto test = options.paired ? stats::signed_rank_test(values[0], values[1], rank_settings(options))
                                   : stats::rank_sum_test(values[0], values[1], rank_settings(options));
  if (!test) return base::fail(fmt::format("{}: {}", table->source(), test.error().message));
  const std::string name = options.paired ? "Wilcoxon's signed rank test" : "Wilcoxon's rank sum test";
  StatsJson json = {{"test", name},
                    {"alternative", options.alternative},
                    {options.paired ? "v" : "u", test->statistic},
                    {"z", test->exact ? StatsJson(nullptr) : StatsJson(test->z)},
                    {"p", test->p},
                    {"exact", test->exact},
                    {"rank_biserial", test->rank_biserial},
                    {"ties", test->ties},
                    {"zeros", test->zeros}};
  return rank_report(groups, std::move(json), name, rank_sentence(*test, options.paired), options);
}

base::Result<StatsReport> report_kruskal(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  auto samples = read_samples(*table, options);
  if (!samples) return tl::unexpected(samples.error());
  const auto test = stats::kruskal_wallis(samples->values);
  if (!test) return base::fail(fmt::format("{}: {}", table->source(), test.error().message));
  StatsJson json = {{"test", "Kruskal-Wallis"},
                    {"h", test->h},
                    {"df", test->df},
                    {"p", test->p},
                    {"epsilon_squared", test->epsilon_squared}};
  const std::string sentence =
      fmt::format("H({}) = {}, {}, \u03b5\u00b2 = {}", df_text(test->df), fixed_text(test->h, 2),
                  p_text(test->p), share_text(test->epsilon_squared));
  return rank_report({std::move(*samples), test->mean_ranks}, std::move(json), "Kruskal-Wallis test",
                     sentence, options);
}

base::Result<StatsReport> report_friedman(const StatsOptions& asked) {
  StatsOptions options = asked;
  const auto table = open_table(options);
  if (!table) return tl::unexpected(table.error());
  auto samples = read_matched_samples(*table, options);
  if (!samples) return tl::unexpected(samples.error());
  const std::size_t people = samples->values.empty() ? 0 : samples->values.front().size();
  std::vector<std::vector<double>> blocks(people);
  for (std::size_t i = 0; i < people; ++i)
    for (const std::vector<double>& group : samples->values) blocks[i].push_back(group[i]);
  const auto test = stats::friedman(blocks);
  if (!test) return base::fail(fmt::format("{}: {}", table->source(), test.error().message));
  StatsJson json = {{"test", "Friedman"}, {"chi_squared", test->chi_squared}, {"df", test->df},
                    {"p", test->p},       {"kendall_w", test->kendall_w},     {"subjects", people}};
  const std::string sentence =
      fmt::format("\u03c7\u00b2({}, N = {}) = {}, {}, W = {}", df_text(test->df), people,
                  fixed_text(test->chi_squared, 2), p_text(test->p), share_text(test->kendall_w));
  return rank_report({std::move(*samples), test->mean_ranks}, std::move(json), "Friedman test", sentence,
                     options);
}

}  // namespace icome::apps
