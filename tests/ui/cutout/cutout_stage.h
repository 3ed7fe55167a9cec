#pragma once
#include <QCoreApplication>
#include <QImage>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QTemporaryDir>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>

#include "ui/cutout/cutout_window.h"
#include "ui/desktop_test.h"

namespace icome::ui {

/// The window of an animation with paper to move, in a folder of its own, and a mouse over the stage. Places
/// are px of the stage.
class CutoutStage : public ::testing::Test {
 protected:
  CutoutStage() {
    application();
    // Files that outlive a crash are the test's own.
    qputenv("XDG_DATA_HOME", folder_.filePath("data").toUtf8());
    open_window();
  }
  ~CutoutStage() override {
    window_.reset();
    QCoreApplication::processEvents();
  }

  void open_window() {
    window_ = std::make_unique<CutoutWindow>(folder_.filePath("settings.conf"));
    window_->resize(1360, 900);
    window_->show();
    QCoreApplication::processEvents();
  }

  std::filesystem::path file(const std::string& name) const {
    return std::filesystem::path(folder_.path().toStdString()) / name;
  }
  /// A picture of one colour.
  std::string paper(const std::string& name, int width, int height, const QColor& colour) const {
    QImage image(width, height, QImage::Format_ARGB32);
    image.fill(colour);
    EXPECT_TRUE(image.save(QString::fromStdString(file(name).string())));
    return file(name).string();
  }
  /// A cell of one picture, in the middle of the stage; its id.
  CellId add_cell(const std::string& name, int width = 100, int height = 60,
                  const QColor& colour = Qt::darkCyan) {
    const std::string picture = paper(name + ".png", width, height, colour);
    EXPECT_TRUE(document().perform(
        cutout_command("add-cell", {{"pictures", command_texts({picture})}, {"name", name}})));
    return document().project().find(name)->id;
  }

  CutoutDocument& document() { return window_->document(); }
  const animation::Project& project() { return document().project(); }
  StageView& stage() { return window_->stage(); }
  const animation::Cell& cell(const std::string& name) { return *project().find(name); }
  animation::CellState shown(const std::string& name) { return document().shown().at(cell(name).id); }
  QAction* action(const char* name) {
    auto* const found = window_->findChild<QAction*>(name);
    EXPECT_TRUE(found) << name;
    return found;
  }

  QPointF on_screen(const animation::Vector2& place) { return point_of(stage().screen_from_stage() * place); }
  void send_mouse(QWidget& to, QEvent::Type type, QPointF at, Qt::KeyboardModifiers modifiers = {}) {
    const bool moves = type == QEvent::MouseMove;
    QMouseEvent event(type, at, to.mapToGlobal(at), moves ? Qt::NoButton : Qt::LeftButton,
                      type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton, modifiers);
    QCoreApplication::sendEvent(&to, &event);
  }
  void drag_on(QWidget& to, QPointF from, QPointF until, Qt::KeyboardModifiers modifiers = {}) {
    send_mouse(to, QEvent::MouseButtonPress, from, modifiers);
    send_mouse(to, QEvent::MouseMove, 0.5 * (from + until), modifiers);
    send_mouse(to, QEvent::MouseMove, until, modifiers);
    send_mouse(to, QEvent::MouseButtonRelease, until, modifiers);
  }
  void drag(const animation::Vector2& from, const animation::Vector2& until,
            Qt::KeyboardModifiers modifiers = {}) {
    drag_on(stage(), on_screen(from), on_screen(until), modifiers);
  }
  void click(const animation::Vector2& at, Qt::KeyboardModifiers modifiers = {}) {
    send_mouse(stage(), QEvent::MouseButtonPress, on_screen(at), modifiers);
    send_mouse(stage(), QEvent::MouseButtonRelease, on_screen(at), modifiers);
  }
  bool is_told(const QString& words) const {
    for (const QLabel* label : window_->findChildren<QLabel*>())
      if (label->text().contains(words)) return true;
    return false;
  }
  /// Files of unsaved animations and their journals that are kept for a crash.
  int kept_files() const {
    int count = 0;
    std::error_code error;
    for (std::filesystem::recursive_directory_iterator it(file("data"), error), end; !error && it != end;
         it.increment(error))
      if (it->is_regular_file()) ++count;
    return count;
  }
  /// Lets the window live until something has come about.
  template <typename Come>
  bool until(const Come& come) {
    for (int i = 0; i < 3000; ++i) {
      QCoreApplication::processEvents();
      if (come()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  QTemporaryDir folder_;
  std::unique_ptr<CutoutWindow> window_;
};

}  // namespace icome::ui
