#include "collab/storage/sqlite_op_log.h"

#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "collab/storage/sample_log.h"
#include "collab/storage/store_care.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

class SqliteOpLogTest : public testing::Test {
 protected:
  files::ScratchFolder folder_{memory_place()};
  std::filesystem::path path_ = folder_.path() / "designs.sqlite";

  SqliteOpLog opened() const { return good(SqliteOpLog::open(path_)); }
  std::string opening_sentence() const { return sentence_of(SqliteOpLog::open(path_)); }
};

/// Changes a database as no program of ours would.
void meddle(const std::filesystem::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
}

/// Runs `work` in another process; gives its exit code.
template <typename Work>
int in_another_process(Work&& work) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(work());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(SqliteOpLogTest, KeepsAllWhenItIsClosed) {
  std::uint64_t fence = 0, history = 0;
  {
    SqliteOpLog log = opened();
    good(log.create("a"));
    fence = good(log.lease("a", "server", 60'000)).fence;
    good(log.author("a", "key", "Ann"));
    ASSERT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, 5)));
    good(log.revoke("gone"));
    history = good(log.find("a")).value().history;
  }
  SqliteOpLog log = opened();
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 5));
  EXPECT_EQ(good(log.find("a")).value().history, history);
  EXPECT_EQ(good(log.lease("a", "server", 60'000)).fence, fence);
  EXPECT_EQ(good(log.author("a", "key", "Ann")).author, 1U);
  EXPECT_EQ(good(log.revoked()), std::vector<std::string>{"gone"});
  EXPECT_TRUE(good(check_store(path_)).empty());
}

TEST_F(SqliteOpLogTest, SeesWhatOtherProcessesDo) {
  SqliteOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  const std::uint64_t version = good(log.revoked_version());
  EXPECT_EQ(in_another_process([&] {
              SqliteOpLog other = opened();
              good(other.revoke("gone"));
              return append_to(other, "a", 0, fence, sample_entries(0, 2)) ? 1 : 0;
            }),
            0);
  EXPECT_NE(good(log.revoked_version()), version);
  EXPECT_EQ(good(log.revoked()), std::vector<std::string>{"gone"});
  EXPECT_EQ(append_to(log, "a", 0, fence, sample_entries(0, 1)).value().problem,
            AppendProblem::WrongSequence);
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 2));
}

TEST_F(SqliteOpLogTest, CanBeMadeBySeveralProcessesAtOnce) {
  constexpr int kProcesses = 8;
  std::vector<pid_t> children;
  for (int i = 0; i < kProcesses; ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      auto log = SqliteOpLog::open(path_);
      ::_exit(log && log->create("design " + std::to_string(i)) ? 0 : 1);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  SqliteOpLog log = opened();
  EXPECT_EQ(good(log.designs()).size(), std::size_t(kProcesses));
}

TEST_F(SqliteOpLogTest, CanBeReadByItsOwnerOnly) {
  const SqliteOpLog log = opened();
  for (const char* ending : {"", "-wal", "-shm"}) {
    const auto file = path_.string() + ending;
    EXPECT_EQ(std::filesystem::status(file).permissions(), std::filesystem::perms(0600)) << file;
  }
}

TEST_F(SqliteOpLogTest, RefusesANewerVersion) {
  (void)opened();
  meddle(path_, "PRAGMA user_version = 4");
  EXPECT_EQ(opening_sentence(), path_.string() +
                                    ": was written by a newer version of icome (store version 4, this "
                                    "one knows 3). Use that version.");
}

TEST_F(SqliteOpLogTest, RefusesOtherProgramsDatabases) {
  meddle(path_, "CREATE TABLE bookmarks (name TEXT)");
  const std::string before = bytes_in(path_);
  EXPECT_EQ(opening_sentence(),
            path_.string() + ": is the database of another program. Choose another file or folder.");
  EXPECT_EQ(bytes_in(path_), before);
}

TEST_F(SqliteOpLogTest, RefusesWhatIsNoDatabase) {
  folder_.write("designs.sqlite", std::string(5000, 'x'));
  EXPECT_EQ(opening_sentence(),
            path_.string() + ": is not a store of designs. Choose another file or folder.");
  EXPECT_EQ(bytes_in(path_), std::string(5000, 'x'));
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_NE(opening_sentence().find(path_.string() + ": cannot be opened"), std::string::npos);
}

TEST_F(SqliteOpLogTest, SaysWhatCannotBeWritten) {
  { good(opened().create("a")); }
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0555));
  std::filesystem::permissions(path_, std::filesystem::perms(0444));
  // The administrator may write everywhere, so the test is done by nobody.
  const int code = in_another_process([&] {
    constexpr uid_t kNobody = 65534;
    if (::geteuid() == 0 && ::setuid(kNobody) != 0) return 3;
    auto log = SqliteOpLog::open(path_);
    if (log) return log->create("b") ? 1 : 0;
    return log.error().message.find(": cannot be ") == std::string::npos ? 2 : 0;
  });
  EXPECT_EQ(code, 0);
  std::filesystem::permissions(folder_.path(), std::filesystem::perms(0755));
}

TEST_F(SqliteOpLogTest, SaysThatTheDiskIsFullAndLosesNothing) {
  SqliteOpLog log = opened();
  good(log.create("a"));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  ASSERT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, 2)));
  // A limit on the size of files stands for the full disk, and holds for this process for ever: another one
  // has it.
  const int code = in_another_process([&] {
    const rlimit limit{100'000, 100'000};
    std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &limit);
    SqliteOpLog other = opened();
    const std::vector<Append> batches{{"a", 2, fence, sample_entries(2, 1, 200'000)},
                                      {"none", 0, fence, sample_entries(0, 1)}};
    const auto results = other.append(batches);
    if (!results[0] || results[0]->problem != AppendProblem::Store) return 1;
    if (!results[1]) return 2;
    return append_to(other, "a", 2, fence, sample_entries(2, 1)) ? 3 : 0;
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(good(log.read_from("a", 0, 1000)), sample_entries(0, 3));
  EXPECT_TRUE(good(check_store(path_)).empty());
}

TEST_F(SqliteOpLogTest, WaitsForNobodyForEver) {
  SqliteOpLog log = opened();
  good(log.create("a"));
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(path_.c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_EQ(append_to(log, "a", 0, 1, {}).value().message,
            path_.string() +
                ": another program keeps it locked. End that program, or wait for it, then try again.");
  EXPECT_EQ(good(opened().designs()).size(), 1U) << "to open and to read, nothing is locked";
  sqlite3_exec(other, "ROLLBACK", nullptr, nullptr, nullptr);
  sqlite3_close(other);
  EXPECT_TRUE(log.create("b"));
}

}  // namespace
}  // namespace icome::collab
