#include "collab/storage/postgres_op_log.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "base/shown_text.h"
#include "base/utf8.h"
#include "collab/storage/design_state.h"
#include "collab/storage/log_sums.h"
#include "collab/storage/postgres_schema.h"

namespace icome::collab {
namespace {

constexpr const char* kBeginChange = "BEGIN";
constexpr const char* kBeginLook = "BEGIN ISOLATION LEVEL REPEATABLE READ, READ ONLY";
constexpr std::int64_t kEditsInOneRead = 4096;
constexpr std::uint64_t kBytesInOneInsert = 16ULL << 20U;
constexpr std::uint64_t kMostSnapshotBytes = 900ULL << 20U;  // PostgreSQL takes no message of 1 GiB

// Order of the columns that stored_row() reads.
#define ICOME_POSTGRES_DESIGN                                                                             \
  "SELECT id, name, history, sequence, kept_after, snapshot_sequence, bytes, fence, holder, lease_ends, " \
  "lease_length, icome.clock_milliseconds() FROM icome.designs "

namespace statements {

constexpr PostgresStatement kAllDesigns{"all_designs", ICOME_POSTGRES_DESIGN "ORDER BY name"};
constexpr PostgresStatement kFindDesign{"find_design", ICOME_POSTGRES_DESIGN "WHERE name = $1"};
// A lock is waited for in a statement of its own: the next one sees what its last holder changed, and the
// time.
constexpr PostgresStatement kLockDesign{"lock_design",
                                        "SELECT 1 FROM icome.designs WHERE name = $1 FOR UPDATE"};
// All servers lock in the same order, so none waits for one that waits for it.
constexpr PostgresStatement kLockDesigns{
    "lock_designs", ICOME_POSTGRES_DESIGN "WHERE name = ANY ($1::text[]) ORDER BY id FOR UPDATE"};
constexpr PostgresStatement kInsertDesign{
    "insert_design",
    "INSERT INTO icome.designs (name, history) VALUES ($1, $2) ON CONFLICT DO NOTHING RETURNING id"};
constexpr PostgresStatement kUpdateLease{
    "update_lease",
    "UPDATE icome.designs SET fence = $2, holder = $3, lease_ends = $4, lease_length = $5 WHERE id = $1"};
constexpr PostgresStatement kUpdateSequences{
    "update_sequences",
    "UPDATE icome.designs AS design SET sequence = now.sequence, bytes = now.bytes FROM "
    "unnest($1::bigint[], $2::bigint[], $3::bigint[]) AS now (id, sequence, bytes) WHERE design.id = now.id"};
constexpr PostgresStatement kInsertEdits{
    "insert_edits",
    "INSERT INTO icome.edits (design, sequence, author, number, at, edit, sum) SELECT * FROM "
    "unnest($1::bigint[], $2::bigint[], $3::bigint[], $4::bigint[], $5::bigint[], $6::bytea[], "
    "$7::bigint[])"};
// The first $3 edits behind $2 whose bytes together are at most $4, and in any case the edit $5.
constexpr PostgresStatement kReadEdits{
    "read_edits",
    "SELECT sequence, author, number, at, edit, coalesce(sum, -1) FROM (SELECT *, sum(octet_length(edit)) "
    "OVER (ORDER BY "
    "sequence "
    "ROWS UNBOUNDED PRECEDING) AS total FROM (SELECT * FROM icome.edits WHERE design = $1 AND sequence > $2 "
    "ORDER "
    "BY sequence LIMIT $3) AS next) AS summed WHERE total <= $4 OR sequence = $5 ORDER BY sequence"};
constexpr PostgresStatement kBytesBehind{"bytes_behind",
                                         "SELECT coalesce(sum(octet_length(edit)), 0)::bigint FROM "
                                         "icome.edits WHERE design = $1 AND sequence > $2"};
constexpr PostgresStatement kForgetEdits{"forget_edits",
                                         "DELETE FROM icome.edits WHERE design = $1 AND sequence <= $2"};
constexpr PostgresStatement kReadSnapshot{
    "read_snapshot", "SELECT sequence, bytes, coalesce(sum, -1) FROM icome.snapshots WHERE design = $1"};
constexpr PostgresStatement kWriteSnapshot{
    "write_snapshot",
    "INSERT INTO icome.snapshots (design, sequence, bytes, sum) VALUES "
    "($1, $2, $3, $4) ON CONFLICT (design) DO UPDATE SET sequence = "
    "excluded.sequence, bytes = excluded.bytes, sum = excluded.sum"};
constexpr PostgresStatement kUpdateSnapshot{
    "update_snapshot",
    "UPDATE icome.designs SET kept_after = $2, snapshot_sequence = $3, bytes = $4 WHERE id = $1"};
// While rows come, however slowly; the connection gives up when none do.
constexpr PostgresStatement kTakeTime{"take_time", "SET LOCAL statement_timeout = 0"};
constexpr PostgresStatement kFindAuthor{"find_author",
                                        "SELECT author, last_number FROM icome.authors WHERE design = $1 AND "
                                        "sha256(key) = sha256($2::bytea) AND key = "
                                        "$2::bytea"};
constexpr PostgresStatement kInsertAuthor{
    "insert_author",
    "INSERT INTO icome.authors (design, author, key) SELECT $1::bigint, coalesce(max(author), 0) + 1, "
    "$2::bytea "
    "FROM icome.authors WHERE design = $1 RETURNING author, last_number"};
constexpr PostgresStatement kCountAuthors{
    "count_authors",
    "UPDATE icome.authors AS author SET last_number = now.number FROM unnest($1::bigint[], $2::bigint[], "
    "$3::bigint[]) AS now (design, author, number) WHERE author.design = now.design AND author.author = "
    "now.author "
    "AND author.last_number < now.number"};
constexpr PostgresStatement kNameAuthor{
    "name_author", "UPDATE icome.authors SET name = $3 WHERE design = $1 AND author = $2 AND name <> $3"};
constexpr PostgresStatement kAllNames{
    "all_names", "SELECT author, name FROM icome.authors WHERE design = $1 AND name <> ''"};
// One revokes at a time: who saw a number has seen all below it.
constexpr PostgresStatement kLockRevoked{"lock_revoked", "LOCK TABLE icome.revoked IN EXCLUSIVE MODE"};
constexpr PostgresStatement kInsertRevoked{"insert_revoked",
                                           "INSERT INTO icome.revoked (number, invitation) SELECT "
                                           "coalesce(max(number), 0) + 1, $1 FROM icome.revoked ON "
                                           "CONFLICT (invitation) DO NOTHING"};
constexpr PostgresStatement kAllRevoked{"all_revoked",
                                        "SELECT invitation FROM icome.revoked ORDER BY number"};
constexpr PostgresStatement kLastRevoked{"last_revoked",
                                         "SELECT coalesce(max(number), 0) FROM icome.revoked"};

constexpr PostgresStatement kInsertNote{
    "insert_note", "INSERT INTO icome.notes (name, bytes) VALUES ($1, $2) ON CONFLICT (name) DO NOTHING"};
constexpr PostgresStatement kWriteNote{
    "write_note",
    "INSERT INTO icome.notes (name, bytes) VALUES ($1, $2) ON CONFLICT (name) DO UPDATE SET bytes = $2"};
constexpr PostgresStatement kReadNote{"read_note", "SELECT bytes FROM icome.notes WHERE name = $1"};

constexpr PostgresStatement kAll[] = {
    kAllDesigns,      kFindDesign,     kLockDesign,  kLockDesigns,   kInsertDesign, kUpdateLease,
    kUpdateSequences, kInsertEdits,    kReadEdits,   kBytesBehind,   kForgetEdits,  kReadSnapshot,
    kWriteSnapshot,   kUpdateSnapshot, kTakeTime,    kFindAuthor,    kInsertAuthor, kCountAuthors,
    kNameAuthor,      kAllNames,       kLockRevoked, kInsertRevoked, kAllRevoked,   kLastRevoked,
    kInsertNote,      kWriteNote,      kReadNote};

}  // namespace statements

/// A row of `designs`, and the database's time at which it was read.
struct PostgresDesign {
  std::int64_t id = 0;
  std::string name = {};
  DesignState state = {};
  std::int64_t now = 0;  // ms since 1970
};
using PostgresDesigns = std::map<std::string, PostgresDesign>;

PostgresDesign stored_row(const PostgresRows& rows, int row) {
  return {.id = rows.integer(row, 0),
          .name = rows.bytes(row, 1),
          .state = {.history = rows.natural(row, 2),
                    .sequence = rows.natural(row, 3),
                    .kept_after = rows.natural(row, 4),
                    .snapshot_sequence = rows.natural(row, 5),
                    .bytes = rows.natural(row, 6),
                    .fence = rows.natural(row, 7),
                    .holder = rows.bytes(row, 8),
                    .lease_ends = rows.integer(row, 9),
                    .lease_length = rows.integer(row, 10)},
          .now = rows.integer(row, 11)};
}

/// Whether the database can keep it as text; else no design has this name.
bool is_database_text(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = base::utf8_length(text);
    if (length == 0 || text.front() == '\0') return false;
    text.remove_prefix(length);
  }
  return true;
}

/// A number that no other history of a design has, but by a chance of 1 in 2^63.
std::int64_t fresh_history() {
  std::random_device source;
  return std::uniform_int_distribution<std::int64_t>(1, std::numeric_limits<std::int64_t>::max())(source);
}

std::uint64_t as_bigint(std::uint64_t number) {
  return std::min<std::uint64_t>(number, std::numeric_limits<std::int64_t>::max());
}

base::Result<void> without_rows(const base::Result<PostgresRows>& rows) {
  if (!rows) return tl::unexpected(rows.error());
  return {};
}

/// Edits as the columns of one INSERT.
struct EditColumns {
  using Of = PostgresArray::Of;
  PostgresArray designs{Of::Numbers}, sequences{Of::Numbers}, authors{Of::Numbers}, numbers{Of::Numbers},
      times{Of::Numbers}, edits{Of::Bytes}, sums{Of::Numbers};
  std::uint64_t bytes = 0;

