#pragma once
#include "apps/sketch/sketch_options.h"

namespace icome::apps {

/// Changes a drawing by a script of tools, or lists the tools. Gives the exit code.
int run_sketch_edit(const SketchOptions& options);

}  // namespace icome::apps
