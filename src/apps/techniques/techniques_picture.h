#pragma once
#include "charts/image.h"
#include "interaction/techniques/bench/technique_bench.h"

namespace icome::apps {

/// The bench's result as a page of 1600 x 1240 pixels: the ranking with its throughputs, times over indices
/// of difficulty with their lines, and the time of every technique in every condition.
charts::Image draw_techniques(const interaction::BenchResult& result);

}  // namespace icome::apps
