#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.h"

struct sqlite3;
struct sqlite3_stmt;

namespace icome::collab {

/// A parameter that is bytes; other strings are text.
struct SqliteBlob {
  std::string_view bytes;
};

/// One run of a prepared statement, which it borrows. It ends with the object, so that no statement that was
/// left half-way keeps the database's latest state from anybody.
class SqliteRun {
 public:
  /// `code` is that of binding the parameters.
  SqliteRun(sqlite3_stmt* statement, const std::filesystem::path& path, int code)
      : statement_(statement), path_(path), code_(code) {}
  SqliteRun(const SqliteRun&) = delete;
  SqliteRun& operator=(const SqliteRun&) = delete;
  ~SqliteRun();

  /// Goes to the next row; false where there is none.
  base::Result<bool> next();
  /// Runs to the end, whatever rows there are.
  base::Result<void> finish();

  // Columns of the row, from 0.
  std::int64_t integer(int column) const;
  std::uint64_t natural(int column) const { return static_cast<std::uint64_t>(integer(column)); }
  std::string bytes(int column) const;

 private:
  sqlite3_stmt* statement_;
  const std::filesystem::path& path_;
  int code_;
};

/// A prepared statement. Owns it; the database that prepared it outlives it.
class SqliteStatement {
 public:
  SqliteStatement() = default;
  SqliteStatement(sqlite3_stmt* statement, std::filesystem::path path)
      : statement_(statement), path_(std::move(path)) {}

  /// Begins a run with these parameters: integers, text or SqliteBlob. What they refer to outlives the run.
  template <typename... Values>
  SqliteRun run(const Values&... values) {
    int index = 0, code = 0;
    ((code = code == 0 ? bind(++index, values) : code), ...);
    return SqliteRun(statement_.get(), path_, code);
  }

 private:
  struct End {
    void operator()(sqlite3_stmt* it) const;
  };
  // All give SQLite's result code.
  int bind(int index, std::int64_t value);
  int bind(int index, std::uint64_t value) { return bind(index, static_cast<std::int64_t>(value)); }
  int bind(int index, std::uint32_t value) { return bind(index, std::int64_t{value}); }
  int bind(int index, const std::string& text);
  int bind(int index, const SqliteBlob& blob);

  std::unique_ptr<sqlite3_stmt, End> statement_;
  std::filesystem::path path_;
};

/// A connection to a SQLite file. Owns it. Errors are sentences that name the file.
class SqliteDatabase {
 public:
  enum class Use { Change, ChangeOrCreate };

  /// A file that is made can be read by its owner only, and one that may not be written is only read. Whether
  /// it is a database shows when it is first read.
  static base::Result<SqliteDatabase> open(const std::filesystem::path& path, Use use);

  const std::filesystem::path& path() const { return path_; }
  sqlite3* handle() const { return handle_.get(); }

  base::Result<SqliteStatement> prepare(const char* sql) const;
  /// Runs statements that have no parameters.
  base::Result<void> execute(const char* sql) const;
  /// The first column of the first row, 0 where there is none.
  base::Result<std::int64_t> number(const char* sql) const;
  base::Result<std::string> text(const char* sql) const;

  /// Runs `work`, which gives a Result, as one transaction; what it changed is taken back where it fails.
  /// `begin` is "BEGIN" to read one state, or "BEGIN IMMEDIATE" to change it.
  template <typename Work>
  auto transact(const char* begin, Work&& work) const -> decltype(work()) {
    if (const auto begun = execute(begin); !begun) return tl::unexpected(begun.error());
    auto result = work();
    if (result) {
      const auto committed = execute("COMMIT");
      if (committed) return result;
      result = tl::unexpected(committed.error());
    }
    (void)execute("ROLLBACK");  // fails where the error has ended the transaction already
    return result;
  }

 private:
  struct Close {
    void operator()(sqlite3* it) const;
  };
  SqliteDatabase(sqlite3* handle, std::filesystem::path path) : handle_(handle), path_(std::move(path)) {}

  std::unique_ptr<sqlite3, Close> handle_;
  std::filesystem::path path_;
};

/// What SQLite's result code means for the person whose file it is.
base::Error sqlite_error(int code, const std::filesystem::path& path);

}  // namespace icome::collab
