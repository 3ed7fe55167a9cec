#pragma once
#include "apps/stats/stats_factors.h"

namespace icome::apps {

/// Adds comparisons of the levels of --post-hoc and --simple factors to text and JSON ("post_hoc",
/// "simple_effects"). For data of subjects. Fails for a factor that is not in the analysis.
base::Result<void> add_level_comparisons(StatsReport& report, const FactorialData& data,
                                         const StatsOptions& options);

}  // namespace icome::apps
