#pragma once
#include <filesystem>
#include <optional>

#include "base/result.h"

namespace icome::session {

// The files of an autosave folder. Each running session with unsaved work has a journal of its own there,
// "autosave-....icome", locked while it runs, and beside it "autosave-....of", which names the design that
// the work is on. Other files in the folder are left alone.

/// The folder in which work in progress is kept by default: $XDG_STATE_HOME/icome/autosave,
/// or ~/.local/state/icome/autosave. Empty when there is neither.
std::filesystem::path default_autosave_folder();

/// Makes the folder, accessible to this person only, where there is none.
base::Result<void> make_autosave_folder(const std::filesystem::path& folder);

/// A name for a new journal that nothing in the folder has.
std::filesystem::path new_autosave_journal(const std::filesystem::path& folder);
bool is_autosave_journal(const std::filesystem::path& path);

/// Notes the design of a journal beside it; `design` may be empty.
base::Result<void> write_design_of(const std::filesystem::path& journal, const std::filesystem::path& design);
/// The noted design of a journal; empty when it was not noted, or the note is damaged.
std::filesystem::path read_design_of(const std::filesystem::path& journal);

/// Deletes a journal and the files that belong to it. Precondition: the caller has its lock.
void remove_autosave(const std::filesystem::path& journal);
/// Gives a journal that cannot be read (wholly) a name under which no work is looked for, and deletes the
/// files that belong to it.
std::filesystem::path damaged_name(const std::filesystem::path& journal);
void set_autosave_aside(const std::filesystem::path& journal);
/// Deletes files that killed programs left half done, and those of journals that are gone.
void sweep_autosave_folder(const std::filesystem::path& folder);

}  // namespace icome::session