  void add(std::int64_t design, const LogEntry& entry) {
    designs.add(design);
    sequences.add(entry.sequence);
    authors.add(std::int64_t{entry.author});
    numbers.add(entry.number);
    times.add(entry.at);
    edits.add(entry.edit);
    sums.add(std::int64_t{sum_of(entry)});
    bytes += entry.edit.size();
  }
};

/// Three numbers in each row of an UPDATE.
struct NumberColumns {
  PostgresArray first{PostgresArray::Of::Numbers}, second{PostgresArray::Of::Numbers},
      third{PostgresArray::Of::Numbers};

  void add(std::int64_t a, std::uint64_t b, std::uint64_t c) {
    first.add(a);
    second.add(b);
    third.add(c);
  }
};

/// Judges batches one after the other, and goes on to the states of their designs behind them.
std::vector<std::optional<AppendError>> judge_batches(std::span<const Append> batches,
                                                      PostgresDesigns& designs) {
  std::vector<std::optional<AppendError>> results;
  for (const Append& it : batches) {
    const auto found = designs.find(it.design);
    if (found == designs.end()) {
      results.push_back(AppendError{AppendProblem::NoDesign, no_such_design(it.design).message});
      continue;
    }
    results.push_back(why_not_appended(found->second.state, it));
    if (!results.back()) count_appended(found->second.state, it);
  }
  return results;
}

}  // namespace

