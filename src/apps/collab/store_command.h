#pragma once
#include "apps/collab/collab_options.h"

namespace icome::apps {

/// Runs `icome store list`, `check`, `backup`, `restore` or `export`. Returns the exit code.
int run_store(const CollabOptions& options);

}  // namespace icome::apps
