#pragma once
#include <filesystem>
#include <string>

#include "apps/touch/tick_row.h"
#include "base/result.h"
#include "io/new_file.h"

namespace icome::apps {

/// The trace of a run as CSV, one row a tick, every number with as many digits as bring back its bits.
/// The file appears whole, by finish(), or not at all.
class TraceFile {
 public:
  /// Opens the file and writes the header. An impossible path is reported before a run, not after it.
  static base::Result<TraceFile> create(const std::filesystem::path& path);

  /// Adds a row; finish() reports a failure.
  void add(const TickRow& row);

  /// Gives the file its name. Call once.
  base::Result<void> finish();

 private:
  explicit TraceFile(io::NewFile file);
  void flush();

  io::NewFile file_;
  std::string buffer_;
};

}  // namespace icome::apps
