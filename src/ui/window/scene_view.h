#pragma once
#include <QWidget>

#include "ui/window/scene_window.h"

class QLabel;
class QPushButton;
class QStackedLayout;

namespace icome::ui {

/// The scene in the middle of the window or, where it cannot be drawn, the reason and what to do. Session and
/// tools outlive it.
class SceneView final : public QWidget {
 public:
  SceneView(session::Session& session, SceneTools& tools, QWidget* parent);

  /// Once for each update of the session.
  void tick();
  /// The keyboard goes to the scene or, where it cannot be drawn, to what can be done about it.
  void take_keyboard();
  bool has_keyboard() const;
  SceneWindow& window_of_scene() { return *scene_; }

 protected:
  bool eventFilter(QObject* of, QEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void make_reason();
  void show_cursor();
  void draw_sign();

  SceneTools& tools_;
  SceneWindow* scene_;  // the container's
  QWidget* container_;
  QStackedLayout* stack_;
  QLabel* sign_ = nullptr;
  QLabel* reason_ = nullptr;
  QPushButton* again_ = nullptr;
};

}  // namespace icome::ui
