#include "collab/storage/postgres_schema.h"

#include <fmt/format.h>

#include <optional>
#include <span>

namespace icome::collab {
namespace {

constexpr std::int64_t kSchemaVersion = 2;

// A design's row is written at every commit: half of each page is left free for its next version. Edits have
// no foreign key, which would be looked up for each of them: they are only written behind the lock of their
// design, and no design is ever removed. Keys may be longer than an index takes, so their digests are in it.
constexpr const char* kMakeSchemaTables[] = {
    R"(CREATE TABLE icome.designs (
      id bigint PRIMARY KEY GENERATED ALWAYS AS IDENTITY,
      name text COLLATE "C" NOT NULL UNIQUE,
      history bigint NOT NULL,
      sequence bigint NOT NULL DEFAULT 0,
      kept_after bigint NOT NULL DEFAULT 0,
      snapshot_sequence bigint NOT NULL DEFAULT 0,
      bytes bigint NOT NULL DEFAULT 0,
      fence bigint NOT NULL DEFAULT 0,
      holder text NOT NULL DEFAULT '',
      lease_ends bigint NOT NULL DEFAULT 0,
      lease_length bigint NOT NULL DEFAULT 0
    ) WITH (fillfactor = 50))",
    R"(CREATE TABLE icome.edits (
      design bigint NOT NULL,
      sequence bigint NOT NULL,
      author bigint NOT NULL,
      number bigint NOT NULL,
      at bigint NOT NULL,
      edit bytea NOT NULL,
      sum bigint,
      PRIMARY KEY (design, sequence)
    ))",
    R"(CREATE TABLE icome.snapshots (
      design bigint PRIMARY KEY REFERENCES icome.designs,
      sequence bigint NOT NULL,
      bytes bytea NOT NULL,
      sum bigint
    ))",
    // Packing a large world would take longer than writing it.
    "ALTER TABLE icome.snapshots ALTER COLUMN bytes SET STORAGE EXTERNAL",
    R"(CREATE TABLE icome.authors (
      design bigint NOT NULL REFERENCES icome.designs,
      author bigint NOT NULL,
      key bytea NOT NULL,
      last_number bigint NOT NULL DEFAULT 0,
      name text COLLATE "C" NOT NULL DEFAULT '',
      PRIMARY KEY (design, author)
    ) WITH (fillfactor = 50))",
    "CREATE UNIQUE INDEX authors_by_key ON icome.authors (design, sha256(key))",
    R"(CREATE TABLE icome.revoked (
      number bigint PRIMARY KEY,
      invitation text COLLATE "C" NOT NULL UNIQUE
    ))",
    R"(CREATE TABLE icome.notes (
      name text COLLATE "C" PRIMARY KEY,
      bytes bytea NOT NULL
    ))",
    // Leases are judged by the clock of the database, which all servers share: ms since 1970.
    R"(CREATE FUNCTION icome.clock_milliseconds() RETURNS bigint LANGUAGE sql VOLATILE AS
      'SELECT floor(extract(epoch FROM clock_timestamp()) * 1000)::bigint')",
    "CREATE TABLE icome.store (version bigint NOT NULL)",
};

// Version 1 had no sums, and no names of authors. A server of that version that is connected goes on, and
// writes rows without them.
constexpr const char* kUpgradePostgres[] = {
    "ALTER TABLE icome.edits ADD COLUMN sum bigint", "ALTER TABLE icome.snapshots ADD COLUMN sum bigint",
    "ALTER TABLE icome.authors ADD COLUMN name text COLLATE \"C\" NOT NULL DEFAULT ''",
    "UPDATE icome.store SET version = 2"};

base::Result<bool> is_there(PostgresConnection& connection, const char* sql) {
  const auto rows = connection.execute(sql);
  if (!rows) return tl::unexpected(rows.error());
  return rows->count() > 0;
}

base::Result<void> execute_all(PostgresConnection& connection, std::span<const char* const> statements) {
  for (const char* const sql : statements) {
    const auto done = connection.execute(sql);
    if (!done) return tl::unexpected(done.error());
  }
  return {};
}

/// The version of the tables; nothing where there are none.
base::Result<std::optional<std::int64_t>> schema_version(PostgresConnection& connection) {
  const auto has_table = is_there(
      connection, "SELECT 1 FROM pg_catalog.pg_tables WHERE schemaname = 'icome' AND tablename = 'store'");
  if (!has_table) return tl::unexpected(has_table.error());
  if (!*has_table) return std::nullopt;
  const auto rows = connection.execute("SELECT version FROM icome.store");
  if (!rows) return tl::unexpected(rows.error());
  return rows->count() == 1 ? rows->integer(0, 0) : 0;
}

base::Result<void> judge_schema(std::int64_t version, const std::string& place) {
  if (version > kSchemaVersion)
    return base::fail(
        fmt::format("{}: its store is that of a newer version of icome (store version {}, this one "
                    "knows {}). Use that version.",
                    place, version, kSchemaVersion));
  if (version < 1)
    return base::fail(place +
                      ": the store in it is damaged (it has no version). Restore a backup of the database.");
  return {};
}

base::Result<void> make_schema(PostgresConnection& connection) {
  // The schema may have been made for us by somebody who does not let us make any.
  const auto has_schema =
      is_there(connection, "SELECT 1 FROM pg_catalog.pg_namespace WHERE nspname = 'icome'");
  if (!has_schema) return tl::unexpected(has_schema.error());
  if (!*has_schema) {
    const auto made = connection.execute("CREATE SCHEMA icome");
    if (!made) return tl::unexpected(made.error());
  }
  if (const auto made = execute_all(connection, kMakeSchemaTables); !made) return made;
  const std::string mark = fmt::format("INSERT INTO icome.store VALUES ({})", kSchemaVersion);
  const auto marked = connection.execute(mark.c_str());
  if (!marked) return tl::unexpected(marked.error());
  return {};
}

}  // namespace

base::Result<void> make_postgres_store(PostgresConnection& connection) {
  const auto version = schema_version(connection);
  if (!version) return tl::unexpected(version.error());
  if (*version == kSchemaVersion) return {};
  return connection.transact("BEGIN", [&]() -> base::Result<void> {
    // Any number of ours ("ICOM") that all servers know.
    const auto locked = connection.execute("SELECT pg_advisory_xact_lock(1229147981)");
    if (!locked) return tl::unexpected(locked.error());
    const auto now = schema_version(connection);
    if (!now) return tl::unexpected(now.error());
    if (!*now) return make_schema(connection);
    if (const auto good = judge_schema(**now, connection.place()); !good) return good;
    const bool is_old = **now < kSchemaVersion;  // else another server was faster
    return is_old ? execute_all(connection, kUpgradePostgres) : base::Result<void>();
  });
}

}  // namespace icome::collab
