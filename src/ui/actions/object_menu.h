#pragma once
#include <QMenu>
#include <functional>
#include <string>

#include "session/session.h"
#include "world/edit/copy.h"

namespace icome::ui {

// Edits of the selected objects, for menus, keys and tool bars. Each is one action to undo, and selects the
// objects that it creates. Without a selection they do nothing.

base::Result<void> delete_selected(session::Session& session);
base::Result<void> group_selected(session::Session& session);
/// Places each duplicate beside its model, under the same parent.
base::Result<void> duplicate_selected(session::Session& session, world::Duplicate how);

/// A way to duplicate, as it is offered to people. There are six, the most wanted first.
struct DuplicateChoice {
  world::Duplicate how;
  const char* text;
  const char* tip;
};
const std::vector<DuplicateChoice>& duplicate_choices();

/// Callbacks of the place where a menu of the selected objects opens.
struct ObjectMenu {
  std::function<void()> zoom = {};     // none: not offered
  std::function<void()> rename = {};   // none: not offered
  std::function<void()> picture = {};  // lets a person choose a picture for them; none: not offered
  std::function<void()> draw = {};     // opens the selected drawing; none: not offered
  std::function<void(const std::string&)> refused = {};
};
/// Adds the actions that suit the selection; none where nothing is selected.
void fill_object_menu(QMenu& menu, session::Session& session, const ObjectMenu& entries);

}  // namespace icome::ui
