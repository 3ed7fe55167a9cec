#pragma once
#include "apps/devices/devices_options.h"

namespace icome::apps {

/// Runs `icome devices serve` until it is asked to end. Returns the program's exit code.
int run_serve(const DevicesOptions& options);

}  // namespace icome::apps
