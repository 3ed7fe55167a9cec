#pragma once
#include <filesystem>

#include "files/journal/journal.h"
#include "io/open_file.h"

namespace icome::files {

/// Copies all from the first damage of a journal on to a file beside it, NAME.lost, unless such a copy is
/// there already, and tells that in the report. Nothing to do for a journal that is whole. Fails, telling
/// nothing, where the copy cannot be written.
base::Result<void> keep_what_is_lost(const io::OpenFile& journal, JournalReport& report);

}  // namespace icome::files
