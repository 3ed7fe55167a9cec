#pragma once
#include "apps/collab/collab_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace icome::apps {

/// The subcommands `serve`, `invite`, `revoke` and `store`, which set `options`.
void add_collab_commands(CLI::App& app, CollabOptions& options);

/// Runs one of them. Returns the program's exit code.
int run_collab(const CollabOptions& options);

}  // namespace icome::apps
