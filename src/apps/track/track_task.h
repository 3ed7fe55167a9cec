#pragma once
#include "apps/track/track_options.h"

namespace icome::apps {

/// Finds triangles in the frames of a source. Gives the exit code.
int run_tracking(const TrackOptions& options);

}  // namespace icome::apps
