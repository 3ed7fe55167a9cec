#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "collab/storage/op_log.h"
#include "collab/storage/postgres_connection.h"

namespace icome::collab {

/// A log of edits in a PostgreSQL database (13 or newer), which any number of servers on any number of
/// machines use at once. Owns its connection. One commit makes a call to append() durable, two ways to the
/// database and back. Leases are judged by the database's clock, so that no server's own clock matters. A
/// connection that is lost fails the call, and the next one connects again; where it is lost during a commit,
/// the change may have been saved: find() tells.
class PostgresOpLog final : public OpLog {
 public:
  /// Opens the store in the database of an address "postgresql://USER:PASSWORD@HOST:PORT/DATABASE" as libpq
  /// reads it, and makes one, in the schema `icome`, where there is none. Fails where the database cannot be
  /// reached, and for a store of a newer version.
  static base::Result<PostgresOpLog> open(const std::string& address, const PostgresPatience& patience = {});
  PostgresOpLog(PostgresOpLog&&) noexcept;
  ~PostgresOpLog() override;

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

  // Notes of the store, such as where it is served, by name; bytes.
  /// The note that is there; or these bytes, which are noted from now on.
  base::Result<std::string> note_once(const std::string& name, const std::string& bytes);
  base::Result<void> write_note(const std::string& name, const std::string& bytes);
  base::Result<std::optional<std::string>> note(const std::string& name);

 private:
  struct Parts;  // the connection and what is done with it
  explicit PostgresOpLog(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::collab
