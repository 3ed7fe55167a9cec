#include "collab/storage/store_care.h"

#include <sqlite3.h>
#include <sys/stat.h>

#include "collab/server/room.h"
#include "collab/storage/sample_log.h"
#include "files/sample_files.h"
#include "memory_place.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

/// A store with two designs: "a" of `edits` edits and a snapshot, and "b" without any.
class StoreCareTest : public testing::Test {
 protected:
  files::ScratchFolder folder_{memory_place()};
  fs::path path_ = folder_.path() / "designs.sqlite";
  fs::path backup_ = folder_.path() / "backup.sqlite";

  void make(std::size_t edits = 50) const {
    SqliteOpLog log = good(SqliteOpLog::open(path_));
    for (const char* name : {"a", "b"}) good(log.create(name));
    good(log.author("a", "key", "Ann"));
    const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
    ASSERT_FALSE(append_to(log, "a", 0, fence, sample_entries(0, edits, 300)));
    good(log.save_snapshot("a", fence, {10, "a world"}, 5));
  }
  void change(const std::string& sql) const {
    sqlite3* database = nullptr;
    ASSERT_EQ(sqlite3_open(path_.c_str(), &database), SQLITE_OK);
    EXPECT_EQ(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sqlite3_errmsg(database);
    sqlite3_close(database);
  }
  /// Overwrites a page, counted from 1.
  void spoil(int page) const {
    std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp((page - 1) * 4096);
    file << std::string(2000, '\x5a');
  }
  std::size_t files() const { return std::size_t(std::distance(fs::directory_iterator(folder_.path()), {})); }
};

TEST_F(StoreCareTest, FindsNothingWhereAllIsWell) {
  make();
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{});
  SqliteOpLog serving = good(SqliteOpLog::open(path_));
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{}) << "also while somebody serves";
  EXPECT_FALSE(check_store(folder_.path() / "missing"));
  EXPECT_FALSE(fs::exists(folder_.path() / "missing"));
}

/// A fault that is planted, and what must be said of it.
struct PlantedFault {
  const char* sql;
  const char* finding;
};

class PlantedFaultTest : public StoreCareTest, public testing::WithParamInterface<PlantedFault> {};

TEST_P(PlantedFaultTest, IsFound) {
  make();
  change(GetParam().sql);
  const auto findings = good(check_store(path_));
  EXPECT_NE(std::find(findings.begin(), findings.end(), GetParam().finding), findings.end())
      << testing::PrintToString(findings);
}

INSTANTIATE_TEST_SUITE_P(
    All, PlantedFaultTest,
    testing::Values(PlantedFault{"DELETE FROM edits WHERE sequence = 20",
                                 "a: edits are missing or too many; 44 are there."},
                    PlantedFault{"DELETE FROM edits WHERE sequence = 50",
                                 "a: edits are missing or too many; 44 are there."},
                    PlantedFault{"DELETE FROM edits WHERE sequence = 6",
                                 "a: edits are missing or too many; 44 are there."},
                    PlantedFault{"UPDATE edits SET sequence = 60 WHERE sequence = 30",
                                 "a: edits are missing or too many; 45 are there."},
                    PlantedFault{"UPDATE edits SET design = 2 WHERE sequence = 6",
                                 "b: edits are missing or too many; 1 are there."},
                    PlantedFault{"UPDATE designs SET sequence = 51 WHERE id = 1",
                                 "a: edits are missing or too many; 45 are there."},
                    PlantedFault{"UPDATE designs SET kept_after = 20 WHERE id = 1",
                                 "a: the edits up to 20 are gone, and no snapshot stands for them."},
                    PlantedFault{"DELETE FROM snapshots", "a: the snapshot of 10 is not there."},
                    PlantedFault{"UPDATE snapshots SET sequence = 9", "a: the snapshot of 10 is not there."},
                    PlantedFault{"UPDATE edits SET edit = x'00' WHERE sequence = 11",
                                 "a: has another size than the 12007 bytes that were counted."},
                    PlantedFault{"UPDATE edits SET at = at + 1 WHERE sequence = 11",
                                 "a: the edit 11 is not what was written: the store is damaged. Restore a "
                                 "backup."},
                    PlantedFault{"UPDATE edits SET edit = zeroblob(300)", "25 more are damaged."},
                    PlantedFault{
                        "UPDATE snapshots SET bytes = CAST('a w0rld' AS BLOB)",
                        "a: the snapshot of 10 is not what was written: the store is damaged. Restore "
                        "a backup."},
                    PlantedFault{"UPDATE authors SET last_number = 49",
                                 "a: an edit of author 1 is newer than what was noted for that author."},
                    PlantedFault{"DROP TABLE revoked", "The table \"revoked\" is missing."},
                    PlantedFault{"CREATE TRIGGER t AFTER INSERT ON edits BEGIN DELETE FROM edits; END",
                                 "1 triggers or views are there that icome has not made."},
                    PlantedFault{"INSERT INTO edits VALUES (7, 1, 1, 1, 1, x'00', NULL)",
                                 "1 rows belong to no design."}));

