#pragma once
#include "apps/serving/serving_options.h"

namespace icome::apps {

/// Runs `icome serve`, until Ctrl-C or SIGTERM. Returns the exit code.
int run_serve_designs(const ServingOptions& options);

}  // namespace icome::apps
