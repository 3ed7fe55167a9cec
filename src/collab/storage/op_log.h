#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/result.h"

namespace icome::collab {

/// One edit of a design as the server ordered it.
struct LogEntry {
  std::uint64_t sequence = 0;  // from 1, without gaps
  std::uint32_t author = 0;    // who made it; OpLog::author gives these numbers
  std::uint64_t number = 0;  // the author's own count of what it has sent, rising, < 2^63; 0: nobody counted
  std::int64_t at = 0;       // ms since 1970 (UTC)
  std::string edit = {};     // world::to_bytes

  bool operator==(const LogEntry&) const = default;
};

/// A design in a store.
struct DesignRow {
  std::string name;
  std::uint64_t sequence = 0;           // of its last edit; 0: none yet
  std::uint64_t snapshot_sequence = 0;  // of its newest snapshot; 0: none
  std::uint64_t kept_after = 0;         // edits up to this one are not kept any more
  std::uint64_t bytes = 0;              // of its snapshot and the edits behind it
  /// A number that another history of the design does not have: it is made anew when a store is restored from
  /// a backup, and when a design is created under a name that was used before. What somebody knows of the
  /// design under another number, sequences above all, says nothing about this one.
  std::uint64_t history = 0;
  std::string holder = {};      // who took its lease last; empty: nobody, or it was given back
  std::int64_t lease_ends = 0;  // of that lease, ms since 1970
};

/// The world of a design after the edit `sequence`, as bytes of whoever saved it.
struct Snapshot {
  std::uint64_t sequence = 0;  // from 1: before the first edit every world is empty
  std::string bytes = {};
};

/// The right to append to a design, which one server has at a time.
struct DesignLease {
  std::uint64_t fence = 0;  // higher for each new holder: older ones can append nothing any more
};

/// One append of many that are committed together.
struct Append {
  std::string design;
  std::uint64_t expected_sequence = 0;  // of the design's last edit before these
  std::uint64_t fence = 0;              // of the lease that the writer has
  std::vector<LogEntry> batch = {};     // sequences from expected_sequence + 1, without gaps
};

/// A person's copy of a program, known by a key of its own making, as an author of one design.
struct AuthorRow {
  std::uint32_t author = 0;       // above 0, never given twice in a design
  std::uint64_t last_number = 0;  // of the author's last edit in the log; 0: none
};

using AuthorNames = std::map<std::uint32_t, std::string>;

/// The reason why a batch was not appended. Malformed: its sequences have gaps, or something in it is larger
/// than a log takes. Store: the disk or the database failed, and none of the batches of the call is there;
/// where the connection to a database was lost during the commit, all of them may be.
enum class AppendProblem { Fenced, WrongSequence, NoDesign, Malformed, Store };
struct AppendError {
  AppendProblem problem = AppendProblem::Store;
  std::string message = {};  // a sentence
};

/// The durable memory of a server: the ordered edits of designs, snapshots that bound how many must be read,
/// and who may come in. What a call returned from survives a loss of power. Calls block for as long as the
/// disk or the database takes; one thread at a time uses an object, several processes may use a store.
class OpLog {
 public:
  virtual ~OpLog() = default;

  /// All designs, by name.
  virtual base::Result<std::vector<DesignRow>> designs() = 0;
  /// Nothing where there is no such design.
  virtual base::Result<std::optional<DesignRow>> find(const std::string& design) = 0;
  /// An empty design. Fails where there is one of that name.
  virtual base::Result<void> create(const std::string& design) = 0;

  /// Takes the lease of a design for `milliseconds` (> 0) from now, or makes the holder's own longer, which
  /// keeps its fence, also after its end where nobody else took it. Fails while another holder has it: find()
  /// tells who. `holder` (not empty) names one run of one server.
  virtual base::Result<DesignLease> lease(const std::string& design, const std::string& holder,
                                          std::int64_t milliseconds) = 0;
  /// Gives the lease back: its fence is old from now on. Nothing happens where `holder` does not have it.
  virtual base::Result<void> release(const std::string& design, const std::string& holder) = 0;

  /// Appends all batches in one commit (group commit). Each batch is appended whole or not at all, whatever
  /// becomes of the others (but for Store): the result has one entry for each. Batches of one design count
  /// one after the other. Fenced: the fence is not that of the newest lease, or that was given back.
  /// WrongSequence: the design's last edit is another one.
  virtual std::vector<std::optional<AppendError>> append(std::span<const Append> batches) = 0;

  /// The edits behind `after`, in order, at least one where there is one and then so many that their bytes
  /// stay within `most_bytes`; none where `after` is the last one or above it. Fails where edits behind
  /// `after` are not kept any more: a snapshot stands for them.
  virtual base::Result<std::vector<LogEntry>> read_from(const std::string& design, std::uint64_t after,
                                                        std::uint64_t most_bytes) = 0;

  /// The newest snapshot; nothing before the first.
  virtual base::Result<std::optional<Snapshot>> snapshot(const std::string& design) = 0;
  /// Saves a snapshot, and forgets older ones and the edits up to `keep_after` (<= its sequence) once it is
  /// durable. Fails, changing nothing, for an older fence, for a sequence that the design has not reached,
  /// and where there is a newer snapshot.
  virtual base::Result<void> save_snapshot(const std::string& design, std::uint64_t fence,
                                           const Snapshot& snapshot, std::uint64_t keep_after) = 0;

  /// The author of a design with this key (any bytes), a new one where there is none. Notes by which name
  /// (UTF-8 without NUL) the person goes now; an empty one changes nothing.
  virtual base::Result<AuthorRow> author(const std::string& design, const std::string& key,
                                         const std::string& name) = 0;
  /// The names that were noted last, by author; who never had one is not among them.
  virtual base::Result<AuthorNames> author_names(const std::string& design) = 0;

  /// Ends an invitation, by its id, for ever. Nothing happens where that was done before.
  virtual base::Result<void> revoke(const std::string& invitation) = 0;
  /// All that were ended, in that order.
  virtual base::Result<std::vector<std::string>> revoked() = 0;
  /// A number that changes whenever anybody revokes, in this process or another; costs microseconds to ask,
  /// or one way to a database and back.
  virtual base::Result<std::uint64_t> revoked_version() = 0;
};

}  // namespace icome::collab
