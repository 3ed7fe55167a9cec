#pragma once
#include "apps/animate/animate_options.h"

namespace icome::apps {

/// Looks at, changes, records, saves and renders a cut-out animation, or opens it in a window. Gives the exit
/// code.
int run_animate(const AnimateOptions& options);

}  // namespace icome::apps
