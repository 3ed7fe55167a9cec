#include "session/storage/autosave_keeper.h"

#include <sched.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include "session/autosave_samples.h"
#include "session/storage/autosave_files.h"

namespace icome::session {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// A keeper whose clock stands, and who posts for it.
class KeptWork {
 public:
  explicit KeptWork(const fs::path& folder) : keeper({.folder = folder}) {}

  std::uint64_t post(Edited edited) {
    edited.number = ++posted;
    keeper.follow(edited, now);
    return posted;
  }
  void do_steps(std::uint64_t count) {
    for (; count > 0; --count) post(edited(steps++));
  }
  void let_pass(std::chrono::nanoseconds time) {
    now += time;
    keeper.tend(now);
  }

  AutosaveKeeper::Time now = {};
  std::uint64_t posted = 0;
  std::uint64_t steps = 0;
  AutosaveKeeper keeper;
};

/// A file system with little room, while it lives; only for a process of its own with the rights.
bool mount_little(const fs::path& folder) {
  return ::unshare(CLONE_NEWNS) == 0 && ::mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
         ::mount("tmpfs", folder.c_str(), "tmpfs", 0, "size=32k") == 0;
}

TEST(AutosaveKeeper, KeepsNothingWhileNothingIsUnsaved) {
  const ScratchFolder folder;
  KeptWork work(folder.path() / "autosave");
  work.post(opened(world_after(3), {.design = "/designs/a.wrl"}));
  work.post({.shown = world::SceneId{}});
  work.let_pass(1h);
  EXPECT_FALSE(work.keeper.due().has_value());
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(AutosaveKeeper, HasEveryEditOnDiskWhenItReturns) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.post(opened(world_after(3), {.design = "/designs/a.wrl"}));
  work.steps = 3;
  for (int i = 0; i < 20; ++i) {
    work.do_steps(1);
    const auto journals = journals_in(folder.path());
    ASSERT_EQ(journals.size(), 1U);
    EXPECT_EQ(hash(world_in(journals[0])), hash(world_after(work.steps)));
    EXPECT_EQ(read_design_of(journals[0]), "/designs/a.wrl");
  }
}

TEST(AutosaveKeeper, SyncsOnceForManyEdits) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.do_steps(1);  // a fresh journal is on the disk
  EXPECT_EQ(work.keeper.due(), work.now + 5s) << "only a look whether it is still there";
  work.do_steps(5);
  EXPECT_EQ(work.keeper.due(), work.now + 1s);
  work.let_pass(400ms);
  work.do_steps(5);
  EXPECT_EQ(work.keeper.due(), work.now + 600ms);
  work.let_pass(600ms);
  EXPECT_EQ(work.keeper.due(), work.now + 4s);
  EXPECT_FALSE(work.keeper.problem().has_value());
}

TEST(AutosaveKeeper, SavedWorkIsNotKept) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.do_steps(5);
  work.post(saved("/designs/a.wrl", work.posted));
  EXPECT_TRUE(names_in(folder.path()).empty());
  work.do_steps(1);
  ASSERT_EQ(journals_in(folder.path()).size(), 1U);
  EXPECT_EQ(hash(world_in(journals_in(folder.path())[0])), hash(world_after(6)));
  EXPECT_EQ(read_design_of(journals_in(folder.path())[0]), "/designs/a.wrl");
}

TEST(AutosaveKeeper, EditsBehindASaveStayKept) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.do_steps(5);
  const std::uint64_t in_file = work.posted;
  work.do_steps(2);
  work.post(saved("/designs/a.wrl", in_file));
  ASSERT_EQ(journals_in(folder.path()).size(), 1U);
  EXPECT_EQ(hash(world_in(journals_in(folder.path())[0])), hash(world_after(7)));
  EXPECT_EQ(read_design_of(journals_in(folder.path())[0]), "/designs/a.wrl");
  work.post({.shown = world::SceneId{}});  // no edit
  work.post(saved("/designs/a.wrl", work.posted - 1));
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(AutosaveKeeper, AnotherWorldStartsAnew) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.do_steps(5);
  const std::uint64_t of_the_last = work.posted;
  work.post(opened({}));
  EXPECT_TRUE(names_in(folder.path()).empty());
  work.steps = 0;
  work.do_steps(2);
  work.post(saved("/designs/last.wrl", of_the_last));  // ended late, and is no business of this world
  ASSERT_EQ(journals_in(folder.path()).size(), 1U);
  EXPECT_EQ(hash(world_in(journals_in(folder.path())[0])), hash(world_after(2)));
  EXPECT_EQ(read_design_of(journals_in(folder.path())[0]), fs::path());
}

