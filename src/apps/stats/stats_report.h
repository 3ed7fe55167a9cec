#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/stats/stats_chart.h"
#include "apps/stats/stats_json.h"
#include "apps/stats/stats_options.h"
#include "base/result.h"

namespace icome::apps {

/// The result of a test, in every form.
struct StatsReport {
  StatsJson json;                     // without the warnings
  std::string text;                   // for a person, without the notes
  std::vector<std::string> warnings;  // sentences, for both
  std::optional<StatsChart> chart;    // if options.plot names a file
};

// One function for each subcommand. Fails, in a sentence, where data, columns or values do not suit it.
base::Result<StatsReport> report_describe(const StatsOptions& options);
base::Result<StatsReport> report_anova(const StatsOptions& options);
base::Result<StatsReport> report_repeated_measures(const StatsOptions& options);
base::Result<StatsReport> report_t_test(const StatsOptions& options);
base::Result<StatsReport> report_wilcoxon(const StatsOptions& options);
base::Result<StatsReport> report_kruskal(const StatsOptions& options);
base::Result<StatsReport> report_friedman(const StatsOptions& options);
base::Result<StatsReport> report_chi_squared(const StatsOptions& options);
base::Result<StatsReport> report_fisher(const StatsOptions& options);
base::Result<StatsReport> report_binomial(const StatsOptions& options);
base::Result<StatsReport> report_mcnemar(const StatsOptions& options);
base::Result<StatsReport> report_correlation(const StatsOptions& options);
base::Result<StatsReport> report_post_hoc(const StatsOptions& options);
base::Result<StatsReport> report_power(const StatsOptions& options);

}  // namespace icome::apps
