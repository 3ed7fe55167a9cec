#pragma once
#include <string>

#include "base/result.h"
#include "world/edit/history.h"

namespace icome::session {

struct SessionParts;

/// The actions on a session's world, which can be undone. Main's.
class SessionHistory {
 public:
  explicit SessionHistory(SessionParts& parts) : parts_(parts) {}
  SessionHistory(const SessionHistory&) = delete;
  SessionHistory& operator=(const SessionHistory&) = delete;

  /// Performs an action called `name` ("Move leg"), which can then be undone.
  base::Result<void> perform(const world::Edit& edit, const std::string& name);
  /// Performs more of the last action, such as the next step of a drag.
  base::Result<void> extend(const world::Edit& edit);
  /// Performs an action that is only tried out, such as a preview: as long as nothing else is done,
  /// take_back() leaves no trace of it (History::trying). Trying another takes its place, at once and without
  /// a moment between them; the edit is then one of the world without what was tried before. A failed one
  /// leaves nothing tried.
  base::Result<void> try_out(const world::Edit& edit, const std::string& name);
  base::Result<void> take_back();
  /// Makes the tried action one like any other.
  void keep_tried();
  base::Result<void> undo();
  base::Result<void> redo();
  bool can_undo() const;
  bool can_redo() const;
  /// The names of the next actions to undo or redo; empty when there are none.
  std::string undo_name() const;
  std::string redo_name() const;
  /// Is the last action only tried out?
  bool trying() const;

 private:
  SessionParts& parts_;
};

}  // namespace icome::session