struct PostgresOpLog::Parts {
  PostgresConnection connection;

  base::Result<std::optional<PostgresDesign>> find(const std::string& name);
  base::Result<PostgresDesign> demand(const std::string& name);
  /// As demand(); nobody else changes the design until the transaction ends.
  base::Result<PostgresDesign> lock(const std::string& name);
  base::Result<PostgresDesigns> lock_all(std::span<const Append> batches);
  void update_lease(const PostgresDesign& design);

  using Results = std::vector<std::optional<AppendError>>;
  void write_edits(std::span<const Append> batches, const Results& results, const PostgresDesigns& designs);
  void count_authors(std::span<const Append> batches, const Results& results, const PostgresDesigns& designs);
  void write_sequences(std::span<const Append> batches, const Results& results,
                       const PostgresDesigns& designs);
};

base::Result<std::optional<PostgresDesign>> PostgresOpLog::Parts::find(const std::string& name) {
  if (!is_database_text(name)) return std::nullopt;
  const auto rows = connection.run(statements::kFindDesign, name);
  if (!rows) return tl::unexpected(rows.error());
  return rows->count() > 0 ? std::optional(stored_row(*rows, 0)) : std::nullopt;
}

base::Result<PostgresDesign> PostgresOpLog::Parts::demand(const std::string& name) {
  auto found = find(name);
  if (!found) return tl::unexpected(found.error());
  if (!*found) return tl::unexpected(no_such_design(name));
  return std::move(**found);
}

