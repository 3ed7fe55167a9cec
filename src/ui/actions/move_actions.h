#pragma once
#include <QMenu>
#include <QSettings>
#include <QWidget>

#include "session/session.h"

namespace icome::ui {

/// The menu of moving objects: whether they stop at surfaces, what they snap to, and the forces that the hand
/// feels then; kept in the settings. Session and settings outlive it.
class MoveActions {
 public:
  MoveActions(session::Session& session, QSettings& settings);
  MoveActions(const MoveActions&) = delete;
  MoveActions& operator=(const MoveActions&) = delete;

  /// `window` is the parent of the dialog with distances and forces.
  void fill(QMenu& menu, QWidget& window);

 private:
  void load();
  void apply();
  void show_numbers(QWidget& window);

  session::Session& session_;
  QSettings& settings_;
  session::GrabSettings grab_;
};

}  // namespace icome::ui
