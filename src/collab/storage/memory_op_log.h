#pragma once
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "collab/storage/design_state.h"
#include "collab/storage/op_log.h"

namespace icome::collab {

/// A log of edits in memory, for tests and simulations, where it outlives the servers that use it as a disk
/// would. Owns all it holds; it ends with the object.
class MemoryOpLog : public OpLog {
 public:
  /// Leases are judged by `clock`, ms since 1970.
  explicit MemoryOpLog(std::function<std::int64_t()> clock = wall_milliseconds) : clock_(std::move(clock)) {}

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
  struct Design {
    DesignState state = {};
    std::deque<LogEntry> edits = {};  // behind state.kept_after
    std::optional<Snapshot> snapshot = {};
    std::map<std::string, std::uint32_t> authors = {};  // by key
    AuthorNames names = {};
    std::vector<std::uint64_t> last_numbers = {};  // of author i + 1
  };

  /// Null where there is no such design.
  Design* design_of(const std::string& name);
  std::optional<AppendError> append_one(const Append& append);

  std::function<std::int64_t()> clock_;
  std::map<std::string, Design> designs_;
  std::vector<std::string> revoked_;
};

}  // namespace icome::collab