TEST(AutosaveKeeper, RecoveredWorkIsAlwaysSomewhere) {
  const ScratchFolder folder;
  {
    KeptWork crashed(folder.path());
    crashed.post(opened({}, {.design = "/designs/a.wrl"}));
    crashed.do_steps(9);
  }
  const auto old = journals_in(folder.path()).at(0);
  const auto claimed = *ClaimedWork::claim(find_recoverable_work(folder.path()).at(0));
  const auto design = claimed->read({});
  KeptWork work(folder.path());
  work.post(opened(design->world, {.design = claimed->work().design, .recovered = claimed}));
  ASSERT_EQ(journals_in(folder.path()).size(), 1U);
  const auto now = journals_in(folder.path())[0];
  EXPECT_NE(now, old);
  EXPECT_EQ(hash(world_in(now)), hash(world_after(9)));
  EXPECT_EQ(read_design_of(now), "/designs/a.wrl");
  EXPECT_EQ(names_in(folder.path()).size(), 2U);
}

TEST(AutosaveKeeper, RecoveredWorkThatCannotBeKeptAnewStays) {
  const ScratchFolder folder, other;
  {
    KeptWork crashed(folder.path());
    crashed.do_steps(9);
  }
  const fs::path blocked = other.write("file", "");
  KeptWork work(blocked / "autosave");
  {
    auto claimed = *ClaimedWork::claim(find_recoverable_work(folder.path()).at(0));
    const auto design = claimed->read({});
    work.post(opened(design->world, {.recovered = std::move(claimed)}));
  }
  EXPECT_TRUE(work.keeper.problem().has_value());
  EXPECT_EQ(hash(world_in(journals_in(folder.path()).at(0))), hash(world_after(9)));
  EXPECT_TRUE(find_recoverable_work(folder.path()).empty()) << "somebody works on it";
  fs::remove(blocked);
  work.steps = 9;
  work.do_steps(1);
  work.let_pass(1h);
  EXPECT_FALSE(work.keeper.problem().has_value());
  EXPECT_TRUE(names_in(folder.path()).empty());
  EXPECT_EQ(hash(world_in(journals_in(blocked / "autosave").at(0))), hash(world_after(10)));
}

TEST(AutosaveKeeper, SavingRecoveredWorkEndsIt) {
  const ScratchFolder folder, other;
  {
    KeptWork crashed(folder.path());
    crashed.do_steps(9);
  }
  KeptWork work(other.write("file", "") / "autosave");
  auto claimed = *ClaimedWork::claim(find_recoverable_work(folder.path()).at(0));
  work.post(opened(claimed->read({})->world, {.recovered = claimed}));
  work.post(saved("/designs/b.wrl", work.posted));
  EXPECT_TRUE(names_in(folder.path()).empty());
}

TEST(AutosaveKeeper, MakesTheFolderAgainThatWasDeleted) {
  const ScratchFolder scratch;
  const fs::path folder = scratch.path() / "autosave";
  KeptWork work(folder);
  work.do_steps(3);
  const auto expect_kept = [&] {
    ASSERT_EQ(journals_in(folder).size(), 1U);
    EXPECT_EQ(hash(world_in(journals_in(folder)[0])), hash(world_after(work.steps)));
    EXPECT_FALSE(work.keeper.problem().has_value());
  };
  fs::remove_all(folder);
  work.let_pass(5s);
  expect_kept();  // even though nothing was edited
  fs::remove_all(folder);
  work.do_steps(3);
  work.let_pass(1s);
  expect_kept();
}

TEST(AutosaveKeeper, TriesAgainLessAndLessOften) {
  const ScratchFolder scratch;
  const fs::path blocked = scratch.write("file", "");
  KeptWork work(blocked);
  work.do_steps(1);
  ASSERT_TRUE(work.keeper.problem().has_value());
  EXPECT_NE(work.keeper.problem()->message.find("file: this folder cannot be made"), std::string::npos)
      << work.keeper.problem()->message;
  std::vector<std::int64_t> waits;
  for (int i = 0; i < 8; ++i) {
    const auto wait = *work.keeper.due() - work.now;
    waits.push_back(std::chrono::duration_cast<std::chrono::seconds>(wait).count());
    work.do_steps(1);
    work.let_pass(wait);
  }
  EXPECT_EQ(waits, (std::vector<std::int64_t>{5, 10, 20, 40, 80, 80, 80, 80}));
  fs::remove(blocked);
  work.let_pass(80s);
  EXPECT_FALSE(work.keeper.problem().has_value());
  EXPECT_EQ(hash(world_in(journals_in(blocked).at(0))), hash(world_after(work.steps)));
}

