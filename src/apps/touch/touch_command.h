#pragma once
#include "apps/touch/touch_options.h"

namespace icome::apps {

/// Runs `icome touch` with options that check() accepted: loads, touches, reports. The report goes to
/// standard output, all else to standard error. Returns the program's exit code: 0; 1 when something
/// could not be done (a sentence says what); 130 when a replay was interrupted.
int run_touch(const TouchOptions& options);

}  // namespace icome::apps
