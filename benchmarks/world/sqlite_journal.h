#pragma once
#include <filesystem>
#include <memory>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace icome::benchmarks {

/// The peer: edits in an SQLite database with a write-ahead log, as in programs that need no journal of their
/// own. One transaction for each edit.
class SqliteJournal {
 public:
  /// With `synced`, edits survive a power failure; else only the end of the program.
  SqliteJournal(const std::filesystem::path& path, bool synced);
  void append(std::string_view bytes);

 private:
  struct Close {
    void operator()(sqlite3* it) const;
    void operator()(sqlite3_stmt* it) const;
  };
  std::unique_ptr<sqlite3, Close> database_;
  std::unique_ptr<sqlite3_stmt, Close> insert_;
};

}  // namespace icome::benchmarks
