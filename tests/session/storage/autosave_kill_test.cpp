// Programs that are killed at any moment of their work: every edit that was written must be recovered, also
// after crashes right behind a recovery.
#include "base/random.h"
#include "session/autosave_samples.h"
#include "session/storage/autosave_files.h"
#include "session/storage/recovery.h"

namespace icome::session {
namespace {

#if defined(ICOME_ADDRESS_SANITIZER) || defined(ICOME_THREAD_SANITIZER)
constexpr int kKills = 25;
#else
constexpr int kKills = 100;
#endif

/// Recovers what the last victim left and goes on with edits until it is killed; says again and again how
/// many are safe. Saves now and then, which makes a new journal.
[[noreturn]] void work(const std::filesystem::path& folder, int report) {
  EditedQueue queue;
  AutosaveJournal journal(queue.add_reader(), {.folder = folder});
  world::World world;
  std::uint64_t before = 0;  // steps before the first post
  const auto left = find_recoverable_work(folder);
  if (!left.empty()) {
    const auto claimed = ClaimedWork::claim(left.front());
    if (!claimed) ::_exit(3);
    const auto design = (*claimed)->read({});
    if (!design) ::_exit(4);
    before = steps_in(design->world);
    queue.post(opened(design->world, {.recovered = *claimed}));
  } else {
    queue.post(opened({}));
  }
  const auto tell = [&] {
    const std::uint64_t done = journal.followed();
    const std::uint64_t safe = before + (done > 0 ? done - 1 : 0);
    if (::write(report, &safe, sizeof safe) != ssize_t(sizeof safe)) ::_exit(5);
  };
  for (std::uint64_t step = before;; ++step) {
    queue.post(edited(step));
    queue.pump();
    tell();
    // Not further ahead than a person would be.
    wait_until([&] { return journal.followed() + 20 > step - before; });
  }
}

/// Lets a child work for a while, kills it, and gives the most edits that it said were safe.
std::uint64_t work_and_kill(const std::filesystem::path& folder, base::Random& random) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    work(folder, ends[1]);
  }
  ::close(ends[1]);
  std::uint64_t safe = 0;
  const auto hear = [&] { return ::read(ends[0], &safe, sizeof safe) == ssize_t(sizeof safe); };
  for (std::uint64_t wait = random.index(40); wait > 0 && hear();) --wait;
  std::this_thread::sleep_for(std::chrono::microseconds(random.index(3000)));
  ::kill(child, SIGKILL);
  while (hear()) continue;
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself: " << WEXITSTATUS(status);
  return safe;
}

/// What a journal holds whose writer was killed: the kernel may have cut its last write short between two
/// pages of memory, and that one edit, which nobody was told is safe, is then gone. No whole edit is.
world::World world_before_kill(const std::filesystem::path& journal) {
  auto read = files::read_journal(journal, world::GeometryFactory());
  if (!read) throw std::runtime_error(read.error().message);
  EXPECT_EQ(read->report.lost_edits, 0U);
  return read->world;
}

/// The work that a killed program left. Two: it was killed after its own was on disk and before that which it
/// recovered was taken away; nothing is lost then, and a person discards the older.
std::uint64_t steps_left(const std::filesystem::path& folder) {
  const auto left = find_recoverable_work(folder);
  EXPECT_LE(left.size(), 2U);
  std::uint64_t most = 0;
  if (left.size() > 1) (*ClaimedWork::claim(left.back()))->discard();
  for (const RecoverableWork& work : find_recoverable_work(folder)) {
    const auto world = world_before_kill(work.journal);
    const std::uint64_t steps = steps_in(world);
    EXPECT_EQ(hash(world), hash(world_after(steps))) << "edits are missing or out of order";
    most = std::max(most, steps);
  }
  return most;
}

TEST(AutosaveKill, RecoversEveryEditThatWasWritten) {
  const ScratchFolder folder;
  base::Random random(17);
  std::uint64_t steps = 0, twice = 0;
  for (int i = 0; i < kKills; ++i) {
    const std::uint64_t safe = std::max(steps, work_and_kill(folder.path(), random));
    if (testing::Test::HasFailure()) return;
    twice += journals_in(folder.path()).size() > 1 ? 1 : 0;
    steps = steps_left(folder.path());
    ASSERT_GE(steps, safe) << "kill " << i;
  }
  std::printf("%d kills in %llu edits, %llu with two journals\n", kKills,
              static_cast<unsigned long long>(steps), static_cast<unsigned long long>(twice));
  EXPECT_GT(steps, std::uint64_t(kKills));
}

}  // namespace
}  // namespace icome::session
