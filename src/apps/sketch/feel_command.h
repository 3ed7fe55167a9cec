#pragma once
#include "apps/sketch/sketch_options.h"

namespace icome::apps {

/// Draws strokes with a simulated pen and tells what it felt. Gives the exit code.
int run_sketch_feel(const SketchOptions& options);

}  // namespace icome::apps
