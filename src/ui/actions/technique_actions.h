#pragma once
#include <QActionGroup>
#include <QMenu>
#include <QSettings>
#include <array>
#include <optional>

#include "session/session.h"
#include "ui/window/note.h"

namespace icome::ui {

/// The menu of interaction techniques (thesis chapter 2): by which one the hands select, hold and travel,
/// kept in the settings; and recording what is done by it. Session, settings and the window, which dialogs
/// belong to, outlive it.
class TechniqueActions {
 public:
  TechniqueActions(session::Session& session, QSettings& settings, QWidget& window,
                   std::function<void(const Note&)> tell);
  TechniqueActions(const TechniqueActions&) = delete;
  TechniqueActions& operator=(const TechniqueActions&) = delete;

  /// Adds the menu; the session works by what was chosen last from then on.
  void fill(QMenu& menu);

  /// Calls `chosen` whenever another way was chosen.
  void on_choice(std::function<void()> chosen) { chosen_ = std::move(chosen); }
  /// Of the technique that is at work: its name, and what mouse and wheel do by it; empty: it is by touch.
  QString name() const;
  QString hint() const;

  /// Records into this file from now on; what is refused is told.
  void begin_recording(const std::filesystem::path& path);
  /// Writes what was recorded, and tells where it is. Without effect while nothing is.
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
