#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "files/remark.h"
#include "world/edit/edit_bytes.h"

namespace icome::files {

// A journal (.icome, ICOME's own format of a design): the world as it once was and every edit since, in a
// form that is only ever added to, so that a crash at any moment loses nothing that was there before.
// journal_format.h tells the bytes, journaled_world.h works with one.

/// What a journal gave and what could not be had of it.
struct JournalReport {
  std::uint64_t bytes = 0;           // of the file
  std::uint64_t snapshot_bytes = 0;  // that make the world as it once was
  std::uint64_t edit_bytes = 0;      // of the edits since
  std::uint64_t edits = 0;           // done again since the snapshot
  std::uint64_t damaged_from = 0;    // where the first damage begins; the size of a whole file
  std::uint64_t lost_bytes = 0;      // that are damaged, or of edits that could not be done
  std::uint64_t lost_edits = 0;      // whole ones that could not be done, as what they build on is lost
  bool is_torn = false;              // all that is lost is the last edit, cut off as the program stopped
  /// A copy of all from the first damage on; empty where nothing was lost or the file was only read.
  std::filesystem::path set_aside = {};
  std::vector<Remark> damage = {};  // what is wrong and what was done about it; none for a whole journal
};

/// Called now and then with the part that is done, in [0, 1]; false stops.
using JournalProgress = std::function<bool(double part)>;

struct ReadJournal {
  world::World world;
  JournalReport report;
};

/// Reads a journal and changes nothing on disk; of a damaged one the world is made of all that is whole
/// before and behind the damage. Whatever the bytes are, memory stays in proportion to their number. Fails
/// for what is no journal, for one that a newer version wrote, where the disk fails, and when it is stopped.
/// One that another program works with can be read.
base::Result<ReadJournal> read_journal(const std::filesystem::path& path,
                                       const world::GeometryFactory& factory,
                                       const JournalProgress& progress = {});

/// Is every record of it there and undamaged? What is not a journal at all is not whole. Reads all its bytes,
/// and makes nothing of them. Fails where the disk does.
base::Result<bool> is_whole_journal(const std::filesystem::path& path);

/// Writes a world as a fresh journal in place of what was there, which stays if not all can be written: a
/// shape may be of a kind that cannot. Fails while somebody works with the journal.
base::Result<void> write_journal(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files
