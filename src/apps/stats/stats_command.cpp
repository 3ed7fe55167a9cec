#include "apps/stats/stats_command.h"

#include <fmt/format.h>

#include <algorithm>

#include "apps/design/design_work.h"
#include "apps/stats/stats_report.h"
#include "apps/stats/stats_text.h"
#include "base/utf8.h"

namespace icome::apps {
namespace {

using Reporter = base::Result<StatsReport> (*)(const StatsOptions&);

/// A subcommand and the function that makes its report.
struct StatsTest {
  const char* name;
  Reporter report;
};

constexpr StatsTest kStatsTests[] = {
    {"describe", report_describe},   {"anova", report_anova},          {"ttest", report_t_test},
    {"wilcoxon", report_wilcoxon},   {"kruskal", report_kruskal},      {"friedman", report_friedman},
    {"chisq", report_chi_squared},   {"fisher", report_fisher},        {"mcnemar", report_mcnemar},
    {"pearson", report_correlation}, {"spearman", report_correlation}, {"tukey", report_post_hoc},
    {"binomial", report_binomial},   {"power", report_power},
};

base::Result<StatsReport> answered(const StatsOptions& options) {
  for (const StatsTest& test : kStatsTests)
    if (options.test == test.name) return test.report(options);
  return base::fail(fmt::format("there is no test \"{}\".", options.test));
}

/// Do both paths lead to one file, however they are written?
bool is_same_file(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::error_code failed;
  return one == other || std::filesystem::equivalent(one, other, failed);
}

/// Does the test know which values are of the same person?
bool pairs_people(const StatsOptions& options) {
  if (options.test == "anova") return !options.within.empty();
  return options.paired || options.test == "friedman";
}

std::string whole_answer(StatsReport& report, bool json) {
  if (!json) return without_control_characters(base::as_utf8(report.text + notes_text(report.warnings)));
  report.json["warnings"] = StatsJson::array();
  for (const std::string& warning : report.warnings)
    report.json["warnings"].push_back(base::as_utf8(warning));
  return report.json.text();
}

}  // namespace

std::string misfit(const StatsOptions& options) {
  if (!options.plot.empty() && !is_chart_name(options.plot))
    return fmt::format("--plot {} ends neither in .svg nor in .png.", options.plot.string());
  if (options.plot.empty() && !options.plot_kind.empty()) return "--plot-kind goes with --plot.";
  if (!options.plot.empty() && is_same_file(options.plot, options.data))
    return "the plot would replace the data; give another name.";
  if (!options.subject.empty() && !pairs_people(options))
    return fmt::format("--subject goes with {}; without that, each row is taken for another person.",
                       options.test == "anova" ? "--within" : "--paired");
  if (options.within.empty() && !(options.post_hoc.empty() && options.simple.empty()))
    return fmt::format("{} goes with --within; pairs of separate groups: icome stats tukey.",
                       options.post_hoc.empty() ? "--simple" : "--post-hoc");
  if (!options.z_table.empty() && is_same_file(options.z_table, options.data))
    return "--z would replace the data; give another name.";
  if (!options.z_table.empty() && options.z_table.extension() != ".csv" &&
      options.z_table.extension() != ".tsv")
    return fmt::format("--z {} ends neither in .csv nor in .tsv.", options.z_table.string());
  if (!options.within.empty() && (options.no_interactions || options.welch))
    return fmt::format("{} goes without --within.", options.welch ? "--welch" : "--no-interactions");
  if (!(options.confidence > 0.0 && options.confidence < 1.0))
    return fmt::format("--confidence is {:g}; choose a number between 0 and 1, such as 0.95.",
                       options.confidence);
  if (options.test != "power" && options.data.empty() == options.counts.empty())
    return options.data.empty() ? "give a table of data, as icome stats anova data.csv."
                                : "--counts goes without a table of data.";
  return {};
}

int run_stats(const StatsOptions& options) {
  StatusLine status;
  auto report = answered(options);
  if (!report)
    return end_without_result({without_control_characters(base::as_utf8(report.error().message))}, status);
  if (report->chart) {
    const auto written = write_chart(*report->chart, options.plot);
    if (!written) return end_without_result(written.error(), status);
  }
  return print_answer(whole_answer(*report, options.json));
}

}  // namespace icome::apps
