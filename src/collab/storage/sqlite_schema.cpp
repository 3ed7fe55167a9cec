#include "collab/storage/sqlite_schema.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <chrono>
#include <thread>

namespace icome::collab {
namespace {

constexpr std::int64_t kStoreApplication =
    0x49434f4d;  // "ICOM", by which programs such as file(1) tell databases
constexpr std::int64_t kStoreVersion = 3;

// Edits have rows with numbers of their own (no WITHOUT ROWID): long ones would lie on the way to all others.
constexpr const char* kEditsTable = R"(
CREATE TABLE edits (
  design INTEGER NOT NULL REFERENCES designs (id),
  sequence INTEGER NOT NULL,
  author INTEGER NOT NULL,
  number INTEGER NOT NULL,
  at INTEGER NOT NULL,
  edit BLOB NOT NULL,
  sum INTEGER,
  PRIMARY KEY (design, sequence)
) STRICT;
)";

// A design's row has, besides what is its own, what could be had from its edits: it is read for every append.
constexpr const char* kMakeTables = R"(
CREATE TABLE designs (
  id INTEGER PRIMARY KEY,
  name TEXT NOT NULL UNIQUE,
  history INTEGER NOT NULL,
  sequence INTEGER NOT NULL DEFAULT 0,
  kept_after INTEGER NOT NULL DEFAULT 0,
  snapshot_sequence INTEGER NOT NULL DEFAULT 0,
  bytes INTEGER NOT NULL DEFAULT 0,
  fence INTEGER NOT NULL DEFAULT 0,
  holder TEXT NOT NULL DEFAULT '',
  lease_ends INTEGER NOT NULL DEFAULT 0,
  lease_length INTEGER NOT NULL DEFAULT 0
) STRICT;
CREATE TABLE snapshots (
  design INTEGER PRIMARY KEY REFERENCES designs (id),
  sequence INTEGER NOT NULL,
  bytes BLOB NOT NULL,
  sum INTEGER
) STRICT;
CREATE TABLE authors (
  design INTEGER NOT NULL REFERENCES designs (id),
  author INTEGER NOT NULL,
  key BLOB NOT NULL,
  last_number INTEGER NOT NULL DEFAULT 0,
  name TEXT NOT NULL DEFAULT '',
  PRIMARY KEY (design, author),
  UNIQUE (design, key)
) STRICT, WITHOUT ROWID;
CREATE TABLE revoked (
  number INTEGER PRIMARY KEY,
  invitation TEXT NOT NULL UNIQUE
) STRICT;
)";

// Version 1 had no sums, so that its edits and snapshots are believed as they are, and no names of authors.
constexpr const char* kToVersion2 = R"(
ALTER TABLE edits ADD COLUMN sum INTEGER;
ALTER TABLE snapshots ADD COLUMN sum INTEGER;
ALTER TABLE authors ADD COLUMN name TEXT NOT NULL DEFAULT '';
)";

constexpr const char* kMoveEdits = R"(
INSERT INTO edits SELECT design, sequence, author, number, at, edit, sum FROM edits_before;
DROP TABLE edits_before;
PRAGMA user_version = 3;
)";

struct StoreMarks {
  std::int64_t application = 0, version = 0, tables = 0;
  bool is_empty() const { return application == 0 && version == 0 && tables == 0; }
};

base::Result<StoreMarks> marks_of(const SqliteDatabase& database) {
  const auto application = database.number("PRAGMA application_id");
  if (!application) return tl::unexpected(application.error());
  const auto version = database.number("PRAGMA user_version");
  if (!version) return tl::unexpected(version.error());
  const auto tables = database.number("SELECT count(*) FROM sqlite_schema");
  if (!tables) return tl::unexpected(tables.error());
  return StoreMarks{*application, *version, *tables};
}

base::Result<void> judge_marks(const StoreMarks& marks, const SqliteDatabase& database) {
  const std::string name = database.path().string();
  if (marks.application != kStoreApplication)
    return base::fail(name + ": is the database of another program. Choose another file or folder.");
  if (marks.version > kStoreVersion)
    return base::fail(
        fmt::format("{}: was written by a newer version of icome (store version {}, this one knows "
                    "{}). Use that version.",
                    name, marks.version, kStoreVersion));
  if (marks.version < 1) return tl::unexpected(sqlite_error(SQLITE_CORRUPT, database.path()));
  return {};
}

base::Result<void> make_tables(const SqliteDatabase& database) {
  return database.transact("BEGIN IMMEDIATE", [&]() -> base::Result<void> {
    const auto marks = marks_of(database);
    if (!marks) return tl::unexpected(marks.error());
    if (!marks->is_empty()) return judge_marks(*marks, database);  // another process was faster
    for (const char* tables : {kMakeTables, kEditsTable})
      if (const auto made = database.execute(tables); !made) return made;
    const std::string mark =
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kStoreApplication, kStoreVersion);
    return database.execute(mark.c_str());
  });
}

base::Result<void> bring_up_to_date(const SqliteDatabase& database) {
  return database.transact("BEGIN IMMEDIATE", [&]() -> base::Result<void> {
    const auto version = database.number("PRAGMA user_version");
    if (!version) return tl::unexpected(version.error());
    if (*version >= kStoreVersion) return {};  // another process was faster
    if (*version < 2)
      if (const auto done = database.execute(kToVersion2); !done) return done;
    for (const char* step : {"ALTER TABLE edits RENAME TO edits_before", kEditsTable, kMoveEdits})
      if (const auto done = database.execute(step); !done) return done;
    return {};
  });
}

/// SQLite does not wait for other connections here, as it does elsewhere: several programs may begin at once.
base::Result<std::string> write_ahead_mode(const SqliteDatabase& database) {
  constexpr int kMostWalTries = 1'000;
  constexpr std::chrono::milliseconds kWalPause{5};
  for (int i = 0;; ++i) {
    auto mode = database.text("PRAGMA journal_mode = WAL");
    const bool is_busy = !mode && (sqlite3_errcode(database.handle()) & 0xff) == SQLITE_BUSY;
    if (!is_busy || i == kMostWalTries) return mode;
    std::this_thread::sleep_for(kWalPause);
  }
}

base::Result<void> begin_write_ahead(const SqliteDatabase& database) {
  const auto mode = write_ahead_mode(database);
  if (!mode) return tl::unexpected(mode.error());
  if (*mode == "wal") return {};
  return base::fail(
      fmt::format("{}: the file system of this folder cannot share memory between programs. Choose a "
                  "folder on a disk of this machine.",
                  database.path().string()));
}

}  // namespace

base::Result<bool> has_sums(const SqliteDatabase& database) {
  const auto version = database.number("PRAGMA user_version");
  if (!version) return tl::unexpected(version.error());
  return *version >= 2;
}

base::Result<void> demand_store(const SqliteDatabase& database) {
  const auto marks = marks_of(database);
  if (!marks) return tl::unexpected(marks.error());
  return judge_marks(*marks, database);
}

base::Result<void> make_store(const SqliteDatabase& database) {
  // All marks of one moment: another process may be making the store.
  const auto marks = database.transact("BEGIN", [&] { return marks_of(database); });
  if (!marks) return tl::unexpected(marks.error());
  if (!marks->is_empty()) {
    if (const auto good = judge_marks(*marks, database); !good) return good;
  }
  if (const auto begun = begin_write_ahead(database); !begun) return begun;
  if (marks->is_empty()) return make_tables(database);
  return marks->version < kStoreVersion ? bring_up_to_date(database) : base::Result<void>();
}

}  // namespace icome::collab
