#include "ui/window/connect_display.h"

#include <QApplication>
#include <cstdio>
#include <cstdlib>

#include "ui/look/icons.h"

namespace icome::ui {
namespace {

const char* ways_without_display = "";

void say_no_display(const char* why) {
  std::fprintf(stderr, "icome: %s, so there is no window to open. %s\n", why, ways_without_display);
}

/// Does the environment name a display?
bool display_named() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
    if (const char* value = std::getenv(name); value && *value) return true;
  }
  return false;
}

/// Qt ends the program with abort() when it cannot reach the display: this handler prints the program's own
/// message first, and ends it.
void hear_qt_while_connecting(QtMsgType type, const QMessageLogContext&, const QString&) {
  if (type != QtFatalMsg) return;
  say_no_display("The display cannot be reached");
  std::_Exit(1);
}

}  // namespace

std::unique_ptr<QApplication> connect_display(int& argc, char** argv, const char* ways_on) {
  ways_without_display = ways_on;
  if (!display_named()) {
    say_no_display("There is no display");
    return nullptr;
  }
  QtMessageHandler usual = qInstallMessageHandler(hear_qt_while_connecting);
  auto application = std::make_unique<QApplication>(argc, argv);
  qInstallMessageHandler(usual);
  QApplication::setApplicationName("icome");
  QApplication::setDesktopFileName("icome");
  QApplication::setWindowIcon(app_icon());
  return application;
}

}  // namespace icome::ui
