// The menus and the toolbar of the window of animations.
#include <QDockWidget>
#include <QMenu>
#include <QToolBar>

#include "ui/actions/actions.h"
#include "ui/cutout/cutout_window.h"
#include "ui/look/icons.h"

namespace icome::ui {
namespace {

constexpr double kStageZoomStep = 1.25;

}  // namespace

QAction* CutoutWindow::add(QMenu& menu, const char* name, const char* text, const QKeySequence& keys,
                           const Act& act) {
  return add_action(menu, name, text, keys, act);
}

QAction* CutoutWindow::add_switch(QMenu& menu, const char* name, const char* text, const QKeySequence& keys,
                                  bool& flag, const char* tip) {
  QAction* const made = add_action(menu, name, text, keys, [] {});
  made->setCheckable(true);
  made->setChecked(flag);
  made->setStatusTip(tip);
  made->setToolTip(tip);
  connect(made, &QAction::toggled, this, [this, &flag](bool on) {
    flag = on;
    apply_look();
  });
  return made;
}

/// Lets the keys of an action be its own only over the stage and time, so that panels have theirs.
void CutoutWindow::only_here(QAction& action) {
  action.setShortcutContext(Qt::WidgetWithChildrenShortcut);
  for (QWidget* place : {static_cast<QWidget*>(stage_), static_cast<QWidget*>(time_)})
    place->addAction(&action);
}

void CutoutWindow::make_file_menu(QMenu& menu) {
  add(menu, "file.new", "&New Animation", QKeySequence::New, [] {
    open_cutout_window({});
  })->setIcon(icon(Icon::New));
  open_ = add(menu, "file.open", "&Open\u2026", QKeySequence::Open, [this] { files_.choose_and_open(); });
  open_->setIcon(icon(Icon::Open));
  recent_menu_ = menu.addMenu("Open &Recent");
  recent_menu_->setObjectName("file.recent");
  fill_recent();
  menu.addSeparator();
  save_ = add(menu, "file.save", "&Save", QKeySequence::Save, [this] { files_.save(); });
  save_->setIcon(icon(Icon::Save));
  add(menu, "file.save_as", "Save &As\u2026", QKeySequence("Ctrl+Shift+S"), [this] { files_.save_as(); });
  menu.addSeparator();
  add(menu, "file.import_cell", "Import a &Folder as One Cell\u2026", QKeySequence("Ctrl+Shift+I"),
      [this] { files_.choose_folder(true); });
  add(menu, "file.import_cells", "Import a Folder as &Cells\u2026", {},
      [this] { files_.choose_folder(false); });
  add(menu, "file.sound", "So&und\u2026", {}, [this] { files_.choose_sound(); });
  add(menu, "file.silence", "Take the Sound Away", {},
      [this] { document_.perform(cutout_command("silence")); });
  menu.addSeparator();
  add(menu, "file.export", "&Export\u2026", QKeySequence("Ctrl+E"), [this] { choose_export(); });
  menu.addSeparator();
  add(menu, "file.close", "C&lose", QKeySequence("Ctrl+Q"), [this] { close(); });
}

void CutoutWindow::fill_recent() {
  recent_menu_->clear();
  const QStringList labels = recent_.labels();
  for (qsizetype i = 0; i < labels.size(); ++i) {
    const QString path = recent_.paths()[i];
    recent_menu_->addAction(QString(labels[i]).replace("&", "&&"), this,
                            [this, path] { files_.when_safe([this, path] { files_.open(path_of(path)); }); });
  }
  recent_menu_->setEnabled(!labels.isEmpty());
}

void CutoutWindow::make_edit_menu(QMenu& menu) {
  undo_ = add(menu, "edit.undo", "&Undo", QKeySequence::Undo, [this] { document_.undo(); });
  undo_->setIcon(icon(Icon::Undo));
  redo_ = add(menu, "edit.redo", "&Redo", QKeySequence::Redo, [this] { document_.redo(); });
  redo_->setShortcuts({QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")});
  redo_->setIcon(icon(Icon::Redo));
  menu.addSeparator();
  add(menu, "edit.copy", "&Copy Keys", QKeySequence::Copy, [this] { copy_keys(); });
  paste_ = add(menu, "edit.paste", "&Paste Keys", QKeySequence::Paste, [this] { paste_keys(); });
  QAction* const remove =
      add(menu, "edit.delete", "De&lete", QKeySequence::Delete, [this] { delete_selected(); });
  remove->setIcon(icon(Icon::Delete));
  menu.addSeparator();
  add(menu, "edit.select_all", "Select &All Cells", QKeySequence::SelectAll, [this] {
    std::vector<CellId> cells;
    for (const animation::Layer& layer : document_.project().layers)
      for (const animation::Cell& cell : layer.cells)
        if (layer.visible && !layer.locked) cells.push_back(cell.id);
    document_.select(std::move(cells));
  });
  add(menu, "edit.deselect", "Select &Nothing", QKeySequence("Ctrl+Shift+A"), [this] {
    document_.select_keys({});
    document_.select({});
  });
  add(menu, "edit.select_camera", "Select the Ca&mera", {},
      [this] { document_.select({animation::kCamera}); });
}

void CutoutWindow::make_cell_menu(QMenu& menu) {
  cell_menu_ = &menu;
  QAction* const pictures = add(menu, "cell.add", "&Add Cells from Pictures\u2026", QKeySequence("Ctrl+I"),
                                [this] { files_.choose_pictures(false); });
  pictures->setIcon(icon(Icon::Cell));
  add(menu, "cell.add_one", "Add &One Cell with Several Pictures\u2026", {},
      [this] { files_.choose_pictures(true); });
  of_selection_.push_back(add(menu, "cell.more", "&More Pictures for the Cell\u2026", {},
                              [this] { files_.choose_more_pictures(); }));
  add(menu, "cell.layer", "New &Layer", QKeySequence("Ctrl+Shift+N"), [this] { cells_->add_layer(); });
  menu.addSeparator();
  of_selection_.push_back(
      add(menu, "cell.rename", "&Rename", QKeySequence("F2"), [this] { cells_->rename(); }));
  of_selection_.push_back(
      add(menu, "cell.duplicate", "&Duplicate", QKeySequence("Ctrl+D"), [this] { duplicate_selected(); }));
  of_selection_.back()->setIcon(icon(Icon::Duplicate));
  of_selection_.push_back(add(menu, "cell.front", "Bring to the &Front", QKeySequence("Ctrl+]"),
                              [this] { cells_->move_chosen(1); }));
  of_selection_.push_back(add(menu, "cell.back", "Send to the &Back", QKeySequence("Ctrl+["),
                              [this] { cells_->move_chosen(-1); }));
  of_selection_.push_back(add(menu, "cell.delete", "D&elete", {}, [this] { cells_->delete_chosen(); }));
  menu.addSeparator();
  make_constraint_menu(*menu.addMenu("&Constraints"));
}

void CutoutWindow::make_constraint_menu(QMenu& menu) {
  const auto constrain = [&](const char* name, const char* text, Icon picture, const Act& act) {
    of_selection_.push_back(add(menu, name, text, {}, act));
    of_selection_.back()->setIcon(icon(picture));
  };
  constrain("cell.join", "&Join Two Cells", Icon::Joint, [this] { maker_->join(); });
  constrain("cell.chain", "&Chain to the Cell", Icon::Chain, [this] { maker_->chain(); });
  constrain("cell.distance", "Keep the &Distance", Icon::Distance, [this] { maker_->keep_distance(); });
  constrain("cell.path", "Follow a &Path", Icon::Way, [this] { maker_->guide_by_path(false); });
  constrain("cell.turning_path", "Follow a Path, &Turning", Icon::Way,
            [this] { maker_->guide_by_path(true); });
  constrain("cell.axis", "Stay on an &Axis", Icon::Axis, [this] { maker_->guide_by_axis(); });
  menu.addSeparator();
  constrain("cell.release", "&Release", Icon::Delete, [this] { maker_->release(); });
}

void CutoutWindow::make_frame_menu(QMenu& menu) {
  pose_ = add(menu, "frame.pose", "Next &Pose", QKeySequence("Space"), [this] { pose_and_go_on(); });
  pose_->setStatusTip("Keys what was moved, and goes on to the next frame");
  only_here(*pose_);
  make_key_menu(*menu.addMenu("&Keys"));
  menu.addSeparator();
  make_play_menu(menu);
  menu.addSeparator();
  make_step_menu(*menu.addMenu("&Go to"));
  add(menu, "frame.mark", "&Mark\u2026", QKeySequence("M"), [this] {
    // While it plays, beats are tapped.
    if (transport_.is_still()) return ask_mark(document_.frame());
    set_mark(document_.frame(), QString::fromUtf8("\u2022"));
  });
  of_still_.push_back(add(menu, "frame.insert", "&Insert a Frame", QKeySequence("Ctrl+Ins"), [this] {
    document_.perform(cutout_command("insert-frames", {{"frame", document_.frame()}}));
  }));
  of_still_.push_back(add(menu, "frame.remove", "Take the Frame &Out", QKeySequence("Ctrl+Del"), [this] {
    document_.perform(cutout_command("delete-frames", {{"frame", document_.frame()}}));
  }));
}

void CutoutWindow::make_key_menu(QMenu& menu) {
  key_menu_ = &menu;
  QAction* const hold = add(menu, "key.hold", "Set &Keys Here", QKeySequence("K"), [this] { hold_here(); });
  hold->setIcon(icon(Icon::AddKey));
  hold->setToolTip("Set keys of the selected cells here, so that they stay so");
  menu.addSeparator();
  add(menu, "key.ease_hold", "&Hold", QKeySequence("Alt+1"), [this] { ease_chosen(animation::Ease::Hold); });
  add(menu, "key.ease_straight", "&Straight", QKeySequence("Alt+2"),
      [this] { ease_chosen(animation::Ease::Straight); });
  add(menu, "key.ease_eased", "&Eased", QKeySequence("Alt+3"),
      [this] { ease_chosen(animation::Ease::Eased); });
  menu.addSeparator();
  add(menu, "key.copy", "&Copy", {}, [this] { copy_keys(); });
  add(menu, "key.paste", "&Paste Here", {}, [this] { paste_keys(); });
  add(menu, "key.delete", "&Delete Keys", QKeySequence("Shift+Del"), [this] {
    const KeyPlaces keys = document_.keys().empty()
                               ? keys_at(document_.project(), document_.selection(), document_.frame())
                               : document_.keys();
    document_.perform(deleted_keys(document_.project(), keys));
  });
}

void CutoutWindow::make_play_menu(QMenu& menu) {
  play_ = add(menu, "frame.play", "P&lay", QKeySequence("P"),
              [this] { transport_.is_still() ? transport_.play() : transport_.stop(); });
  stop_ = add(menu, "frame.stop", "S&top", QKeySequence("Esc"), [this] {
    transport_.stop();
    stage_->let_go();
  });
  QAction* const again = add(menu, "frame.again", "Play A&gain and Again", QKeySequence("L"), [] {});
  again->setCheckable(true);
  again->setIcon(icon(Icon::Again));
  connect(again, &QAction::toggled, this, [this](bool on) { transport_.play_again(on); });
  QAction* const sound = add(menu, "frame.sound", "With &Sound", QKeySequence("Ctrl+Shift+M"), [] {});
  sound->setCheckable(true);
  sound->setChecked(true);
  sound->setIcon(icon(Icon::Speaker));
  connect(sound, &QAction::toggled, this, [this](bool on) { transport_.set_sound(on); });
  record_ = add(menu, "frame.record", "&Record", QKeySequence("R"), [this] { record(false); });
  record_->setIcon(icon(Icon::Record));
  record_->setToolTip("Record what the hands or the mouse do, after a count-in");
  add(menu, "frame.record_layer", "Record This La&yer Only", QKeySequence("Shift+R"),
      [this] { record(true); });
  QAction* const count = add(menu, "frame.count_in", "&Count In", {}, [] {});
  count->setCheckable(true);
  count->setChecked(true);
  connect(count, &QAction::toggled, this, [this](bool on) { transport_.set_count_in(on ? 4 : 0); });
  runs_ = {again, record_, sound};
}

void CutoutWindow::make_step_menu(QMenu& menu) {
  const auto step = [&](const char* name, const char* text, const char* keys, Icon picture, const Act& act) {
    QAction* const made = add(menu, name, text, QKeySequence(keys), act);
    made->setIcon(icon(picture));
    made->setToolTip(QString("%1 (%2)").arg(QString(text).remove('&'), keys));
    steps_.push_back(made);
  };
  step("frame.first", "&First Frame", "Home", Icon::First, [this] { document_.go_to(0); });
  step("frame.previous_key", "Key Be&fore", "Ctrl+,", Icon::PreviousKey, [this] {
    if (const auto frame = key_before(document_.project(), document_.selection(), document_.frame()))
      document_.go_to(*frame);
  });
  step("frame.previous", "Frame &Before", ",", Icon::Previous,
       [this] { document_.go_to(document_.frame() - 1); });
  steps_.push_back(play_);
  step("frame.next", "&Next Frame", ".", Icon::Next, [this] { document_.go_to(document_.frame() + 1); });
  step("frame.next_key", "Next &Key", "Ctrl+.", Icon::NextKey, [this] {
    if (const auto frame = next_key(document_.project(), document_.selection(), document_.frame()))
      document_.go_to(*frame);
  });
  step("frame.last", "&Last Frame", "End", Icon::Last, [this] { document_.go_to(document_.last_frame()); });
}

void CutoutWindow::make_view_menu(QMenu& menu) {
  add(menu, "view.fit", "&Whole Stage", QKeySequence("Ctrl+0"), [this] {
    stage_->fit();
  })->setIcon(icon(Icon::ZoomToSelection));
  add(menu, "view.closer", "&Closer", QKeySequence::ZoomIn, [this] { stage_->zoom(kStageZoomStep); });
  add(menu, "view.farther", "&Farther", QKeySequence::ZoomOut,
      [this] { stage_->zoom(1.0 / kStageZoomStep); });
  menu.addSeparator();
  add_switch(menu, "view.onion", "&Onion Skin", QKeySequence("O"), look_.onion,
             "Shows the poses before and after faintly")
      ->setIcon(icon(Icon::Onion));
  add_switch(menu, "view.camera", "Through the Ca&mera", QKeySequence("C"), look_.through_camera,
             "Shows what the camera films")
      ->setIcon(icon(Icon::Camera));
  add_switch(menu, "view.camera_frame", "The Camera\u2019s F&rame", {}, look_.camera_frame,
             "Frames on the stage what the camera sees");
  add_switch(menu, "view.constraints", "Co&nstraints", {}, look_.constraints,
             "Draws joints, paths and the like");
  menu.addSeparator();
  add(menu, "view.timeline", "&Timeline", QKeySequence("F3"), [this] {
    time_->setCurrentWidget(timeline_);
    timeline_->setFocus();
  });
  add(menu, "view.sheet", "E&xposure Sheet", QKeySequence("F4"), [this] {
    time_->setCurrentWidget(sheet_);
    sheet_->setFocus();
  });
  add(menu, "view.watch", "&Watch the Table", QKeySequence("Ctrl+T"),
      [this] { table_->is_running() ? table_->stop() : table_->start(); });
  add(menu, "view.all_frames", "&All Frames", {}, [this] { timeline_->fit(); });
  add(menu, "view.longer", "Timeline Closer", QKeySequence("Ctrl+Shift++"),
      [this] { timeline_->zoom(kStageZoomStep); });
  add(menu, "view.shorter", "Timeline Farther", QKeySequence("Ctrl+Shift+-"),
      [this] { timeline_->zoom(1.0 / kStageZoomStep); });
  menu.addSeparator();
  for (QDockWidget* dock : findChildren<QDockWidget*>()) {
    dock->toggleViewAction()->setObjectName("view." + dock->objectName());
    menu.addAction(dock->toggleViewAction());
  }
}

void CutoutWindow::make_help_menu(QMenu& menu) {
  add(menu, "help.shortcuts", "&Keys and Mouse", QKeySequence("F1"), [this] {
    show_shortcuts();
  })->setIcon(icon(Icon::Help));
}

void CutoutWindow::make_bars() {
  QToolBar* const bar = addToolBar("Tools");
  bar->setObjectName("toolbar");
  bar->addActions({open_, save_});
  bar->addSeparator();
  bar->addActions({undo_, redo_});
  bar->addSeparator();
  bar->addActions({action("cell.add"), action("key.hold")});
  bar->addSeparator();
  bar->addActions({action("view.onion"), action("view.camera")});
  bar->addSeparator();
  bar->addActions({action("cell.join"), action("cell.chain"), action("cell.distance"), action("cell.path"),
                   action("cell.axis")});
  bar->addSeparator();
  bar->addAction(action("view.fit"));
  bar_->add_actions(steps_);
  bar_->add_actions(runs_);
  bar_->add_choices();
}

}  // namespace icome::ui
