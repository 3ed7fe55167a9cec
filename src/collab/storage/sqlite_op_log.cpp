#include "collab/storage/sqlite_op_log.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

#include "collab/storage/log_sums.h"
#include "collab/storage/sqlite_schema.h"

namespace icome::collab {
namespace {

constexpr const char* kChange = "BEGIN IMMEDIATE";
constexpr const char* kLook = "BEGIN";

// Order of the columns that state_in() reads.
#define ICOME_DESIGN_COLUMNS                                                                       \
  "id, name, history, sequence, kept_after, snapshot_sequence, bytes, fence, holder, lease_ends, " \
  "lease_length"

/// A row of `designs`.
struct StoredDesign {
  std::int64_t id = 0;
  std::string name = {};
  DesignState state = {};
};

StoredDesign stored_design(const SqliteRun& run) {
  return {.id = run.integer(0),
          .name = run.bytes(1),
          .state = {.history = run.natural(2),
                    .sequence = run.natural(3),
                    .kept_after = run.natural(4),
                    .snapshot_sequence = run.natural(5),
                    .bytes = run.natural(6),
                    .fence = run.natural(7),
                    .holder = run.bytes(8),
                    .lease_ends = run.integer(9),
                    .lease_length = run.integer(10)}};
}

/// A number that no other history of a design has, but by a chance of 1 in 2^63.
std::uint64_t random_history() {
  std::uint64_t bits = 0;
  sqlite3_randomness(sizeof bits, &bits);
  return std::max<std::uint64_t>(1, bits & std::uint64_t(std::numeric_limits<std::int64_t>::max()));
}

/// The designs and authors that one call to append() changes, each read once and written once.
struct AppendChanges {
  std::map<std::string, std::optional<StoredDesign>> designs = {};
  std::map<std::pair<std::int64_t, std::uint32_t>, std::uint64_t> last_numbers = {};  // by design and author
};

}  // namespace

struct SqliteOpLog::Parts {
  SqliteDatabase database;
  std::function<std::int64_t()> clock;

  SqliteStatement all_designs = {}, find_design = {}, insert_design = {}, update_design = {};
  SqliteStatement insert_edit = {}, read_edits = {}, bytes_behind = {}, forget_edits = {};
  SqliteStatement read_snapshot = {}, write_snapshot = {};
  SqliteStatement find_author = {}, insert_author = {}, count_author = {}, name_author = {}, all_names = {};
  SqliteStatement insert_revoked = {}, all_revoked = {}, last_revoked = {};

  base::Result<void> prepare();
  base::Result<std::optional<StoredDesign>> find(const std::string& name);
  base::Result<StoredDesign> demand(const std::string& name);
  /// Finds or makes the author with this key.
  base::Result<AuthorRow> author(std::int64_t design, const std::string& key);
  base::Result<void> update(const StoredDesign& design);

