#pragma once
#include "apps/collab/collab_options.h"

namespace icome::apps {

/// Runs `icome serve`, until Ctrl-C or SIGTERM. Returns the exit code.
int run_serve_designs(const CollabOptions& options);

}  // namespace icome::apps
