#pragma once
#include "files/journal/journal.h"
#include "files/journal/journal_reader.h"
#include "io/memory_budget.h"

namespace icome::files {

/// What is wrong with a journal; of several, the last of this list.
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

/// Makes the world of a journal, of all that is whole before and behind damages. Fails where it takes more
/// memory than there is in the budget (null: any amount), or progress says stop.
base::Result<ReplayedJournal> replay_journal(const io::OpenFile& file, const world::GeometryFactory& factory,
                                             const JournalProgress& progress = {},
                                             io::MemoryBudget* memory = nullptr);

}  // namespace icome::files
