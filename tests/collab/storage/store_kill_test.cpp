// Programs that are killed at any moment of their work on a store: every edit that they were told was saved
// must be there, and of the others at most those of the append that they were at.
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <thread>

#include "collab/storage/sample_log.h"
#include "collab/storage/store_care.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

constexpr std::size_t kMostAppended = 4;  // edits in one batch

/// Appends and saves snapshots until it is killed, and tells each sequence that is acknowledged.
[[noreturn]] void work_on_store(const std::filesystem::path& path, int report, std::uint64_t seed) {
  base::Random random(seed);
  auto log = SqliteOpLog::open(path);
  if (!log) ::_exit(1);
  const auto lease = log->lease("a", "worker", 1000);
  const auto row = log->find("a");
  if (!lease || !row) ::_exit(2);
  std::uint64_t last = row->value().sequence;
  while (true) {
    const std::size_t count = 1 + random.index(kMostAppended), size = random.index(20'000);
    if (append_to(*log, "a", last, lease->fence, sample_entries(last, count, size))) ::_exit(3);
    last += count;
    if (::write(report, &last, sizeof last) != ssize_t(sizeof last)) ::_exit(4);
    if (random.index(20) == 0 &&
        !log->save_snapshot("a", lease->fence, {last, sample_edit(last, 50'000)}, last - 1))
      ::_exit(5);
  }
}

/// Lets a process work for a random time, kills it, and gives the last sequence that it told; 0 if none.
std::uint64_t work_on_store_and_kill(const std::filesystem::path& path, base::Random& random) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error("no pipe");
  const std::uint64_t seed = random.bits();
  const pid_t child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    work_on_store(path, ends[1], seed);
  }
  ::close(ends[1]);
  std::uint64_t last = 0, told = 0;
  const auto hear = [&] {
    const bool heard = ::read(ends[0], &told, sizeof told) == ssize_t(sizeof told);
    if (heard) last = told;
    return heard;
  };
  for (std::uint64_t wait = random.index(40); wait > 0 && hear();) --wait;
  std::this_thread::sleep_for(std::chrono::microseconds(random.index(3000)));
  ::kill(child, SIGKILL);
  while (hear()) continue;
  ::close(ends[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status)) << "the child ended by itself, " << WEXITSTATUS(status);
  return last;
}

TEST(StoreKill, LosesNothingThatWasAcknowledged) {
  const files::ScratchFolder folder(memory_place());
  const auto path = folder.path() / "designs.sqlite";
  good(good(SqliteOpLog::open(path)).create("a"));
  base::Random random(17);
  const int kills = kills_asked_for();
  std::uint64_t last = 0;
  int more = 0;
  for (int i = 0; i < kills; ++i) {
    const std::uint64_t told = std::max(last, work_on_store_and_kill(path, random));
    SqliteOpLog log = good(SqliteOpLog::open(path));
    const DesignRow row = good(log.find("a")).value();
    last = row.sequence;
    ASSERT_GE(last, told) << "kill " << i;
    ASSERT_LE(last, told + kMostAppended) << "kill " << i;
    more += last > told ? 1 : 0;
    ASSERT_EQ(good(check_store(path)), std::vector<std::string>{}) << "kill " << i;
    for (const LogEntry& it : good(log.read_from("a", row.snapshot_sequence, ~std::uint64_t{0})))
      ASSERT_EQ(it.edit, sample_edit(it.sequence, it.edit.size())) << "kill " << i;
  }
  std::printf("%d kills in %llu edits, %d between saving and telling\n", kills,
              static_cast<unsigned long long>(last), more);
  EXPECT_GT(last, std::uint64_t(kills));
}

}  // namespace
}  // namespace icome::collab
