#pragma once
#include <QAction>
#include <QApplication>
#include <QCoreApplication>
#include <QGuiApplication>
#include <QLineEdit>
#include <QMouseEvent>
#include <QSettings>
#include <QTemporaryDir>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

#include "ui/desktop_test.h"
#include "ui/window/main_window.h"
#include "ui/window/scene_window.h"

namespace icome::ui {

/// The whole window, where there is no OpenGL: all but the picture of the scene.
class WindowTest : public DesktopTest {
 protected:
  explicit WindowTest(session::SessionSettings settings = {})
      : DesktopTest(std::move(settings)), settings_(folder_.filePath("icome.conf"), QSettings::IniFormat) {
    open_window();
  }

  void open_window() {
    window_.reset();
    window_ = std::make_unique<MainWindow>(session(), settings_, MainWindow::Options{.theme = Theme::Light});
    window_->show();
  }
  /// Lets the window live until something has come about.
  template <typename Come>
  bool until(const Come& come) {
    for (int i = 0; i < 6000; ++i) {
      QCoreApplication::processEvents();
      if (come()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
  bool until_title(const QString& title) {
    // As the window's frame shows it.
    const auto shown = [this] {
      return window_->windowTitle().replace("[*]", window_->isWindowModified() ? "*" : "");
    };
    return until([&] { return shown() == title; });
  }
  QAction* action(const char* name) {
    auto* found = window_->findChild<QAction*>(name);
    EXPECT_TRUE(found) << name;
    return found;
  }
  world::ObjectId add(const char* name) {
    const auto id = session().ids().next<world::ObjectId>();
    perform(world::CreateObject{id, 0, {.name = name}}, std::string("Add ") + name);
    return id;
  }
  /// A field of the properties, about to be typed into.
  QLineEdit& field(const QString& name) {
    QLineEdit* found = nullptr;
    EXPECT_TRUE(until([&] {
      for (QLineEdit* it : window_->findChildren<QLineEdit*>()) {
        if (it->accessibleName() == name && it->isVisible()) found = it;
      }
      return found != nullptr;
    }));
    QApplication::setActiveWindow(window_.get());
    found->setFocus();
    found->selectAll();
    return *found;
  }
  QLineEdit& name_field() { return field("Name"); }
  QString file(const char* name) { return folder_.filePath(name); }

  QTemporaryDir folder_;
  QSettings settings_;
  std::unique_ptr<MainWindow> window_;
};

/// The mouse over the scene of the one window that there is.
class SceneMouse {
 public:
  SceneMouse() {
    for (QWindow* window : QGuiApplication::allWindows())
      if (auto* scene = dynamic_cast<SceneWindow*>(window)) scene_ = scene;
    if (!scene_) throw std::runtime_error("there is no scene");
    scene_->resize(800, 600);
  }
  SceneWindow& window() { return *scene_; }
  /// Pixels; the window may lay it out anew.
  QSizeF size() const { return scene_->size(); }
  void press(QPointF at, Qt::MouseButton button = Qt::LeftButton, Qt::KeyboardModifiers modifiers = {}) {
    button_ = button;
    send(QEvent::MouseButtonPress, at, button, button, modifiers);
  }
  void move(QPointF at, Qt::KeyboardModifiers modifiers = {}) {
    send(QEvent::MouseMove, at, Qt::NoButton, button_, modifiers);
  }
  void release(QPointF at, Qt::KeyboardModifiers modifiers = {}) {
    send(QEvent::MouseButtonRelease, at, button_, Qt::NoButton, modifiers);
    button_ = Qt::NoButton;
  }

 private:
  void send(QEvent::Type type, QPointF at, Qt::MouseButton button, Qt::MouseButton held,
            Qt::KeyboardModifiers modifiers) {
    QMouseEvent event(type, at, at, button, held, modifiers);
    QCoreApplication::sendEvent(scene_, &event);
  }

  SceneWindow* scene_ = nullptr;
  Qt::MouseButton button_ = Qt::NoButton;
};

}  // namespace icome::ui
