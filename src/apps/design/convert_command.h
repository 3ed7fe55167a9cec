#pragma once
#include "apps/design/design_options.h"

namespace icome::apps {

/// Runs `icome convert`: reads a design, writes it in the format that the other name ends in, and reports the
/// losses on the way. Returns the program's exit code, as run_info does; the file that was there stays
/// unless all went well.
int run_convert(const ConvertOptions& options);

}  // namespace icome::apps