  base::Result<std::optional<AppendError>> append(const Append& append, AppendChanges& changes);
  base::Result<void> write(const AppendChanges& changes);
};

base::Result<void> SqliteOpLog::Parts::prepare() {
  const std::pair<SqliteStatement*, const char*> all[] = {
      {&all_designs, "SELECT " ICOME_DESIGN_COLUMNS " FROM designs ORDER BY name"},
      {&find_design, "SELECT " ICOME_DESIGN_COLUMNS " FROM designs WHERE name = ?"},
      {&insert_design, "INSERT INTO designs (name, history) VALUES (?, ?)"},
      {&update_design,
       "UPDATE designs SET sequence = ?2, kept_after = ?3, snapshot_sequence = ?4, bytes = ?5, fence = ?6, "
       "holder = ?7, lease_ends = ?8, lease_length = ?9 WHERE id = ?1"},
      {&insert_edit,
       "INSERT INTO edits (design, sequence, author, number, at, edit, sum) VALUES (?, ?, ?, ?, ?, ?, ?)"},
      {&read_edits,
       "SELECT sequence, author, number, at, edit, coalesce(sum, -1) FROM edits WHERE design = ? AND "
       "sequence > "
       "? ORDER BY sequence"},
      {&bytes_behind, "SELECT coalesce(sum(length(edit)), 0) FROM edits WHERE design = ? AND sequence > ?"},
      {&forget_edits, "DELETE FROM edits WHERE design = ? AND sequence <= ?"},
      {&read_snapshot, "SELECT sequence, bytes, coalesce(sum, -1) FROM snapshots WHERE design = ?"},
      {&write_snapshot,
       "INSERT OR REPLACE INTO snapshots (design, sequence, bytes, sum) VALUES (?, ?, ?, ?)"},
      {&find_author, "SELECT author, last_number FROM authors WHERE design = ? AND key = ?"},
      {&insert_author,
       "INSERT INTO authors (design, author, key) VALUES (?1, (SELECT coalesce(max(author), 0) + 1 FROM "
       "authors WHERE design = ?1), ?2) RETURNING author, last_number"},
      {&count_author,
       "UPDATE authors SET last_number = max(last_number, ?3) WHERE design = ?1 AND author = ?2"},
      {&name_author, "UPDATE authors SET name = ?3 WHERE design = ?1 AND author = ?2 AND name <> ?3"},
      {&all_names, "SELECT author, name FROM authors WHERE design = ? AND name <> ''"},
      {&insert_revoked, "INSERT OR IGNORE INTO revoked (invitation) VALUES (?)"},
      {&all_revoked, "SELECT invitation FROM revoked ORDER BY number"},
      {&last_revoked, "SELECT coalesce(max(number), 0) FROM revoked"},
  };
  for (const auto& [statement, sql] : all) {
    auto prepared = database.prepare(sql);
    if (!prepared) return tl::unexpected(prepared.error());
    *statement = std::move(*prepared);
  }
  return {};
}

base::Result<std::optional<StoredDesign>> SqliteOpLog::Parts::find(const std::string& name) {
  SqliteRun run = find_design.run(name);
  const auto row = run.next();
  if (!row) return tl::unexpected(row.error());
  return *row ? std::optional(stored_design(run)) : std::nullopt;
}

base::Result<StoredDesign> SqliteOpLog::Parts::demand(const std::string& name) {
  auto found = find(name);
  if (!found) return tl::unexpected(found.error());
  if (!*found) return tl::unexpected(no_such_design(name));
  return std::move(**found);
}

base::Result<void> SqliteOpLog::Parts::update(const StoredDesign& design) {
  const DesignState& it = design.state;
  return update_design
      .run(design.id, it.sequence, it.kept_after, it.snapshot_sequence, it.bytes, it.fence, it.holder,
           it.lease_ends, it.lease_length)
      .finish();
}

SqliteOpLog::SqliteOpLog(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
SqliteOpLog::SqliteOpLog(SqliteOpLog&&) noexcept = default;
SqliteOpLog::~SqliteOpLog() = default;

base::Result<SqliteOpLog> SqliteOpLog::open(const std::filesystem::path& path,
                                            std::function<std::int64_t()> clock) {
  auto database = SqliteDatabase::open(path, SqliteDatabase::Use::ChangeOrCreate);
  if (!database) return tl::unexpected(database.error());
  if (const auto made = make_store(*database); !made) return tl::unexpected(made.error());
  // The log of writes shrinks to the size limit when it begins anew, after a large snapshot for instance.
  const auto set = database->execute(
      "PRAGMA synchronous = FULL; PRAGMA foreign_keys = ON; PRAGMA cell_size_check = ON; PRAGMA "
      "trusted_schema = OFF; "
      "PRAGMA secure_delete = OFF; PRAGMA journal_size_limit = 67108864");
  if (!set) return tl::unexpected(set.error());
  auto parts = std::make_unique<Parts>(Parts{.database = std::move(*database), .clock = std::move(clock)});
  if (const auto prepared = parts->prepare(); !prepared) return tl::unexpected(prepared.error());
  return SqliteOpLog(std::move(parts));
}

base::Result<std::vector<DesignRow>> SqliteOpLog::designs() {
  std::vector<DesignRow> rows;
  SqliteRun run = parts_->all_designs.run();
  auto more = run.next();
  for (; more && *more; more = run.next()) {
    const StoredDesign design = stored_design(run);
    rows.push_back(row_of(design.name, design.state));
  }
  if (!more) return tl::unexpected(more.error());
  return rows;
}

base::Result<std::optional<DesignRow>> SqliteOpLog::find(const std::string& design) {
  const auto found = parts_->find(design);
  if (!found) return tl::unexpected(found.error());
  return *found ? std::optional(row_of(design, (*found)->state)) : std::nullopt;
}

base::Result<void> SqliteOpLog::create(const std::string& design) {
  return parts_->database.transact(kChange, [&]() -> base::Result<void> {
    const auto found = parts_->find(design);
    if (!found) return tl::unexpected(found.error());
    if (*found) return tl::unexpected(design_exists(design));
    return parts_->insert_design.run(design, random_history()).finish();
  });
}

base::Result<DesignLease> SqliteOpLog::lease(const std::string& design, const std::string& holder,
                                             std::int64_t milliseconds) {
  return parts_->database.transact(kChange, [&]() -> base::Result<DesignLease> {
    auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    const auto taken = take_lease(found->state, design, holder, parts_->clock(), milliseconds);
    if (!taken) return taken;
    if (const auto updated = parts_->update(*found); !updated) return tl::unexpected(updated.error());
    return taken;
  });
}

base::Result<void> SqliteOpLog::release(const std::string& design, const std::string& holder) {
  return parts_->database.transact(kChange, [&]() -> base::Result<void> {
    auto found = parts_->find(design);
    if (!found) return tl::unexpected(found.error());
    if (!*found || !give_lease_back((*found)->state, holder)) return {};
    return parts_->update(**found);
  });
}

std::vector<std::optional<AppendError>> SqliteOpLog::append(std::span<const Append> batches) {
  std::vector<std::optional<AppendError>> results;
  const auto done = parts_->database.transact(kChange, [&]() -> base::Result<void> {
    AppendChanges changes;
    for (const Append& it : batches) {
      auto result = parts_->append(it, changes);
      if (!result) return tl::unexpected(result.error());
      results.push_back(std::move(*result));
    }
    return parts_->write(changes);
  });
  results.resize(batches.size());
  if (done) return results;
  for (std::optional<AppendError>& it : results)
    if (!it) it = AppendError{AppendProblem::Store, done.error().message};
  return results;
}

base::Result<std::optional<AppendError>> SqliteOpLog::Parts::append(const Append& append,
                                                                    AppendChanges& changes) {
  const auto [it, is_new] = changes.designs.try_emplace(append.design);
  if (is_new) {
    auto found = find(append.design);
    if (!found) return tl::unexpected(found.error());
    it->second = std::move(*found);
  }
  std::optional<StoredDesign>& design = it->second;
  if (!design) return AppendError{AppendProblem::NoDesign, no_such_design(append.design).message};
  if (auto why = why_not_appended(design->state, append)) return why;
  count_appended(design->state, append);
  for (const LogEntry& entry : append.batch) {
    const auto inserted = insert_edit
                              .run(design->id, entry.sequence, entry.author, entry.number, entry.at,
                                   SqliteBlob{entry.edit}, sum_of(entry))
                              .finish();
    if (!inserted) return tl::unexpected(inserted.error());
    std::uint64_t& last = changes.last_numbers[{design->id, entry.author}];
    last = std::max(last, entry.number);
  }
  return std::nullopt;
}

base::Result<void> SqliteOpLog::Parts::write(const AppendChanges& changes) {
  for (const auto& [name, design] : changes.designs) {
    if (!design) continue;
    if (const auto updated = update(*design); !updated) return updated;
  }
  for (const auto& [author, number] : changes.last_numbers) {
    const auto counted = count_author.run(author.first, author.second, number).finish();
    if (!counted) return counted;
  }
  return {};
}

base::Result<std::vector<LogEntry>> SqliteOpLog::read_from(const std::string& design, std::uint64_t after,
                                                           std::uint64_t most_bytes) {
  return parts_->database.transact(kLook, [&]() -> base::Result<std::vector<LogEntry>> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    if (const auto kept = demand_kept(found->state, design, after); !kept)
      return tl::unexpected(kept.error());
    std::vector<LogEntry> entries;
    if (after >= found->state.sequence) return entries;
    std::uint64_t bytes = 0;
    SqliteRun run = parts_->read_edits.run(found->id, after);
    auto more = run.next();
    for (; more && *more; more = run.next()) {
      LogEntry entry{.sequence = run.natural(0),
                     .author = std::uint32_t(run.natural(1)),
                     .number = run.natural(2),
                     .at = run.integer(3),
                     .edit = run.bytes(4)};
      bytes += entry.edit.size();
      if (!entries.empty() && bytes > most_bytes) break;
      if (const auto whole = demand_sum(design, entry, run.integer(5)); !whole)
        return tl::unexpected(whole.error());
      entries.push_back(std::move(entry));
    }
    if (!more) return tl::unexpected(more.error());
    return entries;
  });
}

base::Result<std::optional<Snapshot>> SqliteOpLog::snapshot(const std::string& design) {
  return parts_->database.transact(kLook, [&]() -> base::Result<std::optional<Snapshot>> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    SqliteRun run = parts_->read_snapshot.run(found->id);
    const auto row = run.next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) return std::nullopt;
    Snapshot snapshot{run.natural(0), run.bytes(1)};
    if (const auto whole = demand_sum(design, snapshot, run.integer(2)); !whole)
      return tl::unexpected(whole.error());
    return snapshot;
  });
}

