#pragma once
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "apps/tick_row.h"
#include "base/result.h"

namespace icome::apps {

/// The trace of a run as CSV, one row a tick, every number with as many digits as bring back its bits.
/// Written beside `path` and renamed by finish(), so that the file appears whole or not at all.
class TraceFile {
 public:
  /// Opens the file beside `path` and writes the header; the error names the path and what the system
  /// said, so an impossible path is told before a run, not after it.
  static base::Result<TraceFile> create(const std::filesystem::path& path);

  TraceFile(TraceFile&&) noexcept = default;
  /// Leaves what is at `path` as it was unless finish() succeeded.
  ~TraceFile();

  /// Adds a row. What could not be written is told by finish().
  void add(const TickRow& row);

  /// Gives the file its name. Call once.
  base::Result<void> finish();

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  TraceFile(std::filesystem::path path, std::filesystem::path beside, std::FILE* file);
  void flush();

  std::filesystem::path path_;
  std::filesystem::path beside_;
  std::unique_ptr<std::FILE, Close> file_;  // null once finished or moved from
  std::string buffer_;
  int write_error_ = 0;  // errno of the first failure
};

}  // namespace icome::apps