TEST_F(StoreCareTest, FindsEveryPageThatIsOverwritten) {
  make(200);
  const std::string whole = bytes_in(path_);
  const int pages = int(whole.size() / 4096);
  ASSERT_GT(pages, 15);
  for (int page = 1; page <= pages; ++page) {
    spoil(page);
    const auto findings = check_store(path_);
    EXPECT_TRUE(!findings || !findings->empty()) << "page " << page;
    folder_.write("designs.sqlite", whole);
  }
}

TEST_F(StoreCareTest, FindsEveryBitThatTurnsOverInAnEdit) {
  make();
  const std::string whole = bytes_in(path_);
  const std::string edit = sample_edit(30, 300);
  const std::size_t place = whole.find(edit);
  ASSERT_NE(place, std::string::npos);
  for (std::size_t bit = 0; bit < 8 * edit.size(); bit += 7) {
    std::string wrong = whole;
    wrong[place + bit / 8] = char(wrong[place + bit / 8] ^ (1 << (bit % 8)));
    folder_.write("designs.sqlite", wrong);
    EXPECT_EQ(good(check_store(path_)).size(), 1U) << "bit " << bit;
  }
  SqliteOpLog log = good(SqliteOpLog::open(path_));
  EXPECT_EQ(sentence_of(log.read_from("a", 5, 100'000)),
            "a: the edit 30 is not what was written: the store is damaged. Restore a backup.");
}

TEST_F(StoreCareTest, DamageBeforeASnapshotKeepsNobodyFromTheDesign) {
  make();
  change("UPDATE edits SET at = at + 1 WHERE sequence = 7");
  SqliteOpLog log = good(SqliteOpLog::open(path_));
  const RoomStart start = good(read_start(log, good(log.find("a")).value(), 1));
  EXPECT_EQ(start.entries, sample_entries(10, 40, 300));
  change("UPDATE edits SET at = at + 1 WHERE sequence = 11");
  EXPECT_EQ(sentence_of(read_start(log, good(log.find("a")).value(), 1)),
            "a: the edit 11 is not what was written: the store is damaged. Restore a backup.");
}

TEST_F(StoreCareTest, NoDesignIsReadOfWhichEditsAreMissingAtEitherEnd) {
  make();
  SqliteOpLog log = good(SqliteOpLog::open(path_));
  const auto start = [&] { return read_start(log, good(log.find("a")).value(), 1); };
  change("DELETE FROM edits WHERE sequence = 6");
  EXPECT_EQ(good(start()).entries, sample_entries(10, 40, 300)) << "the snapshot stands for it";
  change("DELETE FROM edits WHERE sequence > 40");
  EXPECT_EQ(sentence_of(start()), "a: edit 41 is missing in the store, which icome store check looks into.");
  change("DELETE FROM edits WHERE sequence > 30");
  change("UPDATE designs SET sequence = 30 WHERE id = 1; DELETE FROM edits WHERE sequence BETWEEN 11 AND 12");
  EXPECT_EQ(sentence_of(start()), "a: edit 11 is missing in the store, which icome store check looks into.");
}

TEST_F(StoreCareTest, TakesAStoreFromBeforeThereWereSums) {
  make();
  change(
      "ALTER TABLE edits DROP COLUMN sum; ALTER TABLE snapshots DROP COLUMN sum; "
      "ALTER TABLE authors DROP COLUMN name; PRAGMA user_version = 1");
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{});
  good(backup_store(path_, backup_, false));
  good(restore_store(backup_, path_));
  SqliteOpLog log = good(SqliteOpLog::open(path_));
  EXPECT_EQ(good(log.read_from("a", 5, 100'000)), sample_entries(5, 45, 300));
  EXPECT_EQ(good(log.snapshot("a")).value().bytes, "a world");
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  ASSERT_FALSE(append_to(log, "a", 50, fence, sample_entries(50, 1, 300)));
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{});
  change("UPDATE edits SET at = at + 1 WHERE sequence > 49");
  EXPECT_EQ(good(check_store(path_)).size(), 1U) << "only what came later has a sum";
}

TEST_F(StoreCareTest, TakesAStoreInWhichLongEditsLayOnTheWayToOthers) {
  make();
  change(
      "ALTER TABLE edits RENAME TO later; CREATE TABLE edits (design INTEGER NOT NULL REFERENCES designs "
      "(id), "
      "sequence INTEGER NOT NULL, author INTEGER NOT NULL, number INTEGER NOT NULL, at INTEGER NOT NULL, "
      "edit "
      "BLOB NOT NULL, sum INTEGER, PRIMARY KEY (design, sequence)) STRICT, WITHOUT ROWID; INSERT INTO edits "
      "SELECT * FROM later; DROP TABLE later; PRAGMA user_version = 2");
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{});
  SqliteOpLog log = good(SqliteOpLog::open(path_));
  EXPECT_EQ(good(log.read_from("a", 5, 100'000)), sample_entries(5, 45, 300));
  const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
  ASSERT_FALSE(append_to(log, "a", 50, fence, sample_entries(50, 1, 300)));
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{});
}

TEST_F(StoreCareTest, FindsAFileThatIsCutShort) {
  make(200);
  fs::resize_file(path_, fs::file_size(path_) - 3 * 4096);
  EXPECT_FALSE(good(check_store(path_)).empty());
}

TEST_F(StoreCareTest, BacksUpWhileSomebodyServes) {
  make();
  SqliteOpLog serving = good(SqliteOpLog::open(path_));
  const std::uint64_t fence = good(serving.lease("a", "server", 60'000)).fence;
  ASSERT_FALSE(append_to(serving, "a", 50, fence, sample_entries(50, 5, 300)));
  good(backup_store(path_, backup_, false));
  EXPECT_EQ(fs::status(backup_).permissions(), fs::perms(0600));
  EXPECT_EQ(files(), 4U) << "the store's three and the backup, which is one file";
  EXPECT_EQ(good(check_store(backup_)), std::vector<std::string>{});
  SqliteOpLog copy = good(SqliteOpLog::open(backup_));
  EXPECT_EQ(good(copy.read_from("a", 5, 100'000)), sample_entries(5, 50, 300));
  EXPECT_EQ(good(copy.find("a")).value().history, good(serving.find("a")).value().history);
}

TEST_F(StoreCareTest, OverwritesABackupOnlyWhenTold) {
  make();
  folder_.write("backup.sqlite", "precious");
  EXPECT_EQ(sentence_of(backup_store(path_, backup_, false)),
            backup_.string() + ": is there already. Choose another name, or have it replaced (--force).");
  EXPECT_EQ(bytes_in(backup_), "precious");
  good(backup_store(path_, backup_, true));
  EXPECT_EQ(good(check_store(backup_)), std::vector<std::string>{});
  EXPECT_FALSE(backup_store(folder_.path() / "missing", folder_.path() / "other", false));
  EXPECT_FALSE(backup_store(path_, folder_.path() / "no folder" / "other", false));
  EXPECT_EQ(files(), 2U);
}

TEST_F(StoreCareTest, OverwritesNothingButFilesWithABackup) {
  make();
  const fs::path link = folder_.path() / "link", pipe = folder_.path() / "pipe";
  fs::create_symlink("elsewhere", link);
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& to : {link, pipe, folder_.path()})
    EXPECT_EQ(sentence_of(backup_store(path_, to, true)),
              to.string() + ": is no ordinary file. Choose another name.");
  SqliteOpLog serving = good(SqliteOpLog::open(path_));
  good(serving.create("c"));
  for (const char* ending : {"", "-wal", "-shm"})
    EXPECT_NE(sentence_of(backup_store(path_, path_.string() + ending, true)).find("is a part of the store"),
              std::string::npos);
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST_F(StoreCareTest, RestoresWithAnotherHistory) {
  make();
  good(backup_store(path_, backup_, false));
  std::uint64_t history = 0;
  {
    SqliteOpLog log = good(SqliteOpLog::open(path_));
    history = good(log.find("a")).value().history;
    const std::uint64_t fence = good(log.lease("a", "server", 60'000)).fence;
    ASSERT_FALSE(append_to(log, "a", 50, fence, sample_entries(50, 5, 300)));
  }
  const fs::path kept = good(restore_store(backup_, path_)).former;
  EXPECT_EQ(kept, path_.string() + ".before-restore");
  SqliteOpLog log = good(SqliteOpLog::open(path_));
  EXPECT_EQ(good(log.read_from("a", 5, 100'000)), sample_entries(5, 45, 300));
  EXPECT_NE(good(log.find("a")).value().history, history);
  EXPECT_EQ(good(log.find("a")).value().holder, "");
  EXPECT_TRUE(log.lease("a", "another server", 1000));
  SqliteOpLog former = good(SqliteOpLog::open(kept));
  EXPECT_EQ(good(former.find("a")).value().sequence, 55U);
}

TEST_F(StoreCareTest, LinksThatWereRevokedStaySoWhenAnOlderBackupIsRestored) {
  make();
  good(good(SqliteOpLog::open(path_)).revoke("early"));
  good(backup_store(path_, backup_, false));
  for (const char* id : {"late", "later"}) good(good(SqliteOpLog::open(path_)).revoke(id));
  EXPECT_TRUE(good(restore_store(backup_, path_)).keeps_revoked);
  EXPECT_EQ(good(good(SqliteOpLog::open(path_)).revoked()),
            (std::vector<std::string>{"early", "late", "later"}));
}

TEST_F(StoreCareTest, RestoresWhereNothingIsLeft) {
  make();
  good(backup_store(path_, backup_, false));
  fs::remove(path_);
  const RestoredStore restored = good(restore_store(backup_, path_));
  EXPECT_EQ(restored.former, "");
  EXPECT_FALSE(restored.keeps_revoked);
  EXPECT_EQ(good(good(SqliteOpLog::open(path_)).find("a")).value().sequence, 50U);
}

TEST_F(StoreCareTest, RestoresOverDamage) {
  make();
  good(backup_store(path_, backup_, false));
  const std::string damaged(5 * 4096, 'x');
  folder_.write("designs.sqlite", damaged);
  folder_.write("designs.sqlite-wal", damaged);
  const fs::path kept = good(restore_store(backup_, path_)).former;
  EXPECT_EQ(bytes_in(kept), damaged);
  EXPECT_EQ(bytes_in(kept.string() + "-wal"), damaged);
  EXPECT_FALSE(fs::exists(path_.string() + "-wal"));
  EXPECT_EQ(good(check_store(path_)), std::vector<std::string>{});
  spoil(1);
  EXPECT_EQ(good(restore_store(backup_, path_)).former, path_.string() + ".before-restore-2");
}

TEST_F(StoreCareTest, RestoresNothingThatIsDamagedOrInUse) {
  make();
  good(backup_store(path_, backup_, false));
  {
    SqliteOpLog serving = good(SqliteOpLog::open(path_));
    good(serving.create("c"));
    EXPECT_EQ(
        sentence_of(restore_store(backup_, path_)),
        path_.string() + ": somebody uses this store. End the server and what else uses it, then try again.");
    good(serving.create("d"));
  }
  fs::resize_file(backup_, fs::file_size(backup_) - 4096);
  EXPECT_NE(
      sentence_of(restore_store(backup_, path_)).find(": this backup has faults, so nothing was restored."),
      std::string::npos);
  EXPECT_FALSE(restore_store(folder_.write("text", "no database"), path_));
  EXPECT_EQ(good(good(SqliteOpLog::open(path_)).designs()).size(), 4U);
}

}  // namespace
}  // namespace icome::collab