base::Result<void> SqliteOpLog::save_snapshot(const std::string& design, std::uint64_t fence,
                                              const Snapshot& snapshot, std::uint64_t keep_after) {
  return parts_->database.transact(kChange, [&]() -> base::Result<void> {
    auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    const auto savable = demand_savable(found->state, design, fence, snapshot, keep_after);
    if (!savable) return savable;
    SqliteRun behind = parts_->bytes_behind.run(found->id, snapshot.sequence);
    if (const auto row = behind.next(); !row) return tl::unexpected(row.error());
    count_snapshot(found->state, snapshot, keep_after, behind.natural(0));
    const auto written =
        parts_->write_snapshot.run(found->id, snapshot.sequence, SqliteBlob{snapshot.bytes}, sum_of(snapshot))
            .finish();
    if (!written) return written;
    const auto forgotten = parts_->forget_edits.run(found->id, found->state.kept_after).finish();
    if (!forgotten) return forgotten;
    return parts_->update(*found);
  });
}

base::Result<AuthorRow> SqliteOpLog::Parts::author(std::int64_t design, const std::string& key) {
  for (SqliteStatement* const statement : {&find_author, &insert_author}) {
    SqliteRun run = statement->run(design, SqliteBlob{key});
    const auto row = run.next();
    if (!row) return tl::unexpected(row.error());
    if (!*row) continue;
    const AuthorRow author{std::uint32_t(run.natural(0)), run.natural(1)};
    if (const auto finished = run.finish(); !finished) return tl::unexpected(finished.error());
    return author;
  }
  return tl::unexpected(sqlite_error(SQLITE_CORRUPT, database.path()));
}

