#include "session/storage/autosave_journal.h"

#include "session/autosave_samples.h"
#include "session/storage/recovery.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;

/// A queue and who keeps its work; goes as a session does.
struct KeptQueue {
  explicit KeptQueue(const AutosaveSettings& settings) { journal.emplace(queue.add_reader(), settings); }
  ~KeptQueue() {
    queue.close();
    journal.reset();
  }
  void settle() {
    queue.pump();
    wait_until([&] {
      queue.pump();
      return journal->followed() == posted;
    });
  }
  void do_steps(std::uint64_t count) {
    for (; count > 0; --count) posted = queue.post(edited(steps++));
  }

  EditedQueue queue;
  std::optional<AutosaveJournal> journal;
  std::uint64_t posted = 0;
  std::uint64_t steps = 0;
};

TEST(AutosaveJournal, KeepsWhatASessionLeavesUnsaved) {
  const ScratchFolder folder;
  {
    KeptQueue kept({.folder = folder.path()});
    kept.do_steps(3000);  // more than a reader's pipe holds
  }
  EXPECT_EQ(hash(world_in(journals_in(folder.path()).at(0))), hash(world_after(3000)));
}

TEST(AutosaveJournal, HasWrittenWhatItSaysItHasFollowed) {
  const ScratchFolder folder;
  KeptQueue kept({.folder = folder.path()});
  for (int i = 0; i < 5; ++i) {
    kept.do_steps(10);
    kept.settle();
    EXPECT_EQ(hash(world_in(journals_in(folder.path()).at(0))), hash(world_after(kept.steps)));
  }
}

TEST(AutosaveJournal, LeavesNothingOfASessionThatWasClosed) {
  const ScratchFolder folder;
  {
    KeptQueue kept({.folder = folder.path()});
    kept.do_steps(10);
    kept.settle();
    kept.do_steps(10);
    kept.journal->close();
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(AutosaveJournal, LeavesNothingOfASessionWithoutEdits) {
  const ScratchFolder folder;
  { KeptQueue kept({.folder = folder.path()}); }
  {
    KeptQueue kept({.folder = folder.path()});
    kept.posted = kept.queue.post(opened(world_after(10), {.design = "/designs/a.wrl"}));
  }
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(AutosaveJournal, TellsOnceWhenWorkIsNotKeptAndOnceWhenItIsAgain) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.write("autosave", "a file in the way");
  KeptQueue kept({.folder = folder, .retry_period = std::chrono::milliseconds(1)});
  kept.do_steps(10);
  kept.settle();
  const auto lost = kept.journal->news();
  ASSERT_TRUE(lost.has_value());
  EXPECT_FALSE(lost->keeping);
  EXPECT_TRUE(lost->text.starts_with("Unsaved work is no longer kept against a crash: ")) << lost->text;
  EXPECT_TRUE(lost->text.ends_with("(File exists). Save your design.")) << lost->text;
  kept.do_steps(10);
  kept.settle();
  EXPECT_FALSE(kept.journal->news().has_value()) << "told twice";
  fs::remove(folder);
  std::optional<AutosaveState> back;
  wait_until([&] { return (back = kept.journal->news()).has_value(); });
  EXPECT_TRUE(back->keeping);
  EXPECT_FALSE(kept.journal->news().has_value());
  EXPECT_EQ(hash(world_in(journals_in(folder).at(0))), hash(world_after(20)));
}

TEST(AutosaveJournal, KeepsSeveralSessionsApart) {
  const ScratchFolder folder;
  {
    KeptQueue one({.folder = folder.path()}), two({.folder = folder.path()});
    one.do_steps(10);
    two.do_steps(20);
    one.settle();
    two.settle();
    EXPECT_EQ(journals_in(folder.path()).size(), 2U);
    EXPECT_TRUE(find_recoverable_work(folder.path()).empty());
    two.journal->close();
  }
  const auto works = find_recoverable_work(folder.path());
  ASSERT_EQ(works.size(), 1U);
  EXPECT_EQ(steps_in(world_in(works[0].journal)), 10U);
}

}  // namespace
}  // namespace icome::session
