#pragma once
#include "collab/storage/sqlite_database.h"

namespace icome::collab {

/// Fails, naming the file, where it is no store that this version reads: another program's, a newer one, or
/// damaged.
base::Result<void> demand_store(const SqliteDatabase& database);

/// Are there sums beside edits and snapshots? A store of version 1 that nobody has served since has none.
base::Result<bool> has_sums(const SqliteDatabase& database);

/// Makes an empty file a store, or an older store one of this version, in the mode in which a commit needs
/// one write to the disk (WAL); fails as demand_store() does for what is another program's. Several processes
/// may do so at once.
base::Result<void> make_store(const SqliteDatabase& database);

}  // namespace icome::collab
