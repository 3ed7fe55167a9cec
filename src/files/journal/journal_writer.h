#pragma once
#include "files/journal/journal_format.h"
#include "io/new_file.h"
#include "world/world.h"

namespace icome::files {

struct JournalSnapshot {
  std::uint64_t bytes = 0;  // with the header
  std::uint64_t records = 0;
};

/// Writes a whole journal that holds a world and no edits. Write errors are reported by
/// NewFile::finish; fails for a world with something that cannot be written.
base::Result<JournalSnapshot> write_snapshot(const world::World& world, io::NewFile& file);

}  // namespace icome::files
