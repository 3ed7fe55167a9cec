#pragma once
#include <QMainWindow>
#include <QSettings>
#include <QTimer>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ui/actions/recent_files.h"
#include "ui/cutout/document/cutout_files.h"
#include "ui/cutout/document/sound_loader.h"
#include "ui/cutout/panels/cell_panel.h"
#include "ui/cutout/panels/cell_tree.h"
#include "ui/cutout/panels/constraint_panel.h"
#include "ui/cutout/panels/stage_panel.h"
#include "ui/cutout/table/table_panel.h"
#include "ui/cutout/time/exposure_sheet.h"
#include "ui/cutout/time/play_bar.h"
#include "ui/cutout/time/timeline.h"
#include "ui/cutout/time/transport.h"
#include "ui/window/banner.h"

class QLabel;
class QTabWidget;

namespace icome::ui {

/// The window of a cut-out animation: the stage in the middle, time below it, layers, values and the table
/// beside it.
class CutoutWindow final : public QMainWindow {
 public:
  /// Keeps settings in that file; empty: where the program keeps its own.
  explicit CutoutWindow(const QString& settings = {}, QWidget* parent = nullptr);
  ~CutoutWindow() override;

  /// Opens an animation; what goes wrong stands above the stage.
  void open(const std::filesystem::path& file) { files_.open(file); }
  /// Offers animations to be recovered that a crash has left unsaved.
  void offer_lost();

  CutoutDocument& document() { return document_; }
  CutoutFiles& files() { return files_; }
  StageView& stage() { return *stage_; }
  Timeline& timeline() { return *timeline_; }
  ExposureSheet& sheet() { return *sheet_; }
  Transport& transport() { return transport_; }
  CutoutLook& look() { return look_; }
  TablePanel& table() { return *table_; }

  /// Keys what was moved, and goes on to the next pose; the animation grows where it ends.
  void pose_and_go_on();
  /// Copies the keys that are selected, else those of the selection at the present frame; pastes them there.
  void copy_keys();
  void paste_keys();
  /// Deletes what is selected where the keyboard is: keys, exposures or cells.
  void delete_selected();
  /// Puts a copy of each selected cell a little beside it, and selects the copies.
  void duplicate_selected();
  void ask_mark(int frame);

 protected:
  void closeEvent(QCloseEvent* event) override;
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  struct Entry {
    const char* name;
    const char* text;
    const char* keys;
    std::function<void()> act;
  };
  using Act = std::function<void()>;

  void make_center();
  void make_docks();
  void make_status();
  void make_file_menu(QMenu& menu);
  void make_edit_menu(QMenu& menu);
  void make_cell_menu(QMenu& menu);
  void make_constraint_menu(QMenu& menu);
  void make_frame_menu(QMenu& menu);
  void make_step_menu(QMenu& menu);
  void make_play_menu(QMenu& menu);
  void make_key_menu(QMenu& menu);
  void make_view_menu(QMenu& menu);
  void make_help_menu(QMenu& menu);
  void make_bars();
  QAction* add(QMenu& menu, const char* name, const char* text, const QKeySequence& keys, const Act& act);
  QAction* add_switch(QMenu& menu, const char* name, const char* text, const QKeySequence& keys, bool& flag,
                      const char* tip);
  void only_here(QAction& action);
  void fill_recent();
  void hear(CutoutChange change);
  void show_project();
  void show_frame();
  void show_selection();
  void show_state();
  void show_title();
  void tell(const Note& note);
  void tell_remark(const std::string& remark);
  void apply_look();
  void ease_chosen(animation::Ease ease);
  void hold_here();
  void record(bool only_layer);
  void set_mark(int frame, const QString& text);
  void show_shortcuts();
  void choose_export();
  void ask_to_stop_export();
  QAction* action(const char* name) const;

  std::unique_ptr<QSettings> settings_;
  RecentFiles recent_;
  CutoutDocument document_;
  CutoutLook look_;
  CutoutFiles files_;
  Transport transport_;
  SoundLoader sounds_;
  CopiedKeys copied_;
  Banner* banner_ = nullptr;
  StageView* stage_ = nullptr;
  PlayBar* bar_ = nullptr;
  Timeline* timeline_ = nullptr;
  ExposureSheet* sheet_ = nullptr;
  QTabWidget* time_ = nullptr;
  CellTree* cells_ = nullptr;
  CellPanel* cell_ = nullptr;
  StagePanel* stage_panel_ = nullptr;
  TablePanel* table_ = nullptr;
  std::unique_ptr<ConstraintMaker> maker_;
  ConstraintPanel* constraints_ = nullptr;
  QMenu *recent_menu_ = nullptr, *cell_menu_ = nullptr, *key_menu_ = nullptr;
  QAction *open_ = nullptr, *save_ = nullptr, *undo_ = nullptr, *redo_ = nullptr, *paste_ = nullptr;
  QAction *play_ = nullptr, *record_ = nullptr, *pose_ = nullptr, *stop_ = nullptr;
  std::vector<QAction*> of_still_;      // they need the film to stand still
  std::vector<QAction*> of_selection_;  // they need a cell
  std::vector<QAction*> steps_, runs_;  // for the bar below the stage
  QLabel *hint_ = nullptr, *place_ = nullptr, *count_ = nullptr;
  QTimer late_values_;
  std::vector<std::filesystem::path> lost_;
  bool agreed_ = false;        // a person has agreed to close
  bool stops_export_ = false;  // and that an export ends with that
};

}  // namespace icome::ui
