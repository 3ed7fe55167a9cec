#pragma once
#include <QActionGroup>
#include <QMenu>
#include <QSettings>
#include <array>
#include <optional>

#include "session/session.h"
#include "ui/window/note.h"

namespace icome::ui {

/// The menu of interaction techniques (thesis chapter 2): the ways in which the hands select, hold and
/// travel, kept in the settings; and the recording of what is done with them. Session, settings and the
/// window, which is the parent of dialogs, outlive it.
class TechniqueActions {
 public:
  TechniqueActions(session::Session& session, QSettings& settings, QWidget& window,
                   std::function<void(const Note&)> tell);
  TechniqueActions(const TechniqueActions&) = delete;
  TechniqueActions& operator=(const TechniqueActions&) = delete;

  /// Adds the menu; from then on the session uses the technique that was chosen last.
  void fill(QMenu& menu);

  /// Calls `chosen` whenever a person has chosen another technique.
  void on_choice(std::function<void()> chosen) { chosen_ = std::move(chosen); }
  /// Name of the technique in use, and its use of mouse and wheel as a hint; both empty for touch.
  QString name() const;
  QString hint() const;

  /// Records into this file from now on; tells of an error in a note.
  void begin_recording(const std::filesystem::path& path);
  /// Writes the recording, and tells where it is. Without effect while nothing is recorded.
  void end_recording();

 private:
  void choose_recording();
  void show_recording();
  void fill_holding(QMenu& menu);
  void fill_travelling(QMenu& menu);
  void choose(const char* key, std::string_view name);
  void apply();

  session::Session& session_;
  QSettings& settings_;
  QWidget& window_;
  std::function<void(const Note&)> tell_;
  std::function<void()> chosen_ = [] {};
  QAction* record_ = nullptr;
  std::filesystem::path recorded_to_ = {};  // empty: nothing is recorded
};

}  // namespace icome::ui
