#pragma once
#include <QElapsedTimer>
#include <QMainWindow>
#include <QSettings>
#include <QTimer>

#include "session/session.h"
#include "ui/actions/drawing_actions.h"
#include "ui/actions/edit_actions.h"
#include "ui/actions/file_actions.h"
#include "ui/actions/menu_actions.h"
#include "ui/actions/move_actions.h"
#include "ui/actions/operation_actions.h"
#include "ui/actions/picture_actions.h"
#include "ui/actions/technique_actions.h"
#include "ui/actions/view_actions.h"
#include "ui/devices/device_panel.h"
#include "ui/forms/operation_panel.h"
#include "ui/look/theme.h"
#include "ui/panels/property_panel.h"
#include "ui/panels/world_tree.h"
#include "ui/sharing/sharing_panel.h"
#include "ui/tools/scene_tools.h"
#include "ui/tools/shape_options.h"
#include "ui/voice/voice_bar.h"
#include "ui/window/banner.h"
#include "ui/window/scene_label.h"
#include "ui/window/scene_view.h"

class QDockWidget;
class QLabel;

namespace icome::ui {

/// The only window of the desktop: the scene in the middle, messages above it, the world's tree and the
/// properties beside it, and the state of the hand below. Session and settings outlive it.
class MainWindow final : public QMainWindow {
 public:
  struct Options {
    Theme theme = Theme::System;
    DeviceWays devices = {};
    std::optional<interaction::Element> menu = {};  // the haptic menu; none: as chosen before
    speech::OpenSource microphone = nullptr;        // that voice commands come from; none: the usual one
    speech::OpenLoudspeaker loudspeaker = speech::open_loudspeaker;  // that replies are spoken by
  };
  MainWindow(session::Session& session, QSettings& settings, const Options& options);
  ~MainWindow() override;

  /// Opens the design, or recovers work on it after a crash; without a design, recovers the newest work.
  void begin(const std::filesystem::path& design);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void changeEvent(QEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void make_center();
  void make_docks();
  void make_menus();
  void make_tool_menu(QMenu& menu);
  void make_help_menu(QMenu& menu);
  void make_tool_bar();
  void restore_layout();

  void tick();
  void hear(const session::SessionEvent& event);
  void tell(const Note& note) { banner_->tell(note); }
  void tell_error(const std::string& why);
  void remedy(const Note& note, Note::Remedy remedy);
  void discard(const std::filesystem::path& journal);
  void show_progress();
  void show_title();
  void show_hint();
  void show_count();
  std::optional<world::ObjectId> wanted_label() const;
  void show_look();
  void show_tool(Tool tool);
  void choose_theme(Theme theme);
  void show_scene_menu(QPointF at);
  void show_shortcuts();
  void next_part();
  void show_voice(bool shown);
  void ask(const interaction::Operation& operation);
  void stop_asking();
  void show_devices();
  void show_people();
  void show_sharing();
  void choose_for_conflicts();
  void find_command();
  bool offer_drop(QDropEvent& drop, bool over_scene);
  void drop_picture(const std::filesystem::path& file, const SceneInput& input);
  bool finish_work();

  session::Session& session_;
  QSettings& settings_;
  Options options_;
  SceneTools tools_;
  FileActions files_;
  EditActions edits_;
  OperationActions operations_;
  ViewActions views_;
  TechniqueActions techniques_;
  MoveActions moves_;
  PictureActions pictures_;
  DrawingActions drawings_;
  MenuActions haptic_menu_;
  session::Conversation conversation_;
  Banner* banner_ = nullptr;
  ShapeOptions* shaping_ = nullptr;  // shown with its tool
  SceneView* scene_ = nullptr;
  VoiceBar* voice_ = nullptr;  // shown while voice commands are
  QAction* voice_action_ = nullptr;
  WorldTree* tree_ = nullptr;
  PropertyPanel* properties_ = nullptr;
  OperationPanel* operation_ = nullptr;
  QDockWidget* operation_dock_ = nullptr;  // hidden while there is no operation in it
  DevicePanel* devices_ = nullptr;
  QDockWidget* devices_dock_ = nullptr;
  SharingPanel* people_ = nullptr;
  QDockWidget* people_dock_ = nullptr;
  QWidget* hand_ = nullptr;
  QLabel* hint_ = nullptr;
  QLabel* technique_ = nullptr;  // the technique in use; hidden for touch
  QLabel* sharing_ = nullptr;    // of a design on a server; hidden for others
  QLabel* count_ = nullptr;
  QAction* tool_actions_[kToolCount] = {};
  QTimer timer_;
  bool is_stale_ = true;  // hint and look must be refreshed
  SceneLabel label_;
  std::vector<SceneWords> numbers_;  // of the things that a question is about
  SceneWords spared_sign_;
  std::map<std::uint32_t, SceneWords> name_signs_;  // of others at work in the design
  QString sharing_state_;                           // as shown
  QString floor_state_;                             // likewise: who holds what
  std::optional<world::ObjectId> labelled_ = {};
  std::string drag_words_;    // as shown
  QString remark_;            // of an operation, as shown
  QString technique_hint_;    // as shown
  double pixel_ratio_ = 0.0;  // as shown; another screen may have another
  QElapsedTimer busy_since_;  // invalid: nothing is being read or written
  bool agreed_ = false;       // a person has agreed to close
  bool closing_ = false;      // closeEvent() runs
  bool had_menu_ = false;     // a haptic menu was open at the last tick
};

}  // namespace icome::ui
