// Edits at random, undone to the start, redone to the end and replayed from the journal.
#include "files/sample_journals.h"
#include "world/edit/history.h"

namespace icome::files {
namespace {

#ifdef ICOME_ADDRESS_SANITIZER
constexpr std::uint64_t kSequences = 300;
#else
constexpr std::uint64_t kSequences = 10000;
#endif
constexpr int kEdits = 25;

TEST(JournalSequences, EndWhereTheyEndedHoweverTheyAreRepeated) {
  const ScratchFolder folder(memory_folder());
  const auto empty = folder.path() / "empty.icome", path = folder.path() / "design.icome";
  ASSERT_TRUE(write_journal(empty, world::World()));
  const std::string empty_journal = content_of(empty);
  const std::uint64_t first = hash(world::World());
  for (std::uint64_t seed = 0; seed < kSequences; ++seed) {
    write_fresh(folder, "design.icome", empty_journal);
    std::uint64_t last = 0;
    {
      JournaledWorld journal = opened(path);
      world::RandomEdits edits(seed);
      world::History history;
      for (int i = 0; i < kEdits; ++i)
        (void)history.perform(journal.sink(), edits.next(journal.world()), "edit");
      last = hash(journal.world());
      while (history.can_undo()) ASSERT_TRUE(history.undo(journal.sink())) << seed;
      ASSERT_EQ(hash(journal.world()), first) << seed;
      while (history.can_redo()) ASSERT_TRUE(history.redo(journal.sink())) << seed;
      ASSERT_EQ(hash(journal.world()), last) << seed;
    }
    const ReadJournal back = read(path);
    ASSERT_EQ(hash(back.world), last) << seed;
    ASSERT_TRUE(back.report.damage.empty()) << seed;
  }
}

}  // namespace
}  // namespace icome::files