base::Result<PostgresDesign> PostgresOpLog::Parts::lock(const std::string& name) {
  if (is_database_text(name)) connection.queue(statements::kLockDesign, name);
  return demand(name);
}

base::Result<PostgresDesigns> PostgresOpLog::Parts::lock_all(std::span<const Append> batches) {
  PostgresArray names(PostgresArray::Of::Texts);
  for (const Append& it : batches)
    if (is_database_text(it.design)) names.add(it.design);
  const auto rows = connection.run(statements::kLockDesigns, names.value());
  if (!rows) return tl::unexpected(rows.error());
  PostgresDesigns designs;
  for (int i = 0; i < rows->count(); ++i) {
    PostgresDesign design = stored_row(*rows, i);
    std::string name = design.name;
    designs.emplace(std::move(name), std::move(design));
  }
  return designs;
}

void PostgresOpLog::Parts::update_lease(const PostgresDesign& design) {
  const DesignState& it = design.state;
  connection.queue(statements::kUpdateLease, design.id, it.fence, it.holder, it.lease_ends, it.lease_length);
}

PostgresOpLog::PostgresOpLog(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
PostgresOpLog::PostgresOpLog(PostgresOpLog&&) noexcept = default;
PostgresOpLog::~PostgresOpLog() = default;

base::Result<PostgresOpLog> PostgresOpLog::open(const std::string& address,
                                                const PostgresPatience& patience) {
  auto connection = PostgresConnection::open(address, patience, [](PostgresConnection& fresh) {
    const auto made = make_postgres_store(fresh);
    return made ? fresh.prepare(statements::kAll) : made;
  });
  if (!connection) return tl::unexpected(connection.error());
  return PostgresOpLog(std::make_unique<Parts>(Parts{std::move(*connection)}));
}

base::Result<std::vector<DesignRow>> PostgresOpLog::designs() {
  return parts_->connection.connected([&]() -> base::Result<std::vector<DesignRow>> {
    const auto rows = parts_->connection.run(statements::kAllDesigns);
    if (!rows) return tl::unexpected(rows.error());
    std::vector<DesignRow> designs;
    for (int i = 0; i < rows->count(); ++i) {
      const PostgresDesign design = stored_row(*rows, i);
      designs.push_back(row_of(design.name, design.state));
    }
    return designs;
  });
}

base::Result<std::optional<DesignRow>> PostgresOpLog::find(const std::string& design) {
  return parts_->connection.connected([&]() -> base::Result<std::optional<DesignRow>> {
    const auto found = parts_->find(design);
    if (!found) return tl::unexpected(found.error());
    return *found ? std::optional(row_of(design, (*found)->state)) : std::nullopt;
  });
}

base::Result<void> PostgresOpLog::create(const std::string& design) {
  if (!is_database_text(design))
    return base::fail(base::shown_text(base::as_utf8(design)) +
                      ": is no name that a database can keep. Choose another one.");
  return parts_->connection.connected([&]() -> base::Result<void> {
    const auto rows = parts_->connection.run(statements::kInsertDesign, design, fresh_history());
    if (!rows) return tl::unexpected(rows.error());
    if (rows->count() == 0) return tl::unexpected(design_exists(design));
    return {};
  });
}

base::Result<DesignLease> PostgresOpLog::lease(const std::string& design, const std::string& holder,
                                               std::int64_t milliseconds) {
  return parts_->connection.transact(kBeginChange, [&]() -> base::Result<DesignLease> {
    auto found = parts_->lock(design);
    if (!found) return tl::unexpected(found.error());
    const auto taken = take_lease(found->state, design, holder, found->now, milliseconds);
    if (taken) parts_->update_lease(*found);
    return taken;
  });
}

base::Result<void> PostgresOpLog::release(const std::string& design, const std::string& holder) {
  return parts_->connection.transact(kBeginChange, [&]() -> base::Result<void> {
    if (is_database_text(design)) parts_->connection.queue(statements::kLockDesign, design);
    auto found = parts_->find(design);
    if (!found) return tl::unexpected(found.error());
    if (*found && give_lease_back((*found)->state, holder)) parts_->update_lease(**found);
    return {};
  });
}

std::vector<std::optional<AppendError>> PostgresOpLog::append(std::span<const Append> batches) {
  Parts::Results results;
  if (batches.empty()) return results;
  const auto done = parts_->connection.transact(kBeginChange, [&]() -> base::Result<void> {
    auto designs = parts_->lock_all(batches);
    if (!designs) return tl::unexpected(designs.error());
    results = judge_batches(batches, *designs);
    parts_->write_edits(batches, results, *designs);
    parts_->count_authors(batches, results, *designs);
    parts_->write_sequences(batches, results, *designs);
    return {};
  });
  results.resize(batches.size());
  if (done) return results;
  for (std::optional<AppendError>& it : results)
    if (!it) it = AppendError{AppendProblem::Store, done.error().message};
  return results;
}

void PostgresOpLog::Parts::write_edits(std::span<const Append> batches, const Results& results,
                                       const PostgresDesigns& designs) {
  EditColumns columns;
  const auto write = [&] {
    if (columns.designs.count() == 0) return;
    connection.queue(statements::kInsertEdits, columns.designs.value(), columns.sequences.value(),
                     columns.authors.value(), columns.numbers.value(), columns.times.value(),
                     columns.edits.value(), columns.sums.value());
    columns = {};
  };
  for (std::size_t i = 0; i < batches.size(); ++i) {
    if (results[i]) continue;
    const std::int64_t design = designs.at(batches[i].design).id;
    for (const LogEntry& entry : batches[i].batch) {
      if (columns.bytes + entry.edit.size() > kBytesInOneInsert) write();
      columns.add(design, entry);
    }
  }
  write();
}

void PostgresOpLog::Parts::count_authors(std::span<const Append> batches, const Results& results,
                                         const PostgresDesigns& designs) {
  std::map<std::pair<std::int64_t, std::uint32_t>, std::uint64_t> last_numbers;  // by design and author
  for (std::size_t i = 0; i < batches.size(); ++i) {
    if (results[i]) continue;
    const std::int64_t design = designs.at(batches[i].design).id;
    for (const LogEntry& entry : batches[i].batch) {
      std::uint64_t& last = last_numbers[{design, entry.author}];
      last = std::max(last, entry.number);
    }
  }
  if (last_numbers.empty()) return;
  NumberColumns columns;
  for (const auto& [author, number] : last_numbers) columns.add(author.first, author.second, number);
  connection.queue(statements::kCountAuthors, columns.first.value(), columns.second.value(),
                   columns.third.value());
}

void PostgresOpLog::Parts::write_sequences(std::span<const Append> batches, const Results& results,
                                           const PostgresDesigns& designs) {
  std::map<std::int64_t, const DesignState*> changed;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    if (results[i] || batches[i].batch.empty()) continue;
    const PostgresDesign& design = designs.at(batches[i].design);
    changed[design.id] = &design.state;
  }
  if (changed.empty()) return;
  NumberColumns columns;
  for (const auto& [id, state] : changed) columns.add(id, state->sequence, state->bytes);
  connection.queue(statements::kUpdateSequences, columns.first.value(), columns.second.value(),
                   columns.third.value());
}

