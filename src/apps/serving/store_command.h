#pragma once
#include "apps/serving/serving_options.h"

namespace icome::apps {

/// Runs `icome store list`, `check`, `backup`, `restore` or `export`. Returns the exit code.
int run_store(const ServingOptions& options);

}  // namespace icome::apps
