#pragma once
#include "apps/devices/devices_options.h"

namespace CLI {  // NOLINT(readability-identifier-naming): the library's name
class App;
}

namespace icome::apps {

/// The options of `icome devices` and its subcommands, which set `options`.
void add_devices_options(CLI::App& devices, DevicesOptions& options);

/// Runs `icome devices`: lists, tests or calibrates. Returns the program's exit code.
int run_devices(const DevicesOptions& options);

}  // namespace icome::apps
