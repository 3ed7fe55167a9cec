#pragma once
#include <QWidget>
#include <functional>
#include <memory>

#include "session/session.h"

namespace icome::ui {

/// The objects of the world as a tree, with a box to search them by name; its selection is the session's.
/// Changes go through the session, which outlives it.
class WorldTree final : public QWidget {
 public:
  WorldTree(session::Session& session, QWidget* parent);
  ~WorldTree() override;

  /// Sets the action of "Zoom to" in the context menu and of a double click, which select the object first.
  void on_zoom_to(std::function<void()> zoom);
  /// Edits the name of the current object in place.
  void rename();
  /// Commits the name that is being typed; false: it was refused, and the panel tells why.
  bool finish_typing();
  /// Shows who holds what, as that has changed.
  void show_holders();
  /// Puts the keyboard's focus into the search box.
  void search();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace icome::ui
