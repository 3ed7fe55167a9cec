#pragma once
#include <QAction>
#include <QMenu>
#include <functional>

#include "session/session.h"

namespace icome::ui {

/// Every object that has a shape, of the scene that is shown.
void select_all(session::Session& session);

/// The edit menu: its actions know what there is to undo and whether something is selected. Session and
/// window outlive it.
class EditActions {
 public:
  struct Hooks {
    std::function<bool()> begin;                      // before the world is touched from here; false: do not
    std::function<void(const std::string&)> refused;  // why something was not done
    std::function<void()> rename;                     // of the selected object, in the tree
    std::function<void()> search;                     // in the tree
  };
  EditActions(session::Session& session, Hooks hooks);
  EditActions(const EditActions&) = delete;
  EditActions& operator=(const EditActions&) = delete;

  void fill(QMenu& menu);
  QAction* undo() const { return undo_; }
  QAction* redo() const { return redo_; }
  QAction* duplicate() const { return duplicate_; }
  QAction* delete_objects() const { return delete_; }

  /// Brings names and states up to date.
  void refresh();

 private:
  void perform(const std::function<base::Result<void>()>& act);
  void fill_duplicate_as();

  session::Session& session_;
  Hooks hooks_;
  QAction *undo_ = nullptr, *redo_ = nullptr, *duplicate_ = nullptr, *delete_ = nullptr;
  QAction *group_ = nullptr, *rename_ = nullptr;
  QMenu* duplicate_as_ = nullptr;
};

}  // namespace icome::ui
