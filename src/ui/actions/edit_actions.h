#pragma once
#include <QAction>
#include <QMenu>
#include <functional>

#include "session/session.h"

namespace icome::ui {

/// Selects every object with a shape in the shown scene.
void select_all(session::Session& session);

/// The edit menu. Its actions are named and enabled by the undo history and the selection. Session and window
/// outlive it.
class EditActions {
 public:
  struct Hooks {
    std::function<bool()> begin;                      // asked before the world is edited; false: do not
    std::function<void(const std::string&)> refused;  // tells why something was not done
    std::function<void()> rename;                     // renames the selected object, in the tree
    std::function<void()> search;                     // starts a search in the tree
  };
  EditActions(session::Session& session, Hooks hooks);
  EditActions(const EditActions&) = delete;
  EditActions& operator=(const EditActions&) = delete;

  void fill(QMenu& menu);
  QAction* undo() const { return undo_; }
  QAction* redo() const { return redo_; }
  QAction* duplicate() const { return duplicate_; }
  QAction* delete_objects() const { return delete_; }

  /// Brings names and states of the actions up to date.
  void refresh();

 private:
  void perform(const std::function<base::Result<void>()>& act);
  void fill_duplicate_as();

  session::Session& session_;
  Hooks hooks_;
  QAction *undo_ = nullptr, *redo_ = nullptr, *duplicate_ = nullptr, *delete_ = nullptr, *clear_ = nullptr;
  QAction *group_ = nullptr, *rename_ = nullptr;
  QMenu* duplicate_as_ = nullptr;
};

}  // namespace icome::ui