base::Result<std::vector<LogEntry>> PostgresOpLog::read_from(const std::string& design, std::uint64_t after,
                                                             std::uint64_t most_bytes) {
  return parts_->connection.transact(kBeginLook, [&]() -> base::Result<std::vector<LogEntry>> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    if (const auto kept = demand_kept(found->state, design, after); !kept)
      return tl::unexpected(kept.error());
    parts_->connection.queue(statements::kTakeTime);
    std::vector<LogEntry> entries;
    std::uint64_t last = after, bytes = 0;
    while (last < found->state.sequence && bytes <= most_bytes) {
      const std::uint64_t always = last == after ? last + 1 : 0;
      const auto rows = parts_->connection.run(statements::kReadEdits, found->id, last, kEditsInOneRead,
                                               as_bigint(most_bytes - bytes), always);
      if (!rows) return tl::unexpected(rows.error());
      for (int i = 0; i < rows->count(); ++i) {
        entries.push_back({.sequence = rows->natural(i, 0),
                           .author = std::uint32_t(rows->natural(i, 1)),
                           .number = rows->natural(i, 2),
                           .at = rows->integer(i, 3),
                           .edit = rows->bytes(i, 4)});
        bytes += entries.back().edit.size();
        if (const auto whole = demand_sum(design, entries.back(), rows->integer(i, 5)); !whole)
          return tl::unexpected(whole.error());
      }
      if (rows->count() < kEditsInOneRead) break;
      last = entries.back().sequence;
    }
    return entries;
  });
}

