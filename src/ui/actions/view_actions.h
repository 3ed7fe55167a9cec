#pragma once
#include <QAction>
#include <QActionGroup>
#include <QMenu>
#include <QSettings>
#include <functional>

#include "session/session.h"
#include "ui/look/theme.h"
#include "ui/tools/scene_tools.h"

namespace icome::ui {

/// The view menu: directions and viewpoints to look from, and the look of the scene, kept in the settings.
/// Session, tools and settings outlive it.
class ViewActions {
 public:
  ViewActions(session::Session& session, SceneTools& tools, QSettings& settings);
  ViewActions(const ViewActions&) = delete;
  ViewActions& operator=(const ViewActions&) = delete;

  void fill(QMenu& menu);
  QAction* home() const { return home_; }
  QAction* zoom_to_selection() const { return zoom_; }

  /// Calls `changed` when a person has chosen another theme.
  void on_theme(std::function<void(Theme)> changed) { theme_changed_ = std::move(changed); }
  void show_theme(Theme theme);

  bool grid() const { return grid_->isChecked(); }
  bool shadows() const { return shadows_->isChecked(); }
  /// Calls `changed` when grid or shadows are switched.
  void on_look(std::function<void()> changed) { look_changed_ = std::move(changed); }
  /// Brings the states of the actions up to date.
  void refresh();

 private:
  void fill_directions(QMenu& menu);
  void fill_viewpoints(QMenu& menu);
  void fill_scenes(QMenu& menu);
  void fill_modes(QMenu& menu);
  void fill_themes(QMenu& menu);
  void fill_motions(QMenu& menu);
  void fill_stereo(QMenu& menu);
  void ask_eye_distance(QWidget* parent);
  QAction* add_switch(QMenu& menu, const char* name, const QString& text, const QKeySequence& keys);

  session::Session& session_;
  SceneTools& tools_;
  QSettings& settings_;
  QAction *home_ = nullptr, *zoom_ = nullptr, *grid_ = nullptr, *shadows_ = nullptr;
  QAction *camera_ = nullptr, *hand_ = nullptr, *play_ = nullptr;
  QAction *fish_tank_ = nullptr, *squeezed_ = nullptr;
  QActionGroup* stereo_ = nullptr;
  QActionGroup* themes_ = nullptr;
  std::function<void(Theme)> theme_changed_ = [](Theme) {};
  std::function<void()> look_changed_ = [] {};
};

}  // namespace icome::ui
