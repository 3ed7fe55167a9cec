#pragma once
#include <filesystem>

#include "files/journal/journal.h"
#include "io/open_file.h"

namespace icome::files {

/// Copies all from the first damage of a journal on to a file beside it, NAME.lost, unless such a copy
/// exists already, and adds that to the report. Does nothing for a whole journal. Fails, with the report
/// unchanged, where the copy cannot be written.
base::Result<void> keep_what_is_lost(const io::OpenFile& journal, JournalReport& report);

}  // namespace icome::files
