#pragma once
#include <QWidget>

#include "ui/window/scene_window.h"

class QLabel;
class QPushButton;
class QStackedLayout;

namespace icome::ui {

/// The scene in the middle of the window or, where it cannot be drawn, the reason and a remedy. Session and
/// tools outlive it.
class SceneView final : public QWidget {
 public:
  SceneView(session::Session& session, SceneTools& tools, QWidget* parent);

  /// To be called once for each update of the session.
  void tick();
  /// Gives the keyboard's focus to the scene or, where it cannot be drawn, to the button that tries again.
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
  void tell_screen();

  session::Session& session_;
  SceneTools& tools_;
  SceneWindow* scene_;  // owned by the container
  QWidget* container_;
  QStackedLayout* stack_;
  QLabel* sign_ = nullptr;
  QLabel* reason_ = nullptr;
  QPushButton* again_ = nullptr;
};

}  // namespace icome::ui
