#pragma once
#include <string>

#include "apps/stats/stats_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): a library's
class App;
}

namespace icome::apps {

/// The options of `icome stats` and its subcommands, which set `options`.
void add_stats_options(CLI::App& stats, StatsOptions& options);

/// A sentence about options that do not fit together; empty if all do.
std::string misfit(const StatsOptions& options);

/// Runs `icome stats`: reads a table, makes a test and prints its result for a person or as JSON, and draws
/// it where asked to. Returns the program's exit code.
int run_stats(const StatsOptions& options);

}  // namespace icome::apps
