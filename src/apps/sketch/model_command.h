#pragma once
#include "apps/sketch/sketch_options.h"

namespace icome::apps {

/// Makes a design of a drawing, to be touched. Gives the exit code.
int run_sketch_model(const SketchOptions& options);

}  // namespace icome::apps
