#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collab/storage/design_state.h"
#include "collab/storage/op_log.h"

namespace icome::collab {

/// A log of edits in a SQLite file, which several processes of one machine may use at once. Owns its
/// connection. The file is in the WAL mode with synchronous FULL: one write to the disk makes a call to
/// append() durable, however many edits it has. It must lie on a disk of the machine, not on a network's.
class SqliteOpLog final : public OpLog {
 public:
  /// Opens a store, and makes one where there is no file. Fails for a file of another program or a newer
  /// version. Leases are judged by `clock`, ms since 1970.
  static base::Result<SqliteOpLog> open(const std::filesystem::path& path,
                                        std::function<std::int64_t()> clock = wall_milliseconds);
  SqliteOpLog(SqliteOpLog&&) noexcept;
  ~SqliteOpLog() override;

  base::Result<std::vector<DesignRow>> designs() override;
  base::Result<std::optional<DesignRow>> find(const std::string& design) override;
  base::Result<void> create(const std::string& design) override;
  base::Result<DesignLease> lease(const std::string& design, const std::string& holder,
                                  std::int64_t milliseconds) override;
  base::Result<void> release(const std::string& design, const std::string& holder) override;
  std::vector<std::optional<AppendError>> append(std::span<const Append> batches) override;
  base::Result<std::vector<LogEntry>> read_from(const std::string& design, std::uint64_t after,
                                                std::uint64_t most_bytes) override;
  base::Result<std::optional<Snapshot>> snapshot(const std::string& design) override;
  base::Result<void> save_snapshot(const std::string& design, std::uint64_t fence, const Snapshot& snapshot,
                                   std::uint64_t keep_after) override;
  base::Result<AuthorRow> author(const std::string& design, const std::string& key,
                                 const std::string& name) override;
  base::Result<AuthorNames> author_names(const std::string& design) override;
  base::Result<void> revoke(const std::string& invitation) override;
  base::Result<std::vector<std::string>> revoked() override;
  base::Result<std::uint64_t> revoked_version() override;

 private:
  struct Parts;  // the connection and its statements
  explicit SqliteOpLog(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::collab
