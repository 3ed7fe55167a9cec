#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "base/result.h"

namespace icome::collab {

// What an administrator does with the database of a store, while a server uses it or not.

/// What is wrong with a store's database, or a backup of one, a sentence each; nothing if all is well: the
/// file itself, the sequences of edits without gaps from the snapshot on, that what is written twice agrees,
/// and the sums of edits and snapshots. Fails for a file that cannot be read as a store at all.
base::Result<std::vector<std::string>> check_store(const std::filesystem::path& database);

/// Copies the state of this moment into one file, which only its owner can read and which is there whole or
/// not at all. Fails where `to` exists, unless it may be replaced and is a file, and no part of the store.
base::Result<void> backup_store(const std::filesystem::path& database, const std::filesystem::path& to,
                                bool may_replace);

/// The store that was there before a backup was restored, as it is now.
struct RestoredStore {
  std::filesystem::path former = {};  // its database, under another name; empty: there was none
  bool keeps_revoked = false;         // the links that it revoked stay so
};

/// Checks a backup and puts a copy of it in the place of a store's database, at once; a database that was
/// there is kept under another name, and links that it revoked let nobody in. Leases end, and every design
/// begins another history (DesignRow::history). Fails, changing nothing, where the backup has faults or
/// somebody uses the store. Precondition: the caller has locked the folder of the store, so that no server
/// begins meanwhile.
base::Result<RestoredStore> restore_store(const std::filesystem::path& backup,
                                          const std::filesystem::path& database);

}  // namespace icome::collab
