#pragma once
#include "apps/devices/devices_options.h"

namespace icome::apps {

/// Runs `icome devices calibrate`. Returns the program's exit code.
int run_calibrate(const DevicesOptions& options);

}  // namespace icome::apps
