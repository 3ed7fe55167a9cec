#pragma once
#include "apps/serving/serving_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace icome::apps {

/// The subcommands `serve`, `invite`, `revoke` and `store`, which set `options`.
void add_serving_commands(CLI::App& app, ServingOptions& options);

/// Runs one of them. Returns the program's exit code.
int run_serving(const ServingOptions& options);

}  // namespace icome::apps
