#pragma once
#include "apps/sketch/sketch_options.h"

namespace icome::apps {

/// Fits, draws, changes or lists what a pen drew. Gives the exit code.
int run_sketch(const SketchOptions& options);

}  // namespace icome::apps
