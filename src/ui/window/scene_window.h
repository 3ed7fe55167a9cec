#pragma once
#include <QDropEvent>
#include <QSinglePointEvent>
#include <QWindow>
#include <functional>
#include <memory>
#include <utility>

#include "session/display/display_feed.h"
#include "ui/tools/scene_tools.h"
#include "ui/window/display_thread.h"

namespace icome::ui {

/// The native window in which a thread of its own draws the scene; passes mouse, pen and keyboard on to the
/// tools. Tools and feed outlive it.
class SceneWindow final : public QWindow {
 public:
  SceneWindow(SceneTools& tools, session::DisplayFeed& feed);
  ~SceneWindow() override;

  /// The reason why there is no picture, once; nothing while there is one.
  std::optional<std::string> trouble();
  /// Tries again to draw.
  void retry();
  /// Name of the renderer, in the driver's words; empty until the first frame.
  QString renderer();
  /// `offered` gets the events of drag and drop over the scene; true: the event was used.
  void on_drop(std::function<bool(QDropEvent&)> offered) { offered_ = std::move(offered); }

 protected:
  bool event(QEvent* event) override;
  void exposeEvent(QExposeEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void tabletEvent(QTabletEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void keyReleaseEvent(QKeyEvent* event) override;
  void focusOutEvent(QFocusEvent* event) override;

 private:
  SceneInput input(const QSinglePointEvent& event);
  void show_or_hide();

  SceneTools& tools_;
  session::DisplayFeed& feed_;
  std::unique_ptr<DisplayThread> display_ = nullptr;  // null: not seen yet, or it cannot be
  std::optional<std::string> trouble_ = {};
  bool refused_ = false;                             // it does not try again by itself
  std::optional<interaction::Eye> pressed_in_ = {};  // its picture has the mouse while a button is held
  std::function<bool(QDropEvent&)> offered_ = [](QDropEvent&) { return false; };
};

}  // namespace icome::ui
