#include "collab/storage/store_care.h"

#include <fmt/format.h>
#include <sqlite3.h>
#include <unistd.h>

#include "base/shown_text.h"
#include "collab/protocol/address.h"
#include "collab/storage/log_sums.h"
#include "collab/storage/sqlite_schema.h"
#include "io/open_file.h"

namespace icome::collab {
namespace {

namespace fs = std::filesystem;

/// A rule that a store keeps: the query gives the name of each design that breaks it, and a number.
struct StoreRule {
  const char* broken_by;
  const char* finding;
};

constexpr StoreRule kStoreRules[] = {
    {"SELECT name, count(edits.sequence) FROM designs LEFT JOIN edits ON edits.design = id GROUP BY id "
     "HAVING count(edits.sequence) <> designs.sequence - kept_after OR min(edits.sequence) <> kept_after + 1 "
     "OR "
     "max(edits.sequence) <> designs.sequence",
     "{}: edits are missing or too many; {} are there."},
    {"SELECT name, kept_after FROM designs WHERE kept_after > snapshot_sequence OR snapshot_sequence > "
     "sequence",
     "{}: the edits up to {} are gone, and no snapshot stands for them."},
    {"SELECT name, snapshot_sequence FROM designs LEFT JOIN snapshots ON design = id "
     "WHERE coalesce(snapshots.sequence, 0) <> snapshot_sequence",
     "{}: the snapshot of {} is not there."},
    {"SELECT name, bytes FROM designs WHERE bytes <> (SELECT coalesce(sum(length(edit)), 0) FROM edits WHERE "
     "design = id AND sequence > snapshot_sequence) + (SELECT coalesce(sum(length(snapshots.bytes)), 0) FROM "
     "snapshots WHERE design = id)",
     "{}: has another size than the {} bytes that were counted."},
    {"SELECT designs.name, author FROM authors JOIN designs ON id = design WHERE last_number < (SELECT "
     "coalesce(max(number), 0) FROM edits WHERE edits.design = authors.design AND edits.author = "
     "authors.author)",
     "{}: an edit of author {} is newer than what was noted for that author."},
};

base::Result<void> add_findings_of_file(const SqliteDatabase& database, std::vector<std::string>& findings) {
  auto statement = database.prepare("PRAGMA integrity_check(20)");
  if (!statement) return tl::unexpected(statement.error());
  SqliteRun run = statement->run();
  auto more = run.next();
  for (; more && *more; more = run.next()) {
    const std::string found = run.bytes(0);
    if (found != "ok") findings.push_back("The file is damaged: " + found);
  }
  if (!more) return tl::unexpected(more.error());
  const auto strays = database.number("SELECT count(*) FROM pragma_foreign_key_check");
  if (!strays) return tl::unexpected(strays.error());
  if (*strays > 0) findings.push_back(fmt::format("{} rows belong to no design.", *strays));
  return {};
}

/// Tables that are missing, and what else is there than tables, such as triggers, which would change things
/// unasked.
base::Result<void> add_findings_of_schema(const SqliteDatabase& database,
                                          std::vector<std::string>& findings) {
  for (const char* table : {"designs", "edits", "snapshots", "authors", "revoked"}) {
    const auto count = database.number(
        fmt::format("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = '{}'", table)
            .c_str());
    if (!count) return tl::unexpected(count.error());
    if (*count == 0) findings.push_back(fmt::format("The table \"{}\" is missing.", table));
  }
  const auto others = database.number("SELECT count(*) FROM sqlite_schema WHERE type IN ('trigger', 'view')");
  if (!others) return tl::unexpected(others.error());
  if (*others > 0)
    findings.push_back(fmt::format("{} triggers or views are there that icome has not made.", *others));
  return {};
}

base::Result<void> add_findings_of_names(const SqliteDatabase& database, std::vector<std::string>& findings) {
  auto names = database.prepare("SELECT name FROM designs ORDER BY name");
  if (!names) return tl::unexpected(names.error());
  SqliteRun run = names->run();
  auto more = run.next();
  for (; more && *more; more = run.next())
    if (const auto good = check_design_name(run.bytes(0)); !good)
      findings.push_back("A design cannot be opened by its name: " + good.error().message);
  if (!more) return tl::unexpected(more.error());
  return {};
}

base::Result<void> add_findings_of_rule(const SqliteDatabase& database, const StoreRule& rule,
                                        std::vector<std::string>& findings) {
  auto statement = database.prepare(rule.broken_by);
  if (!statement) return tl::unexpected(statement.error());
  SqliteRun run = statement->run();
  auto more = run.next();
  for (; more && *more; more = run.next())
    findings.push_back(
        fmt::format(fmt::runtime(rule.finding), base::shown_text(run.bytes(0)), run.integer(1)));
  if (!more) return tl::unexpected(more.error());
  return {};
}

/// The rows whose sums do not fit them; of many, the first ones.
class DamagedRows {
 public:
  explicit DamagedRows(std::vector<std::string>& findings) : findings_(findings) {}
  void add(const base::Result<void>& fits) {
    if (fits || ++count_ > kMostTold) return;
    findings_.push_back(fits.error().message);
  }
  void close() {
    if (count_ > kMostTold) findings_.push_back(fmt::format("{} more are damaged.", count_ - kMostTold));
  }

