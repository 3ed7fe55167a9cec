#pragma once
#include "apps/sketch/sketch_options.h"

namespace icome::apps {

/// Fits curves to the strokes of a pen. Gives the exit code.
int run_sketch_fit(const SketchOptions& options);

}  // namespace icome::apps
