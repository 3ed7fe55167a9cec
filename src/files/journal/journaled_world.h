#pragma once
#include <optional>

#include "files/journal/journal.h"
#include "io/open_file.h"
#include "world/edit/edit_sink.h"

namespace icome::files {

/// Options for working with a design on disk.
struct JournalOptions {
  bool create = false;  // make an empty design where there is no file, or an empty one
  /// The journal is rewritten (`compact`) when the edits since its snapshot take more than both.
  std::uint64_t compact_from = 16U << 20U;  // bytes
  double compact_factor = 2.0;              // times the snapshot; infinity: never by itself
};

/// A world whose every edit is in its journal on disk before the edit is reported as done. Owns both; one
/// thread uses it. The file is locked meanwhile, so that no other program changes it.
///
/// Durability: an edit that `perform` returned from survives the end of the program, however it ends (kill
/// -9, a crash). One that was followed by `sync` survives a loss of power, too. A sync waits for the disk,
/// some milliseconds, and covers all edits before it: after many calls it is called once, or now and then
/// (group commit). If edits are lost, they are the last ones, never some in between, and none by halves.
/// between, and none by halves.
class JournaledWorld {
 public:
  /// Opens a journal and replays its edits. The world of a damaged one is made of all that is whole; the
  /// bytes from the first damage on are copied to a file beside it (`report`) before it is mended. Fails,
  /// changing nothing, for a file that is no journal, for one that somebody else works with or of a newer
  /// version, for one with edits or shapes unknown to this program (read_journal gives what is before
  /// them), and where the disk fails or has no room for that copy.
  static base::Result<JournaledWorld> open(const std::filesystem::path& path,
                                           const world::GeometryFactory& factory,
                                           const JournalOptions& options = {});

  const world::World& world() const { return world_; }
  const std::filesystem::path& path() const { return file_.path(); }
  /// The findings of `open`.
  const JournalReport& report() const { return report_; }

  /// Applies an edit, writes it, and gives the edit that takes it back, as world::apply does. One that the
  /// world refuses or that cannot be written (a custom shape without bytes, a full disk) changes nothing.
  /// Now and then it compacts, which takes as long as writing the whole world.
  base::Result<world::Edit> perform(const world::Edit& edit) { return perform(edit, edit); }
  /// Writes `edit`, and applies `same`, its equal in effect, which may hold shapes that are made already.
  base::Result<world::Edit> perform(const world::Edit& edit, const world::Edit& same);
  /// The sink for a History. Refers to this object, which must stay in place meanwhile.
  world::EditSink sink();

  /// Brings all edits to the disk. When that fails, the content on disk is unknown: only `compact` helps.
  base::Result<void> sync();

  /// Rewrites the journal as a snapshot of the world, with no edits behind it: the old one stays until
  /// the new one is whole and on the disk.
  base::Result<void> compact();
  /// Compacts with another world, which replaces this one. When that fails, nothing has changed.
  base::Result<void> restart(world::World world);
  /// The reason why a due compaction failed; nothing while all is well. The journal grows meanwhile,
  /// and compaction is tried again when it has doubled.
  const std::optional<base::Error>& compact_problem() const { return compact_problem_; }

  /// Size of the journal in the file, bytes.
  std::uint64_t bytes() const { return end_; }
  /// Is the file still at its path? A deleted one keeps nothing for anybody; `compact` writes it anew.
  bool is_in_place() const { return file_.is_at_its_path(); }

 private:
  JournaledWorld(io::OpenFile file, const JournalOptions& options)
      : file_(std::move(file)), options_(options) {}
  base::Result<void> start(const world::GeometryFactory& factory);
  base::Result<void> append(std::string_view content);
  base::Result<void> write_anew(const world::World& world);
  void compact_if_due();

  io::OpenFile file_;
  JournalOptions options_;
  world::World world_;
  JournalReport report_;
  std::uint64_t end_ = 0;       // of the journal in the file, bytes
  std::uint64_t records_ = 0;   // in it
  std::uint64_t snapshot_ = 0;  // bytes of it
  std::uint64_t edits_ = 0;     // bytes of them
  std::uint64_t retry_ = 0;     // bytes of edits at which a failed compaction is tried again
  std::optional<base::Error> compact_problem_;
  std::optional<base::Error> broken_;  // why nothing more can be written
  std::string record_;                 // being written
};

}  // namespace icome::files
