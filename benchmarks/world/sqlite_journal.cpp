#include "sqlite_journal.h"

#include <sqlite3.h>

#include <cstdlib>
#include <string>

namespace icome::benchmarks {
namespace {

void demand(bool good) {
  if (!good) std::abort();
}

}  // namespace

void SqliteJournal::Close::operator()(sqlite3* it) const { sqlite3_close(it); }
void SqliteJournal::Close::operator()(sqlite3_stmt* it) const { sqlite3_finalize(it); }

SqliteJournal::SqliteJournal(const std::filesystem::path& path, bool synced) {
  sqlite3* database = nullptr;
  demand(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  database_.reset(database);
  const std::string setup = std::string("PRAGMA journal_mode=WAL; PRAGMA synchronous=") +
                            (synced ? "FULL" : "NORMAL") +
                            "; CREATE TABLE edits (number INTEGER PRIMARY KEY, bytes BLOB);";
  demand(sqlite3_exec(database, setup.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
  sqlite3_stmt* insert = nullptr;
  demand(sqlite3_prepare_v2(database, "INSERT INTO edits (bytes) VALUES (?)", -1, &insert, nullptr) ==
         SQLITE_OK);
  insert_.reset(insert);
}

void SqliteJournal::append(std::string_view bytes) {
  demand(sqlite3_bind_blob(insert_.get(), 1, bytes.data(), int(bytes.size()), SQLITE_STATIC) == SQLITE_OK);
  demand(sqlite3_step(insert_.get()) == SQLITE_DONE);
  demand(sqlite3_reset(insert_.get()) == SQLITE_OK);
}

}  // namespace icome::benchmarks
