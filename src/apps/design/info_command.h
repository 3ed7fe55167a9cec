#pragma once
#include "apps/design/design_options.h"

namespace icome::apps {

/// Runs `icome info`: reads a design and prints what is in it on standard output. Returns the program's exit
/// code: 0; 1 when it could not be read (a sentence on standard error says why); 130 when it was interrupted.
int run_info(const InfoOptions& options);

}  // namespace icome::apps