TEST(AutosaveKeeper, GoesOnWhenTheDiskIsFullAndWhenItIsNotAnyMore) {
  const ScratchFolder folder;
  EXPECT_TRUE(in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = {};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    KeptWork work(folder.path());
    work.do_steps(30);
    limit.rlim_cur = 64;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto kept = [&] { return steps_in(world_in(journals_in(folder.path()).at(0))); };
    work.do_steps(1);
    if (!holds(work.keeper.problem().has_value(), "the disk is full")) return false;
    if (!holds(kept() == work.steps - 1, "what was there before stays")) return false;
    if (!holds(work.keeper.problem()->message.find("too large") != std::string::npos, "the reason is told"))
      return false;
    work.do_steps(3);
    if (!holds(kept() == work.steps - 4, "nothing is kept behind a gap")) return false;
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    work.let_pass(1h);
    work.do_steps(2);
    return holds(!work.keeper.problem(), "it is kept again") &&
           holds(hash(world_in(journals_in(folder.path()).at(0))) == hash(world_after(work.steps)),
                 "all of it");
  }));
}

TEST(AutosaveKeeper, SavingEndsTheWaitForAnotherTry) {
  const ScratchFolder folder;
  const fs::path blocked = folder.write("file", "");
  KeptWork work(blocked);
  work.do_steps(2);
  EXPECT_TRUE(work.keeper.problem().has_value());
  work.post(saved("/designs/a.wrl", work.posted));
  EXPECT_FALSE(work.keeper.problem().has_value()) << "there is nothing to keep";
  work.do_steps(1);
  EXPECT_TRUE(work.keeper.problem().has_value()) << "it was tried at once";
  work.post(saved("/designs/a.wrl", work.posted));
  fs::remove(blocked);
  work.do_steps(1);
  EXPECT_FALSE(work.keeper.problem().has_value());
  EXPECT_EQ(hash(world_in(journals_in(blocked).at(0))), hash(world_after(work.steps)));
}

TEST(AutosaveKeeper, LeavesNothingBehindOnADiskThatIsFullFromTheStart) {
  const ScratchFolder folder;
  EXPECT_TRUE(in_child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = {};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = 0;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    KeptWork work(folder.path());
    for (int i = 0; i < 5; ++i) {
      work.do_steps(1);
      work.let_pass(1h);
    }
    if (!holds(work.keeper.problem().has_value(), "the disk is full")) return false;
    if (!holds(names_in(folder.path()).empty(), "no empty journals")) return false;
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    work.let_pass(1h);
    return holds(!work.keeper.problem(), "it is kept now") &&
           holds(hash(world_in(journals_in(folder.path()).at(0))) == hash(world_after(work.steps)),
                 "all of it");
  }));
}

TEST(AutosaveKeeper, GoesOnWhereADiskHasNoRoom) {
  const ScratchFolder folder;
  if (!in_child([&] { return mount_little(folder.path()); }))
    GTEST_SKIP() << "a small disk can only be made with the rights to mount one";
  EXPECT_TRUE(in_child([&] {
    mount_little(folder.path());
    KeptWork work(folder.path());
    work.do_steps(10);
    std::ofstream rest(folder.path() / "rest", std::ios::binary);
    while (rest.put('x').flush()) continue;
    while (!work.keeper.problem() && work.steps < 1000) work.do_steps(1);
    const std::uint64_t last = steps_in(world_in(journals_in(folder.path()).at(0)));
    if (!holds(last == work.steps - 1, "what was there before stays")) return false;
    if (!holds(work.keeper.problem()->message.find("No space left") != std::string::npos,
               work.keeper.problem()->message))
      return false;
    fs::remove(folder.path() / "rest");
    rest.close();
    work.let_pass(1h);
    return holds(!work.keeper.problem(), "it is kept again") &&
           holds(hash(world_in(journals_in(folder.path()).at(0))) == hash(world_after(work.steps)),
                 "all of it");
  }));
}

TEST(AutosaveKeeper, GivesUpAWorldThatItDoesNotKnowAnyMore) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.do_steps(3);
  work.post(edited(0));  // once more, which cannot be
  work.post(edited(3));
  ASSERT_TRUE(work.keeper.problem().has_value());
  EXPECT_NE(work.keeper.problem()->message.find("could not be repeated"), std::string::npos);
  EXPECT_EQ(steps_in(world_in(journals_in(folder.path()).at(0))), 3U);
  work.let_pass(1h);
  EXPECT_TRUE(work.keeper.problem().has_value());
  work.post(saved("/designs/a.wrl", work.posted));
  EXPECT_TRUE(work.keeper.problem().has_value()) << "saving does not bring back what the next edits build on";
  work.post(opened(world_after(5)));
  EXPECT_FALSE(work.keeper.problem().has_value());
  work.steps = 5;
  work.do_steps(1);
  work.let_pass(1h);
  EXPECT_FALSE(work.keeper.problem().has_value());
  EXPECT_EQ(hash(world_in(journals_in(folder.path()).at(0))), hash(world_after(6)));
}

TEST(AutosaveKeeper, DiscardsWhatIsNotWanted) {
  const ScratchFolder folder;
  KeptWork work(folder.path());
  work.do_steps(3);
  work.keeper.discard();
  EXPECT_TRUE(names_in(folder.path()).empty());
}

}  // namespace
}  // namespace icome::session
