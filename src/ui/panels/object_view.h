#pragma once
#include <QTreeView>
#include <functional>
#include <vector>

#include "ui/panels/object_model.h"

namespace icome::ui {

/// A view of an ObjectModel whose selection is a session's. Does not own either.
class ObjectView final : public QTreeView {
 public:
  ObjectView(session::Session& session, ObjectModel& objects, QWidget* parent);

  /// The session has selected something else, or rows have come and gone.
  void show_selection();
  /// Selects nothing else in the session while the world's changes are followed; what is selected then is for
  /// show_selection() to show.
  void follow(const world::Changes* changes);
  /// Renames the object whose name is being typed.
  void finish_editing();

 private:
  void select_in_session();
  QItemSelection selection_of(const std::vector<world::ObjectId>& objects);

  session::Session& session_;
  ObjectModel& objects_;
  bool busy_ = false;  // the view follows the session, not the other way round
};

}  // namespace icome::ui
