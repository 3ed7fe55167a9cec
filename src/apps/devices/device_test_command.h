#pragma once
#include "apps/devices/devices_options.h"

namespace icome::apps {

/// Runs `icome devices test`. Returns the program's exit code.
int run_device_test(const DevicesOptions& options);

}  // namespace icome::apps
