#pragma once
#include "apps/stats/stats_factors.h"

namespace icome::apps {

/// The levels of --post-hoc and --simple factors compared, to text and JSON ("post_hoc", "simple_effects").
/// Data of subjects. Fails where a factor is none of the analysis.
base::Result<void> add_level_comparisons(StatsReport& report, const FactorialData& data,
                                         const StatsOptions& options);

}  // namespace icome::apps
