#pragma once
#include "apps/csg/csg_options.h"

namespace icome::apps {

/// Runs `icome csg` with options that check() accepted: reads, brings to the form, judges points, meshes,
/// reports. The report, or the answers of --inside, go to standard output, all else to standard error.
/// Returns the program's exit code: 0; 1 when something could not be done (a sentence says what); 130 when it
/// was interrupted.
int run_csg(const CsgOptions& options);

}  // namespace icome::apps