base::Result<std::optional<Snapshot>> PostgresOpLog::snapshot(const std::string& design) {
  return parts_->connection.transact(kBeginLook, [&]() -> base::Result<std::optional<Snapshot>> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    parts_->connection.queue(statements::kTakeTime);
    const auto rows = parts_->connection.run(statements::kReadSnapshot, found->id);
    if (!rows) return tl::unexpected(rows.error());
    if (rows->count() == 0) return std::nullopt;
    Snapshot snapshot{rows->natural(0, 0), rows->bytes(0, 1)};
    if (const auto whole = demand_sum(design, snapshot, rows->integer(0, 2)); !whole)
      return tl::unexpected(whole.error());
    return snapshot;
  });
}

base::Result<void> PostgresOpLog::save_snapshot(const std::string& design, std::uint64_t fence,
                                                const Snapshot& snapshot, std::uint64_t keep_after) {
  if (snapshot.bytes.size() > kMostSnapshotBytes)
    return base::fail(
        fmt::format("{}: what should be saved is larger than a store can keep ({} MiB). Make it smaller.",
                    base::shown_text(design), kMostSnapshotBytes >> 20U));
  PostgresConnection& connection = parts_->connection;
  return connection.transact(kBeginChange, [&]() -> base::Result<void> {
    auto found = parts_->lock(design);
    if (!found) return tl::unexpected(found.error());
    DesignState& state = found->state;
    const auto savable = demand_savable(state, design, fence, snapshot, keep_after);
    if (!savable) return savable;
    const auto behind = connection.run(statements::kBytesBehind, found->id, snapshot.sequence);
    if (!behind) return tl::unexpected(behind.error());
    count_snapshot(state, snapshot, keep_after, behind->natural(0, 0));
    connection.queue(statements::kWriteSnapshot, found->id, snapshot.sequence, snapshot.bytes,
                     std::int64_t{sum_of(snapshot)});
    connection.queue(statements::kForgetEdits, found->id, state.kept_after);
    connection.queue(statements::kUpdateSnapshot, found->id, state.kept_after, state.snapshot_sequence,
                     state.bytes);
    return {};
  });
}

