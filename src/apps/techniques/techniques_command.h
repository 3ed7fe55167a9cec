#pragma once
#include "apps/techniques/techniques_options.h"

namespace icome::apps {

/// Runs `icome techniques`: lets simulated people select targets with every technique. Returns the process's
/// exit code.
int run_techniques(const TechniquesOptions& options);

}  // namespace icome::apps
