#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "collab/storage/op_log.h"

namespace icome::collab {

/// What a store knows of a design besides its edits. The rules by which it changes are the functions below,
/// the same wherever a store keeps it.
struct DesignState {
  std::uint64_t history = 0;
  std::uint64_t sequence = 0;           // of the last edit
  std::uint64_t kept_after = 0;         // edits behind this one are kept, the others forgotten
  std::uint64_t snapshot_sequence = 0;  // 0: no snapshot
  std::uint64_t bytes = 0;              // of the snapshot and the edits behind it
  std::uint64_t fence = 0;              // of the newest lease; 0: none yet
  std::string holder = {};              // of the newest lease; empty: nobody, or it was given back
  std::int64_t lease_ends = 0;          // ms since 1970
  std::int64_t lease_length = 0;        // ms for which it was taken
};

/// No edit and no key is longer: a database would refuse it, and with it the batches of others.
inline constexpr std::uint64_t kMostEntryBytes = 256ULL << 20U;

/// The system's time, ms since 1970 (UTC).
std::int64_t wall_milliseconds();

DesignRow row_of(const std::string& design, const DesignState& state);

base::Error no_such_design(const std::string& design);
base::Error design_exists(const std::string& design);

/// Changes the lease as OpLog::lease says, at the time `now` (ms since 1970).
base::Result<DesignLease> take_lease(DesignState& state, const std::string& design, const std::string& holder,
                                     std::int64_t now, std::int64_t milliseconds);
/// Changes the lease as OpLog::release says. Gives false where nothing changed.
bool give_lease_back(DesignState& state, const std::string& holder);

/// The reason why a batch cannot be appended to a design in this state; nothing if it can.
std::optional<AppendError> why_not_appended(const DesignState& state, const Append& append);
/// Goes on to the state after the batch, which can be appended.
void count_appended(DesignState& state, const Append& append);

/// Fails where edits behind `after` are forgotten.
base::Result<void> demand_kept(const DesignState& state, const std::string& design, std::uint64_t after);

/// Fails where OpLog::save_snapshot does.
base::Result<void> demand_savable(const DesignState& state, const std::string& design, std::uint64_t fence,
                                  const Snapshot& snapshot, std::uint64_t keep_after);
/// Goes on to the state with that snapshot; `bytes_behind` are those of the edits behind it.
void count_snapshot(DesignState& state, const Snapshot& snapshot, std::uint64_t keep_after,
                    std::uint64_t bytes_behind);

}  // namespace icome::collab