 private:
  static constexpr std::size_t kMostTold = 20;
  std::vector<std::string>& findings_;
  std::size_t count_ = 0;
};

base::Result<void> add_findings_of_sums(const SqliteDatabase& database, std::vector<std::string>& findings) {
  const auto has = has_sums(database);
  if (!has) return tl::unexpected(has.error());
  if (!*has) return {};
  auto edits = database.prepare(
      "SELECT name, edits.sequence, author, number, at, edit, coalesce(sum, -1) FROM edits JOIN designs ON "
      "id = design ORDER BY design, edits.sequence");
  if (!edits) return tl::unexpected(edits.error());
  auto snapshots = database.prepare(
      "SELECT name, snapshots.sequence, snapshots.bytes, coalesce(sum, -1) FROM snapshots JOIN designs ON id "
      "= "
      "design");
  if (!snapshots) return tl::unexpected(snapshots.error());
  DamagedRows damaged(findings);
  SqliteRun edit = edits->run();
  auto more = edit.next();
  for (; more && *more; more = edit.next()) {
    const LogEntry entry{.sequence = edit.natural(1),
                         .author = std::uint32_t(edit.natural(2)),
                         .number = edit.natural(3),
                         .at = edit.integer(4),
                         .edit = edit.bytes(5)};
    damaged.add(demand_sum(edit.bytes(0), entry, edit.integer(6)));
  }
  if (!more) return tl::unexpected(more.error());
  SqliteRun snapshot = snapshots->run();
  for (more = snapshot.next(); more && *more; more = snapshot.next())
    damaged.add(
        demand_sum(snapshot.bytes(0), Snapshot{snapshot.natural(1), snapshot.bytes(2)}, snapshot.integer(3)));
  if (!more) return tl::unexpected(more.error());
  damaged.close();
  return {};
}

fs::path with_ending(const fs::path& path, std::string_view ending) {
  fs::path result = path;
  result += ending;
  return result;
}

/// A copy of a database that is written beside its path, with a name that io::NewFile knows. Removes what is
/// left of it.
class CopyBeside {
 public:
  explicit CopyBeside(const fs::path& path)
      : path_(path), beside_(with_ending(path, fmt::format(".part-{}", ::getpid()))) {
    remove();
  }
  CopyBeside(const CopyBeside&) = delete;
  CopyBeside& operator=(const CopyBeside&) = delete;
  ~CopyBeside() { remove(); }

  /// Copies a store, and runs `change` on the copy before it gets its last form: one file, without a log of
  /// writes.
  base::Result<void> make(const fs::path& from, const char* change);
  /// Links of these invitations let nobody in by the copy.
  base::Result<void> revoke(const std::vector<std::string>& invitations);
  /// Gives the copy the name of what it is a copy for.
  base::Result<void> take_place();

