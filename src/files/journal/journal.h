#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "files/remark.h"
#include "world/edit/edit_bytes.h"

namespace icome::files {

// A journal (.icome, ICOME's own format of a design): a snapshot of the world and every edit since, in a
// form that is only ever appended to, so that a crash at any moment loses nothing that was there before.
// journal_format.h describes the bytes, journaled_world.h works with one.

/// The content of a journal and the losses in it.
struct JournalReport {
  std::uint64_t bytes = 0;           // of the file
  std::uint64_t snapshot_bytes = 0;  // of the snapshot
  std::uint64_t edit_bytes = 0;      // of the edits since
  std::uint64_t edits = 0;           // replayed since the snapshot
  std::uint64_t damaged_from = 0;    // offset of the first damage; the size of a whole file
  std::uint64_t lost_bytes = 0;      // damaged bytes, or those of edits that could not be replayed
  std::uint64_t lost_edits = 0;      // whole ones that could not be replayed, as they build on a loss
  bool is_torn = false;              // the only loss is the last edit, cut off as the program stopped
  /// A copy from the first damage on; empty where nothing was lost or the file was only read.
  std::filesystem::path set_aside = {};
  std::vector<Remark> damage = {};  // damages and their repair; none for a whole journal
};

/// Called now and then with the part that is done, in [0, 1]; false stops.
using JournalProgress = std::function<bool(double part)>;

struct ReadJournal {
  world::World world;
  JournalReport report;
};

/// Reads a journal and changes nothing on disk; the world of a damaged one is made of all that is whole
/// before and behind the damage. Whatever the bytes are, memory stays in proportion to their number. Fails
/// for a file that is no journal, for one of a newer version, where the disk fails, and when it is stopped.
/// A journal that another program works with can be read.
base::Result<ReadJournal> read_journal(const std::filesystem::path& path,
                                       const world::GeometryFactory& factory,
                                       const JournalProgress& progress = {});

/// Is every record of it there and undamaged? False for a file that is no journal. Reads all its bytes, but
/// makes no world of them. Fails where the disk does.
base::Result<bool> is_whole_journal(const std::filesystem::path& path);

/// Writes a world as a fresh journal in place of an existing file, which stays if not all can be written:
/// a shape may be of a kind that cannot. Fails while somebody works with the journal.
base::Result<void> write_journal(const std::filesystem::path& path, const world::World& world);

}  // namespace icome::files
