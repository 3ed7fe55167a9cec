#include "ui/desktop.h"

#include <QApplication>
#include <QSettings>
#include <cstdio>
#include <cstdlib>

#include "session/autosave_files.h"
#include "ui/icons.h"
#include "ui/main_window.h"

namespace icome::ui {
namespace {

void say_no_display(const char* why) {
  std::fprintf(stderr,
               "icome: %s, so there is no window to open. Try `icome touch` to touch a model without one, or "
               "`icome shot` to draw a design to a picture.\n",
               why);
}

/// Is there anything that names a display?
bool display_named() {
  for (const char* name : {"DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"}) {
    if (const char* value = std::getenv(name); value && *value) return true;
  }
  return false;
}

/// Qt ends the program with abort() when it cannot reach the display: this is the place to say so in our own
/// words, before.
void hear_qt_while_connecting(QtMsgType type, const QMessageLogContext&, const QString&) {
  if (type != QtFatalMsg) return;
  say_no_display("The display cannot be reached");
  std::_Exit(1);
}

Theme chosen_theme(const DesktopOptions& options, const QSettings& settings) {
  const std::string kept = settings.value("theme").toString().toStdString();
  const auto theme = theme_of(options.theme.empty() ? kept : options.theme);
  return theme.value_or(Theme::System);
}

}  // namespace

int run_desktop(int argc, char** argv, const DesktopOptions& options, session::SessionSettings settings) {
  if (!display_named()) {
    say_no_display("There is no display");
    return 1;
  }
  QtMessageHandler usual = qInstallMessageHandler(hear_qt_while_connecting);
  QApplication application(argc, argv);
  qInstallMessageHandler(usual);
  QApplication::setApplicationName("icome");
  QApplication::setDesktopFileName("icome");
  QApplication::setWindowIcon(app_icon());

  QSettings kept("icome", "icome");
  const Theme theme = chosen_theme(options, kept);
  apply_theme(application, theme);
  if (settings.autosave_folder.empty()) settings.autosave_folder = session::default_autosave_folder();
  const bool hand_in_sight = !settings.pointers.empty();
  auto session = session::Session::create(std::move(settings));
  if (!session) {
    std::fprintf(stderr, "icome: %s\n", session.error().message.c_str());
    return 1;
  }
  MainWindow window(**session, kept, {.theme = theme, .hand_in_sight = hand_in_sight});
  window.show();
  window.begin(options.design);
  return QApplication::exec();
}

}  // namespace icome::ui