base::Result<AuthorRow> PostgresOpLog::author(const std::string& design, const std::string& key,
                                              const std::string& name) {
  return parts_->connection.transact(kBeginChange, [&]() -> base::Result<AuthorRow> {
    const auto found = parts_->lock(design);
    if (!found) return tl::unexpected(found.error());
    auto rows = parts_->connection.run(statements::kFindAuthor, found->id, key);
    if (rows && rows->count() == 0) rows = parts_->connection.run(statements::kInsertAuthor, found->id, key);
    if (!rows) return tl::unexpected(rows.error());
    const AuthorRow author{std::uint32_t(rows->natural(0, 0)), rows->natural(0, 1)};
    if (!name.empty())
      parts_->connection.queue(statements::kNameAuthor, found->id, std::int64_t{author.author}, name);
    return author;
  });
}

base::Result<AuthorNames> PostgresOpLog::author_names(const std::string& design) {
  return parts_->connection.transact(kBeginLook, [&]() -> base::Result<AuthorNames> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    const auto rows = parts_->connection.run(statements::kAllNames, found->id);
    if (!rows) return tl::unexpected(rows.error());
    AuthorNames names;
    for (int i = 0; i < rows->count(); ++i) names[std::uint32_t(rows->natural(i, 0))] = rows->bytes(i, 1);
    return names;
  });
}

base::Result<void> PostgresOpLog::revoke(const std::string& invitation) {
  return parts_->connection.transact(kBeginChange, [&]() -> base::Result<void> {
    parts_->connection.queue(statements::kLockRevoked);
    return without_rows(parts_->connection.run(statements::kInsertRevoked, invitation));
  });
}

base::Result<std::vector<std::string>> PostgresOpLog::revoked() {
  return parts_->connection.connected([&]() -> base::Result<std::vector<std::string>> {
    const auto rows = parts_->connection.run(statements::kAllRevoked);
    if (!rows) return tl::unexpected(rows.error());
    std::vector<std::string> invitations;
    for (int i = 0; i < rows->count(); ++i) invitations.push_back(rows->bytes(i, 0));
    return invitations;
  });
}

base::Result<std::uint64_t> PostgresOpLog::revoked_version() {
  return parts_->connection.connected([&]() -> base::Result<std::uint64_t> {
    const auto rows = parts_->connection.run(statements::kLastRevoked);
    if (!rows) return tl::unexpected(rows.error());
    return rows->natural(0, 0);
  });
}

base::Result<std::string> PostgresOpLog::note_once(const std::string& name, const std::string& bytes) {
  return parts_->connection.transact(kBeginChange, [&]() -> base::Result<std::string> {
    parts_->connection.queue(statements::kInsertNote, name, bytes);
    const auto rows = parts_->connection.run(statements::kReadNote, name);
    if (!rows) return tl::unexpected(rows.error());
    return rows->count() == 1 ? rows->bytes(0, 0) : std::string();
  });
}

base::Result<void> PostgresOpLog::write_note(const std::string& name, const std::string& bytes) {
  return parts_->connection.connected(
      [&] { return without_rows(parts_->connection.run(statements::kWriteNote, name, bytes)); });
}

base::Result<std::optional<std::string>> PostgresOpLog::note(const std::string& name) {
  return parts_->connection.connected([&]() -> base::Result<std::optional<std::string>> {
    const auto rows = parts_->connection.run(statements::kReadNote, name);
    if (!rows) return tl::unexpected(rows.error());
    return rows->count() == 1 ? std::optional(rows->bytes(0, 0)) : std::nullopt;
  });
}

}  // namespace icome::collab
