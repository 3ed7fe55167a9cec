#pragma once
#include "apps/track/track_options.h"

namespace icome::apps {

/// Follows triangles of plastic on a table, or makes what that needs. Gives the exit code.
int run_track(const TrackOptions& options);

}  // namespace icome::apps
