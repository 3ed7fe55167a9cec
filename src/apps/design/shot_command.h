#pragma once
#include "apps/design/shot_options.h"

namespace icome::apps {

/// Runs `icome shot`: draws a design into a PNG file, without a window. Returns the process's exit code.
int run_shot(const ShotOptions& options);

}  // namespace icome::apps
