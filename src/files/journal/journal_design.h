#pragma once
#include "files/design.h"
#include "io/memory_budget.h"

namespace icome::files {

// A journal (journal.h) as one of the formats of designs: with all kinds of shapes that the project has, read
// without changes, and written as a snapshot.

base::Result<LoadedDesign> read_journal_design(const std::filesystem::path& path,
                                               const DesignReadOptions& options, io::MemoryBudget& memory);
base::Result<std::vector<Remark>> write_journal_design(const std::filesystem::path& path,
                                                       const world::World& world);

}  // namespace icome::files
