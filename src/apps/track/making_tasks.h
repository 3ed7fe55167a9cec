#pragma once
#include "apps/track/track_options.h"

namespace icome::apps {

/// Makes frames with their truth. Gives the exit code.
int run_track_synth(const TrackOptions& options);
/// Draws the sheet to print. Gives the exit code.
int run_track_sheet(const TrackOptions& options);
/// Finds how the camera sees the table. Gives the exit code.
int run_track_calibrate(const TrackOptions& options);
/// Measures the colours of table and triangles, and keeps them in the view. Gives the exit code.
int run_track_colours(const TrackOptions& options);
/// Adds a triangle that is shown to the list. Gives the exit code.
int run_track_learn(const TrackOptions& options);

}  // namespace icome::apps
