#pragma once
#include <chrono>
#include <optional>
#include <string>

#include "files/journal/journaled_world.h"
#include "session/storage/autosave_journal.h"
#include "session/storage/claimed_work.h"

namespace icome::session {

/// The work of the AutosaveJournal, without its thread: follows the posts of an EditedQueue and keeps
/// unsaved work in a journal on disk. Owns the journal. Time comes from outside.
class AutosaveKeeper {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit AutosaveKeeper(AutosaveSettings settings) : settings_(std::move(settings)) {}

  /// On return the work is on its way to the disk, past any crash of this program; if it cannot be, problem()
  /// says why.
  void follow(const Edited& edited, Time now);
  /// Does what is due: a sync, another try, a look whether the journal is still there.
  void tend(Time now);
  /// The time when something will be due; nothing while there is nothing to keep.
  std::optional<Time> due() const;
  /// Keeps nothing until there is another world, as this one is not known any more.
  void give_up(const std::string& why);
  /// Deletes the kept work.
  void discard();
  /// Brings the kept work to the disk.
  void finish(Time now);

  /// The reason why unsaved work is not kept; nothing while it is, or there is none.
  const std::optional<base::Error>& problem() const { return problem_; }

 private:
  void replace(const Edited& edited, Time now);
  void note_saved(const SavedWork& saved, Time now);
  void edit(const Edited& edited, Time now);
  void apply_apart(const world::Edit& edit);
  void part();
  void try_to_keep(Time now);
  base::Result<void> keep();
  base::Result<void> make_journal();
  void sync(Time now);

  AutosaveSettings settings_;
  std::optional<files::JournaledWorld> journal_;  // on disk; locked even while it does not follow
  bool follows_ = false;                          // the journal is the world
  world::World apart_;                            // the world while no journal follows
  bool unsaved_ = false;
  bool by_server_ = false;                  // a server keeps the world
  bool lost_ = false;                       // an edit could not be done again: the world is not known
  std::filesystem::path design_ = {};       // that the work is on
  std::uint64_t last_edit_ = 0;             // number of the last edit
  std::uint64_t whole_ = 0;                 // and of the last world
  std::shared_ptr<ClaimedWork> recovered_;  // not null: this world is still kept in it
  std::optional<base::Error> problem_;
  std::optional<Time> sync_due_;  // of what was written since the last sync
  Time retry_due_ = {};           // also of the look whether the journal is there
  int failures_ = 0;              // in turn
};

}  // namespace icome::session
