#pragma once
#include "apps/sketch/sketch_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// icome sketch open: the window of a drawing.
void add_sketch_open(CLI::App& sketch, SketchOptions& options);
int run_sketch_open(const SketchOptions& options);

}  // namespace icome::apps
