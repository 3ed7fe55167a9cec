// A database server that is killed at any moment: every edit that was acknowledged must be there, and of the
// others at most those of the append that it was killed in.
#include <cstdio>
#include <thread>

#include "collab/storage/postgres_op_log.h"
#include "collab/storage/sample_log.h"
#include "collab/storage/shared_postgres.h"

namespace icome::collab {
namespace {

/// One who appends, and what it was told.
struct KilledWork {
  PostgresOpLog& log;
  base::Random& random;
  std::uint64_t fence = 0;
  std::uint64_t last = 0;     // acknowledged
  std::size_t appending = 0;  // edits of the append that failed

  /// Appends, and saves snapshots, until that fails.
  void go_on() {
    while (true) {
      appending = 1 + random.index(4);
      const std::size_t size = random.index(20'000);
      const auto problem = append_to(log, "a", last, fence, sample_entries(last, appending, size));
      if (problem) {
        EXPECT_EQ(problem->problem, AppendProblem::Store) << problem->message;
        return;
      }
      last += appending;
      appending = 0;
      if (random.index(20) == 0 &&
          !log.save_snapshot("a", fence, {last, sample_edit(last, 50'000)}, last - 1))
        return;
    }
  }
};

TEST(PostgresKill, LosesNothingThatWasAcknowledged) {
  const std::string why = why_no_postgres();
  if (!why.empty()) GTEST_SKIP() << why;
  PostgresServer server(memory_place());
  PostgresOpLog log = good(PostgresOpLog::open(server.fresh_database()));
  good(log.create("a"));
  base::Random random(17);
  KilledWork work{log, random, good(log.lease("a", "worker", 3'600'000)).fence};
  const int kills = kills_asked_for();
  int more = 0;
  for (int i = 0; i < kills; ++i) {
    const std::chrono::microseconds wait(random.index(40'000));
    std::thread killer([&] {
      std::this_thread::sleep_for(wait);
      server.kill();
    });
    work.go_on();
    killer.join();
    server.start();
    const DesignRow row = good(log.find("a")).value();
    ASSERT_GE(row.sequence, work.last) << "kill " << i;
    ASSERT_LE(row.sequence, work.last + work.appending) << "kill " << i;
    more += row.sequence > work.last ? 1 : 0;
    work.last = row.sequence;
    for (const LogEntry& it : good(log.read_from("a", row.snapshot_sequence, ~std::uint64_t{0})))
      ASSERT_EQ(it.edit, sample_edit(it.sequence, it.edit.size())) << "kill " << i;
  }
  std::printf("%d kills in %llu edits, %d between saving and telling\n", kills,
              static_cast<unsigned long long>(work.last), more);
  EXPECT_GT(work.last, std::uint64_t(kills));
}

}  // namespace
}  // namespace icome::collab
