#pragma once
#include <QMenu>
#include <functional>
#include <string>

#include "session/session.h"
#include "world/edit/copy.h"

namespace icome::ui {

// What menus, keys and tool bars do to the selected objects: each is one action to undo. What comes about is
// selected then. Nothing happens without a selection.

base::Result<void> delete_selected(session::Session& session);
base::Result<void> group_selected(session::Session& session);
/// Each beside its model, under the same parent.
base::Result<void> duplicate_selected(session::Session& session, world::Duplicate how);

/// The six ways to duplicate as people choose them, the most wanted first.
struct DuplicateChoice {
  world::Duplicate how;
  const char* text;
  const char* tip;
};
const std::vector<DuplicateChoice>& duplicate_choices();

/// What a menu of the selected objects needs from the place where it opens.
struct ObjectMenu {
  std::function<void()> zoom = {};     // none: not offered
  std::function<void()> rename = {};   // none: not offered
  std::function<void()> picture = {};  // that is to lie on them, to be chosen; none: not offered
  std::function<void(const std::string&)> refused = {};
};
/// Adds the actions that suit the selection; none without one.
void fill_object_menu(QMenu& menu, session::Session& session, const ObjectMenu& entries);

}  // namespace icome::ui
