#include "session/storage/autosave_keeper.h"

#include <algorithm>
#include <utility>

#include "drawing/shape/every_kind.h"
#include "session/storage/autosave_files.h"

namespace icome::session {

using files::JournaledWorld;
namespace {

const world::Edit& edit_for_replicas(const Edited& edited) {
  return edited.for_replicas ? *edited.for_replicas : *edited.edit;
}

}  // namespace

void AutosaveKeeper::follow(const Edited& edited, Time now) {
  if (edited.whole) {
    replace(edited, now);
  } else {
    if (edited.edit) edit(edited, now);
    if (edited.saved) note_saved(*edited.saved, now);
  }
}

void AutosaveKeeper::replace(const Edited& edited, Time now) {
  lost_ = false;
  discard();
  apart_ = *edited.whole;
  whole_ = edited.number;
  last_edit_ = 0;
  design_.clear();
  by_server_ = edited.saved && edited.saved->by_server;
  if (!edited.saved || by_server_) return;
  design_ = edited.saved->design;
  recovered_ = edited.saved->recovered;
  unsaved_ = recovered_ != nullptr;
  if (unsaved_) try_to_keep(now);
}

void AutosaveKeeper::note_saved(const SavedWork& saved, Time now) {
  if (saved.number < whole_) return;  // of a world that is gone
  if (by_server_ != saved.by_server) {
    by_server_ = saved.by_server;
    unsaved_ = !by_server_;
    if (unsaved_) return try_to_keep(now);
    if (follows_) part();
    return discard();
  }
  if (by_server_) return;
  design_ = saved.design;
  if (last_edit_ <= saved.number && !saved.in_part) {
    if (follows_) part();
    discard();
  } else if (journal_) {
    // The old name is still good for finding the design, if this fails.
    (void)write_design_of(journal_->path(), design_);
  }
}

void AutosaveKeeper::edit(const Edited& edited, Time now) {
  if (by_server_) {
    apply_apart(edit_for_replicas(edited));
    return;
  }
  last_edit_ = edited.number;
  unsaved_ = true;
  if (lost_) return;
  if (follows_) {
    if (journal_->perform(*edited.edit, edit_for_replicas(edited))) {
      if (!sync_due_) sync_due_ = now + settings_.sync_period;
      return;
    }
    part();
  }
  apply_apart(edit_for_replicas(edited));
  if (!lost_ && (!problem_ || now >= retry_due_)) try_to_keep(now);
}

void AutosaveKeeper::apply_apart(const world::Edit& edit) {
  const auto done = world::apply(apart_, edit);
  if (!done) give_up("An edit could not be repeated (" + done.error().message + ").");
}

void AutosaveKeeper::give_up(const std::string& why) {
  lost_ = true;
  follows_ = false;
  sync_due_.reset();
  apart_ = {};
  problem_ = base::Error{why};
}

/// The journal stays as it is and the world goes on without it.
void AutosaveKeeper::part() {
  apart_ = journal_->world();
  follows_ = false;
  sync_due_.reset();
}

void AutosaveKeeper::try_to_keep(Time now) {
  constexpr int kMostDoublings = 4;  // each try may write as much as the disk has room for
  const auto kept = keep();
  failures_ = kept ? 0 : std::min(failures_ + 1, kMostDoublings + 1);
  retry_due_ = now + settings_.retry_period * (1 << std::max(0, failures_ - 1));
  if (kept)
    problem_.reset();
  else
    problem_ = kept.error();
}

base::Result<void> AutosaveKeeper::keep() {
  if (const auto made = make_autosave_folder(settings_.folder); !made) return made;
  if (!journal_) {
    if (const auto made = make_journal(); !made) return made;
  }
  if (const auto noted = write_design_of(journal_->path(), design_); !noted) return noted;
  if (const auto written = journal_->restart(apart_); !written) return written;
  follows_ = true;
  apart_ = {};
  // The old journal goes now that there is another, and not before.
  if (recovered_) std::exchange(recovered_, nullptr)->discard();
  return {};
}

base::Result<void> AutosaveKeeper::make_journal() {
  constexpr int kTries = 3;  // a search for recoverable work may come between making a file and locking it
  base::Result<void> result;
  for (int i = 0; i < kTries; ++i) {
    const std::filesystem::path path = new_autosave_journal(settings_.folder);
    auto journal = JournaledWorld::open(path, drawing::every_kind_of_shape(), {.create = true});
    if (journal) {
      journal_.emplace(std::move(*journal));
      return {};
    }
    result = tl::unexpected(journal.error());
    // It may have been made, and then there was no room for what belongs into it.
    std::error_code error;
    std::filesystem::remove(path, error);
  }
  return result;
}

void AutosaveKeeper::tend(Time now) {
  if (sync_due_ && now >= *sync_due_) sync(now);
  if (!unsaved_ || lost_ || now < retry_due_) return;
  retry_due_ = now + settings_.retry_period;
  if (follows_ && journal_->is_in_place()) return;
  if (follows_) part();
  try_to_keep(now);
}

void AutosaveKeeper::sync(Time now) {
  sync_due_.reset();
  if (journal_->is_in_place() && journal_->sync()) return;
  part();
  try_to_keep(now);
}

std::optional<AutosaveKeeper::Time> AutosaveKeeper::due() const {
  if (!unsaved_ || lost_) return std::nullopt;
  return sync_due_ ? std::min(*sync_due_, retry_due_) : retry_due_;
}

void AutosaveKeeper::discard() {
  if (journal_) remove_autosave(journal_->path());
  journal_.reset();
  follows_ = false;
  sync_due_.reset();
  unsaved_ = false;
  // The problem of the last work need not be in the way of the next.
  retry_due_ = {};
  failures_ = 0;
  if (!lost_) problem_.reset();
  if (recovered_) std::exchange(recovered_, nullptr)->discard();
}

void AutosaveKeeper::finish(Time now) {
  if (!unsaved_ || lost_) return;
  if (sync_due_) sync(now);
  if (!follows_) try_to_keep(now);
}

}  // namespace icome::session
