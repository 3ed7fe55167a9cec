#pragma once
#include "apps/design/design_options.h"

namespace icome::apps {

/// Runs `icome edit`: performs a file of operations on a design, one a line, and writes the result. A
/// wrong line is reported with its number, and then nothing is written. Returns the program's exit code, as
/// run_convert does.
int run_edit(const EditOptions& options);

}  // namespace icome::apps
