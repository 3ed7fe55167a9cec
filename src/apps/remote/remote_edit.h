#pragma once
#include "apps/design/design_options.h"

namespace icome::apps {

/// Runs `icome edit ADDRESS`: performs a script on a design on a server, each line one action, waits until
/// all is durable, and with --watch tells what happens to the design until it is asked to end. Returns the
/// exit code.
int run_remote_edit(const EditOptions& options);

}  // namespace icome::apps