base::Result<AuthorRow> SqliteOpLog::author(const std::string& design, const std::string& key,
                                            const std::string& name) {
  return parts_->database.transact(kChange, [&]() -> base::Result<AuthorRow> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    auto author = parts_->author(found->id, key);
    if (!author || name.empty()) return author;
    const auto named = parts_->name_author.run(found->id, author->author, name).finish();
    if (!named) return tl::unexpected(named.error());
    return author;
  });
}

base::Result<AuthorNames> SqliteOpLog::author_names(const std::string& design) {
  return parts_->database.transact(kLook, [&]() -> base::Result<AuthorNames> {
    const auto found = parts_->demand(design);
    if (!found) return tl::unexpected(found.error());
    AuthorNames names;
    SqliteRun run = parts_->all_names.run(found->id);
    auto more = run.next();
    for (; more && *more; more = run.next()) names[std::uint32_t(run.natural(0))] = run.bytes(1);
    if (!more) return tl::unexpected(more.error());
    return names;
  });
}

base::Result<void> SqliteOpLog::revoke(const std::string& invitation) {
  return parts_->insert_revoked.run(invitation).finish();
}

base::Result<std::vector<std::string>> SqliteOpLog::revoked() {
  std::vector<std::string> invitations;
  SqliteRun run = parts_->all_revoked.run();
  auto more = run.next();
  for (; more && *more; more = run.next()) invitations.push_back(run.bytes(0));
  if (!more) return tl::unexpected(more.error());
  return invitations;
}

base::Result<std::uint64_t> SqliteOpLog::revoked_version() {
  SqliteRun run = parts_->last_revoked.run();
  const auto row = run.next();
  if (!row) return tl::unexpected(row.error());
  return run.natural(0);
}

}  // namespace icome::collab
