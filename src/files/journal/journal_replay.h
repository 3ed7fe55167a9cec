#pragma once
#include "files/journal/journal.h"
#include "files/journal/journal_reader.h"
#include "io/memory_budget.h"

namespace icome::files {

/// Faults of a journal; of several, the last of this list counts.
enum class JournalFault {
  None,
  Header,      // only its first bytes are damaged
  CutOff,      // it ends within its last edit, as when the program or the machine stopped
  Unfinished,  // it ends within the snapshot
  Damaged,     // bytes changed
  Refused,     // the world does not allow an edit of it
  Unknown,     // an edit or a shape that this program cannot read
};

struct ReplayedJournal {
  world::World world = {};
  JournalReport report = {};
  JournalFault fault = JournalFault::None;
  std::uint64_t records = 0;  // that were replayed
};

/// Makes the world of a journal from all that is whole before and behind damages. Fails where it takes
/// more memory than the budget has (null: unlimited), or progress returns false.
base::Result<ReplayedJournal> replay_journal(const io::OpenFile& file, const world::GeometryFactory& factory,
                                             const JournalProgress& progress = {},
                                             io::MemoryBudget* memory = nullptr);

}  // namespace icome::files
