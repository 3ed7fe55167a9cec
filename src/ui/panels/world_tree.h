#pragma once
#include <QWidget>
#include <functional>
#include <memory>

#include "session/session.h"

namespace icome::ui {

/// The objects of the world as a tree, with a box to search them by name; selects what the session has
/// selected and the other way round. Changes go through the session, which outlives it.
class WorldTree final : public QWidget {
 public:
  WorldTree(session::Session& session, QWidget* parent);
  ~WorldTree() override;

  /// What "Zoom to" in the context menu and a double click on an object do, once it is selected.
  void on_zoom_to(std::function<void()> zoom);
  /// Edits the name of the current object in place.
  void rename();
  /// Commits the name that is being typed; false: it was refused, which is shown.
  bool finish_typing();
  /// Puts the keyboard into the search box.
  void search();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
