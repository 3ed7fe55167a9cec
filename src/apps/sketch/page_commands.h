#pragma once
#include "apps/sketch/sketch_options.h"

namespace icome::apps {

/// Makes a picture of a drawing or of strokes. Gives the exit code.
int run_sketch_render(const SketchOptions& options);
/// Lists layers and strokes. Gives the exit code.
int run_sketch_list(const SketchOptions& options);

}  // namespace icome::apps