 private:
  void remove() const {
    std::error_code ignored;
    for (const char* ending : {"", "-wal", "-shm", "-journal"})
      fs::remove(with_ending(beside_, ending), ignored);
  }
  fs::path path_;
  fs::path beside_;
};

base::Result<void> copy_pages(const SqliteDatabase& from, const SqliteDatabase& to) {
  sqlite3_backup* const copying = sqlite3_backup_init(to.handle(), "main", from.handle(), "main");
  if (copying == nullptr) return tl::unexpected(sqlite_error(sqlite3_errcode(to.handle()), to.path()));
  const int code = sqlite3_backup_step(copying, -1);  // all in one go, so that it is the state of one moment
  sqlite3_backup_finish(copying);
  if (code == SQLITE_DONE) return {};
  const bool is_source = sqlite3_errcode(from.handle()) == code;
  return tl::unexpected(sqlite_error(code, is_source ? from.path() : to.path()));
}

base::Result<void> CopyBeside::make(const fs::path& from, const char* change) {
  const auto source = SqliteDatabase::open(from, SqliteDatabase::Use::Change);
  if (!source) return tl::unexpected(source.error());
  if (const auto good = demand_store(*source); !good) return good;
  {
    const auto copy = SqliteDatabase::open(beside_, SqliteDatabase::Use::ChangeOrCreate);
    if (!copy) return tl::unexpected(copy.error());
    if (const auto copied = copy_pages(*source, *copy); !copied) return copied;
    const auto mode = copy->text("PRAGMA journal_mode = DELETE");
    if (!mode) return tl::unexpected(mode.error());
    if (const auto changed = copy->execute(change); !changed) return changed;
  }
  const auto file = io::OpenFile::open(beside_, io::OpenFile::Use::Change);
  if (!file) return tl::unexpected(file.error());
  return file->sync();
}

base::Result<void> CopyBeside::revoke(const std::vector<std::string>& invitations) {
  const auto copy = SqliteDatabase::open(beside_, SqliteDatabase::Use::Change);
  if (!copy) return tl::unexpected(copy.error());
  return copy->transact("BEGIN IMMEDIATE", [&]() -> base::Result<void> {
    auto insert = copy->prepare("INSERT OR IGNORE INTO revoked (invitation) VALUES (?)");
    if (!insert) return tl::unexpected(insert.error());
    for (const std::string& invitation : invitations)
      if (const auto done = insert->run(invitation).finish(); !done) return done;
    return {};
  });
}

base::Result<void> CopyBeside::take_place() {
  std::error_code error;
  fs::rename(beside_, path_, error);
  if (error) return base::fail(fmt::format("{}: cannot be written ({}).", path_.string(), error.message()));
  io::sync_folder_of(path_);
  return {};
}

/// A name for a database that gives its place to another one.
fs::path free_name_beside(const fs::path& database) {
  std::error_code error;
  for (int i = 1;; ++i) {
    fs::path name = with_ending(database, i == 1 ? ".before-restore" : fmt::format(".before-restore-{}", i));
    if (!fs::exists(name, error)) return name;
  }
}

/// Brings all of a database into its one file; fails where somebody uses it. A damaged one stays as it is.
base::Result<void> fold_unless_damaged(const fs::path& path) {
  const auto database = SqliteDatabase::open(path, SqliteDatabase::Use::Change);
  if (!database) return {};
  // Closing would bring the log of writes into the file, or drop it, also where both are damaged.
  sqlite3_db_config(database->handle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  const auto good = demand_store(*database);
  const auto mode = good ? database->text("PRAGMA journal_mode = DELETE") : base::Result<std::string>();
  const bool is_busy = (sqlite3_errcode(database->handle()) & 0xff) == SQLITE_BUSY;
  if (is_busy || (mode && *mode == "wal"))
    return base::fail(path.string() +
                      ": somebody uses this store. End the server and what else uses it, then try again.");
  return {};
}

/// The invitations that a store has revoked; fails where there is none that can be read.
base::Result<std::vector<std::string>> revoked_in(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return base::fail(path.string() + ": is not there.");
  const auto database = SqliteDatabase::open(path, SqliteDatabase::Use::Change);
  if (!database) return tl::unexpected(database.error());
  // Closing would bring the log of writes into the file, or drop it, also where both are damaged.
  sqlite3_db_config(database->handle(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  if (const auto good = demand_store(*database); !good) return tl::unexpected(good.error());
  auto all = database->prepare("SELECT invitation FROM revoked ORDER BY number");
  if (!all) return tl::unexpected(all.error());
  std::vector<std::string> revoked;
  SqliteRun run = all->run();
  auto more = run.next();
  for (; more && *more; more = run.next()) revoked.push_back(run.bytes(0));
  if (!more) return tl::unexpected(more.error());
  return revoked;
}

/// Gives a database another name, besides its own, so that there is one at its place at any time.
base::Result<fs::path> keep_former(const fs::path& database) {
  std::error_code error;
  if (!fs::exists(database, error)) return fs::path();
  if (const auto folded = fold_unless_damaged(database); !folded) return tl::unexpected(folded.error());
  fs::path kept = free_name_beside(database);
  fs::create_hard_link(database, kept, error);
  // Only a damaged database still has a log of writes, which would be taken for the new one's.
  const fs::path writes = with_ending(database, "-wal");
  if (!error && fs::exists(writes, error)) fs::rename(writes, with_ending(kept, "-wal"), error);
  if (error)
    return base::fail(fmt::format("{}: what was there before cannot be kept ({}), so nothing was restored.",
                                  kept.string(), error.message()));
  fs::remove(with_ending(database, "-shm"), error);
  return kept;
}

}  // namespace

base::Result<std::vector<std::string>> check_store(const fs::path& path) {
  const auto database = SqliteDatabase::open(path, SqliteDatabase::Use::Change);
  if (!database) return tl::unexpected(database.error());
  std::vector<std::string> findings;
  if (const auto good = demand_store(*database); !good) {
    if ((sqlite3_errcode(database->handle()) & 0xff) != SQLITE_CORRUPT) return tl::unexpected(good.error());
    findings.push_back(good.error().message);
    return findings;
  }
  const auto checked = database->transact("BEGIN", [&]() -> base::Result<void> {
    if (const auto file = add_findings_of_file(*database, findings); !file) return file;
    const std::size_t so_far = findings.size();
    if (const auto schema = add_findings_of_schema(*database, findings); !schema || findings.size() > so_far)
      return schema;  // without its tables nothing else can be asked
    if (const auto names = add_findings_of_names(*database, findings); !names) return names;
    for (const StoreRule& rule : kStoreRules)
      if (const auto kept = add_findings_of_rule(*database, rule, findings); !kept) return kept;
    return add_findings_of_sums(*database, findings);
  });
  if (!checked) findings.push_back(checked.error().message);  // damaged such that the check could not go on
  return findings;
}

base::Result<void> backup_store(const fs::path& database, const fs::path& to, bool may_replace) {
  std::error_code error;
  const fs::file_type there = fs::symlink_status(to, error).type();
  if (there != fs::file_type::not_found && there != fs::file_type::regular)
    return base::fail(to.string() + ": is no ordinary file. Choose another name.");
  for (const char* ending : {"", "-wal", "-shm"})
    if (fs::equivalent(to, with_ending(database, ending), error))
      return base::fail(to.string() + ": is a part of the store itself. Choose another name.");
  if (!may_replace && fs::exists(to, error))
    return base::fail(to.string() +
                      ": is there already. Choose another name, or have it replaced (--force).");
  CopyBeside copy(to);
  const auto made = copy.make(database, "");
  return made ? copy.take_place() : made;
}

base::Result<RestoredStore> restore_store(const fs::path& backup, const fs::path& database) {
  const auto findings = check_store(backup);
  if (!findings) return tl::unexpected(findings.error());
  if (!findings->empty())
    return base::fail(fmt::format("{}: this backup has faults, so nothing was restored. {}", backup.string(),
                                  findings->front()));
  CopyBeside copy(database);
  const auto made = copy.make(backup,
                              "UPDATE designs SET holder = '', lease_ends = 0, lease_length = 0, history = "
                              "max(1, abs(random() >> 1))");
  if (!made) return tl::unexpected(made.error());
  RestoredStore restored;
  if (const auto revoked = revoked_in(database)) {
    if (const auto added = copy.revoke(*revoked); !added) return tl::unexpected(added.error());
    restored.keeps_revoked = true;
  }
  auto former = keep_former(database);
  if (!former) return tl::unexpected(former.error());
  restored.former = std::move(*former);
  if (const auto placed = copy.take_place(); !placed) return tl::unexpected(placed.error());
  return restored;
}

}  // namespace icome::collab
