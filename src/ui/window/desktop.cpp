#include "ui/window/desktop.h"

#include <QApplication>
#include <QSettings>
#include <cstdio>

#include "base/terminal_text.h"
#include "session/sharing/join_design.h"
#include "session/storage/autosave_files.h"
#include "ui/window/connect_display.h"
#include "ui/window/main_window.h"

namespace icome::ui {
namespace {

constexpr const char* kNoDisplayWays =
    "Try `icome touch` to touch a model without one, or `icome shot` to draw a design to a picture.";

Theme chosen_theme(const DesktopOptions& options, const QSettings& settings) {
  const std::string kept = settings.value("theme").toString().toStdString();
  const auto theme = theme_of(options.theme.empty() ? kept : options.theme);
  return theme.value_or(Theme::System);
}

}  // namespace

int run_desktop(int argc, char** argv, const DesktopOptions& options, session::SessionSettings settings) {
  const auto application = connect_display(argc, argv, kNoDisplayWays);
  if (!application) return 1;

  QSettings kept("icome", "icome");
  const Theme theme = chosen_theme(options, kept);
  apply_theme(*application, theme);
  if (settings.autosave_folder.empty()) settings.autosave_folder = session::default_autosave_folder();
  if (settings.kept_folder.empty()) settings.kept_folder = session::default_kept_folder();
  auto session = session::Session::create(std::move(settings));
  if (!session) {
    std::fprintf(stderr, "icome: %s\n", base::terminal_text(session.error().message).c_str());
    return 1;
  }
  MainWindow window(
      **session, kept,
      {.theme = theme, .menu = options.menu, .microphone = speech::source_of(options.microphone)});
  window.show();
  window.begin(options.design);
  return QApplication::exec();
}

}  // namespace icome::ui
