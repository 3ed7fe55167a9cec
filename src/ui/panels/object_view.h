#pragma once
#include <QTreeView>
#include <functional>
#include <vector>

#include "ui/panels/object_model.h"

namespace icome::ui {

/// A view of an ObjectModel that shares its selection with a session. Owns neither.
class ObjectView final : public QTreeView {
 public:
  ObjectView(session::Session& session, ObjectModel& objects, QWidget* parent);

  /// Shows the session's selection; to be called when that has changed, or rows have come and gone.
  void show_selection();
  /// Follows changes of the world, without selecting anything in the session meanwhile; showing the selection
  /// is left to show_selection().
  void follow(const world::Changes* changes);
  /// Commits the name that is being typed.
  void finish_editing();

 private:
  void select_in_session();
  QItemSelection selection_of(const std::vector<world::ObjectId>& objects);

  session::Session& session_;
  ObjectModel& objects_;
  bool busy_ = false;  // the view follows the session, not the other way round
};

}  // namespace icome::ui
