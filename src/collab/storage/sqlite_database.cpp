#include "collab/storage/sqlite_database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include "collab/storage/private_file.h"

namespace icome::collab {
namespace {

constexpr int kBusyMilliseconds = 5000;  // for which others that write are waited for
// One thread at a time uses a connection, so it needs no locks of its own.
constexpr int kSqliteFlags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE;

}  // namespace

base::Error sqlite_error(int code, const std::filesystem::path& path) {
  const std::string name = path.string();
  switch (code & 0xff) {
    case SQLITE_FULL:
      return {name + ": the disk is full. Make room, then try again; what was saved before is safe."};
    case SQLITE_READONLY:
    case SQLITE_PERM:
      return {name + ": cannot be written. Give yourself the right to write to it and to its folder."};
    case SQLITE_CANTOPEN:
      return {name +
              ": cannot be opened. See whether it is there, and that you may write to it and to its folder."};
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      return {name + ": another program keeps it locked. End that program, or wait for it, then try again."};
    case SQLITE_NOTADB:
      return {name + ": is not a store of designs. Choose another file or folder."};
    case SQLITE_CORRUPT:
      return {name + ": is damaged. Restore a backup of the store."};
    case SQLITE_TOOBIG:
      return {name + ": what should be saved is larger than a store can keep (1 GB). Make it smaller."};
    default:
      return {
          fmt::format("{}: the disk or the file system failed ({}). What was saved before is safe if the "
                      "disk is.",
                      name, sqlite3_errstr(code))};
  }
}

SqliteRun::~SqliteRun() {
  sqlite3_reset(statement_);
  sqlite3_clear_bindings(statement_);
}

base::Result<bool> SqliteRun::next() {
  const int code = code_ == SQLITE_OK ? sqlite3_step(statement_) : code_;
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) return false;
  return tl::unexpected(sqlite_error(code, path_));
}

base::Result<void> SqliteRun::finish() {
  auto more = next();
  while (more && *more) more = next();
  if (!more) return tl::unexpected(more.error());
  return {};
}

std::int64_t SqliteRun::integer(int column) const { return sqlite3_column_int64(statement_, column); }

std::string SqliteRun::bytes(int column) const {
  const void* const first = sqlite3_column_blob(statement_, column);
  const int count = sqlite3_column_bytes(statement_, column);
  return first == nullptr ? std::string() : std::string(static_cast<const char*>(first), std::size_t(count));
}

void SqliteStatement::End::operator()(sqlite3_stmt* it) const { sqlite3_finalize(it); }

int SqliteStatement::bind(int index, std::int64_t value) {
  return sqlite3_bind_int64(statement_.get(), index, value);
}

int SqliteStatement::bind(int index, const std::string& text) {
  return sqlite3_bind_text64(statement_.get(), index, text.data(), text.size(), SQLITE_STATIC, SQLITE_UTF8);
}

int SqliteStatement::bind(int index, const SqliteBlob& blob) {
  // A null pointer would be NULL.
  const char* const first = blob.bytes.empty() ? "" : blob.bytes.data();
  return sqlite3_bind_blob64(statement_.get(), index, first, blob.bytes.size(), SQLITE_STATIC);
}

void SqliteDatabase::Close::operator()(sqlite3* it) const { sqlite3_close(it); }

base::Result<SqliteDatabase> SqliteDatabase::open(const std::filesystem::path& path, Use use) {
  // SQLite takes some relative names for something else than files.
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(path, error);
  if (error) return base::fail(fmt::format("{}: cannot be opened ({}).", path.string(), error.message()));
  if (use == Use::ChangeOrCreate) {
    if (const auto made = make_private_file(whole, {}); !made) return tl::unexpected(made.error());
  }
  sqlite3* handle = nullptr;
  const int code = sqlite3_open_v2(whole.c_str(), &handle, kSqliteFlags, nullptr);
  SqliteDatabase database(handle, whole);
  if (code != SQLITE_OK) return tl::unexpected(sqlite_error(code, whole));
  sqlite3_busy_timeout(handle, kBusyMilliseconds);
  return database;
}

base::Result<SqliteStatement> SqliteDatabase::prepare(const char* sql) const {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v3(handle(), sql, -1, SQLITE_PREPARE_PERSISTENT, &statement, nullptr);
  SqliteStatement result(statement, path_);
  if (code != SQLITE_OK) return tl::unexpected(sqlite_error(code, path_));
  return result;
}

base::Result<void> SqliteDatabase::execute(const char* sql) const {
  const int code = sqlite3_exec(handle(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) return tl::unexpected(sqlite_error(code, path_));
  return {};
}

base::Result<std::int64_t> SqliteDatabase::number(const char* sql) const {
  auto statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  SqliteRun run = statement->run();
  const auto row = run.next();
  if (!row) return tl::unexpected(row.error());
  return *row ? run.integer(0) : 0;
}

base::Result<std::string> SqliteDatabase::text(const char* sql) const {
  auto statement = prepare(sql);
  if (!statement) return tl::unexpected(statement.error());
  SqliteRun run = statement->run();
  const auto row = run.next();
  if (!row) return tl::unexpected(row.error());
  return *row ? run.bytes(0) : std::string();
}

}  // namespace icome::collab
