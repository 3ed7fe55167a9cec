#include "ui/cutout/cutout_window.h"

#include <fmt/format.h>

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QInputDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QPainter>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QTabWidget>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/actions/actions.h"
#include "ui/cutout/document/export_dialog.h"
#include "ui/cutout/run_cutout.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/column_area.h"
#include "ui/panels/object_look.h"
#include "ui/window/connect_display.h"
#include "ui/window/shortcut_sheet.h"
#include "ui/window/window_settings.h"

namespace icome::ui {
namespace {

constexpr int kPanelWidth = 78 * kGrid;
constexpr int kTimeHeight = 62 * kGrid;
constexpr int kWordsStay = 6000;   // ms
constexpr int kValuesFollow = 60;  // ms
constexpr int kTitleHeight = 40;   // pixels that a window's frame may need
constexpr QSize kUsualSize(1360, 900);
constexpr const char* kRiskTopic = "risk";
const animation::Vector2 kCopyLiesBeside(12.0, 12.0);  // px
constexpr const char* kNoCutoutDisplayWays =
    "`icome animate` changes an animation without one, and exports it.";
constexpr const char* kHint =
    "Drag a cell to move it; the handles turn and scale it. Space: next pose. F1: all keys.";

/// The line edit takes the keys of undo and redo only for what is typed there and not yet entered: after
/// that they are the animation's.
bool leaves_to_window(const QLineEdit& field, const QKeyEvent& key) {
  return (key.matches(QKeySequence::Undo) && !field.isUndoAvailable()) ||
         (key.matches(QKeySequence::Redo) && !field.isRedoAvailable());
}

/// The style draws next to nothing around a flat button that has the keyboard's focus.
void paint_focus_ring(QToolButton& button) {
  QPainter painter(&button);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colours().accent, 1.6));
  painter.drawRoundedRect(QRectF(button.rect()).adjusted(1, 1, -1, -1), 3, 3);
}

ShortcutSheet::Part stage_part() {
  return {"On the stage",
          {{"Select a cell; more with Shift", "Click"},
           {"Select those within a frame", "Drag from an empty place"},
           {"Move; with Shift along one axis", "Drag a cell"},
           {"Turn; with Shift in steps of 15\u00b0", "Drag the round handle"},
           {"Scale", "Drag a corner"},
           {"Move the pivot", "Ctrl and drag the cross"},
           {"Move by 1 px, by 10 px", "Arrow keys, with Shift"},
           {"Zoom", "Wheel"},
           {"Shift the view", "Middle drag"},
           {"Back out", "Esc"}}};
}

ShortcutSheet::Part time_part() {
  return {"Timeline and exposure sheet",
          {{"Go to a frame", "Click or drag in the ruler"},
           {"Move keys", "Drag them"},
           {"Select keys; more with Shift", "Click, or drag a frame"},
           {"Zoom the timeline", "Ctrl and wheel"},
           {"Show channels", "Click the mark before a cell"},
           {"Write a mark", "Double click in its row or column"},
           {"Expose a picture in the sheet", "Its number and Enter; 0: none"},
           {"Choose from the list of pictures", "Enter or double click"}}};
}

}  // namespace

CutoutWindow::CutoutWindow(const QString& settings, QWidget* parent)
    : QMainWindow(parent),
      settings_(window_settings(settings, "animation")),
      recent_(*settings_),
      files_(document_, *this),
      transport_(document_),
      sounds_([this](const SoundLoader::Loaded& loaded) {
        transport_.use_samples(loaded.samples);
        timeline_->show_sound(loaded.shape);
        sheet_->show_sound(loaded.shape);
        if (!loaded.problem.empty())
          tell({.weight = Note::Weight::Warning, .text = loaded.problem, .topic = "sound"});
      }) {
  setObjectName("cutout");
  make_center();
  make_docks();
  make_status();
  make_file_menu(*menuBar()->addMenu("&File"));
  make_edit_menu(*menuBar()->addMenu("&Edit"));
  make_cell_menu(*menuBar()->addMenu("&Cell"));
  make_frame_menu(*menuBar()->addMenu("F&rame"));
  make_view_menu(*menuBar()->addMenu("&View"));
  make_help_menu(*menuBar()->addMenu("&Help"));
  make_bars();
  files_.on_note([this](const Note& note) { tell(note); });
  files_.on_used([this](const std::filesystem::path& file) {
    recent_.add(file);
    fill_recent();
  });
  files_.on_progress([this](double part) {
    if (part < 0.0) return banner_->hide_progress();
    banner_->show_progress("Exporting the animation", part, [this] { files_.cancel_export(); });
  });
  document_.on_change([this](CutoutChange change) { hear(change); });
  document_.on_remark([this](const std::string& remark) { tell_remark(remark); });
  document_.on_risk([this](const std::string& risk) {
    if (risk.empty()) return banner_->forget(kRiskTopic);
    tell({.weight = Note::Weight::Warning, .text = risk, .topic = kRiskTopic});
  });
  transport_.on_state([this] { show_state(); });
  late_values_.setSingleShot(true);
  late_values_.setInterval(kValuesFollow);
  connect(&late_values_, &QTimer::timeout, this, [this] { cell_->refresh(); });
  resize(kUsualSize.boundedTo(screen()->availableSize() - QSize(0, kTitleHeight)));
  resizeDocks(findChildren<QDockWidget*>(), {kPanelWidth, kPanelWidth, kPanelWidth, kPanelWidth},
              Qt::Horizontal);
  for (QLineEdit* field : findChildren<QLineEdit*>()) field->installEventFilter(this);
  for (QToolButton* button : findChildren<QToolButton*>()) button->installEventFilter(this);
  show_project();
  show_state();
  stage_->setFocus();
}

CutoutWindow::~CutoutWindow() {
  transport_.stop();
  // Parts of the window hear of the focus that leaves them, and need the document for that.
  hide();
  document_.on_change([](CutoutChange) {});
  document_.on_risk([](const std::string&) {});
  transport_.on_state([] {});
  delete takeCentralWidget();
  qDeleteAll(findChildren<QDockWidget*>());
}

// Making.

void CutoutWindow::make_center() {
  auto* center = new QWidget(this);
  banner_ = new Banner(center);
  stage_ = new StageView(document_, look_, center);
  stage_->on_pointer([this](const animation::Vector2& place) {
    place_->setText(QString("%1, %2 px").arg(place.x(), 0, 'f', 0).arg(place.y(), 0, 'f', 0));
  });
  stage_->on_drop([this](const std::vector<std::filesystem::path>& files) { files_.take_dropped(files); });
  stage_->on_question(
      [this](const QString& question) { hint_->setText(question.isEmpty() ? QString(kHint) : question); });
  stage_->on_menu([this](QPoint at) { cell_menu_->popup(at); });
  bar_ = new PlayBar(document_, look_, center);
  bar_->on_look([this] { apply_look(); });
  auto* rows = new QVBoxLayout(center);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  rows->addWidget(banner_);
  rows->addWidget(stage_, 1);
  rows->addWidget(bar_);
  setCentralWidget(center);
}

void CutoutWindow::make_docks() {
  setCorner(Qt::BottomRightCorner, Qt::RightDockWidgetArea);
  const auto dock = [this](const char* name, const QString& title, QWidget* content,
                           Qt::DockWidgetArea area) {
    auto* made = new QDockWidget(title, this);
    made->setObjectName(name);
    made->setWidget(content);
    addDockWidget(area, made);
    // A dock behind another lies out of sight, and the Tab key would still go there.
    connect(made, &QDockWidget::visibilityChanged, content,
            [content](bool is_seen) { content->setEnabled(is_seen); });
    return made;
  };
  cells_ = new CellTree(document_, this);
  cells_->on_add([this] { files_.choose_pictures(false); });
  cells_->on_import([this] { files_.choose_folder(true); });
  dock("dock.cells", "Layers and Cells", cells_, Qt::RightDockWidgetArea);
  auto* column = new ColumnArea(this);
  auto* panels = new QWidget(column);
  auto* rows = new QVBoxLayout(panels);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  cell_ = new CellPanel(document_, panels);
  maker_ = std::make_unique<ConstraintMaker>(document_, *stage_);
  constraints_ = new ConstraintPanel(document_, *maker_, panels);
  stage_panel_ = new StagePanel(document_, look_, panels);
  stage_panel_->on_look([this] { apply_look(); });
  rows->addWidget(cell_);
  rows->addWidget(constraints_);
  rows->addWidget(stage_panel_);
  rows->addStretch();
  column->setWidget(panels);
  column->setWidgetResizable(true);
  QDockWidget* const values = dock("dock.values", "Values", column, Qt::RightDockWidgetArea);
  auto* beside = new ColumnArea(this);
  table_ = new TablePanel(document_, *settings_, beside);
  beside->setWidget(table_);
  beside->setWidgetResizable(true);
  tabifyDockWidget(values, dock("dock.table", "Table", beside, Qt::RightDockWidgetArea));
  values->raise();
  stage_->on_painted([this] { table_->painted(); });
  time_ = new QTabWidget(this);
  time_->setObjectName("time");
  time_->setDocumentMode(true);
  timeline_ = new Timeline(document_, time_);
  timeline_->on_menu([this](QPoint at) { key_menu_->popup(at); });
  timeline_->on_mark([this](int frame) { ask_mark(frame); });
  sheet_ = new ExposureSheet(document_, time_);
  sheet_->on_mark([this](int frame) { ask_mark(frame); });
  time_->addTab(timeline_, "Timeline");
  time_->addTab(sheet_, "Exposure sheet");
  QDockWidget* const below = dock("dock.time", "Time", time_, Qt::BottomDockWidgetArea);
  resizeDocks({below}, {kTimeHeight}, Qt::Vertical);
}

void CutoutWindow::make_status() {
  const auto label = [this](const char* name, const char* meaning) {
    auto* made = new QLabel(this);
    made->setObjectName(name);
    made->setAccessibleName(meaning);
    return made;
  };
  hint_ = label("status.hint", "Hint");
  hint_->setText(kHint);
  place_ = label("status.place", "Place on the stage");
  count_ = label("status.count", "Cells and keys");
  statusBar()->addWidget(hint_, 1);
  statusBar()->addPermanentWidget(place_);
  statusBar()->addPermanentWidget(count_);
}

QAction* CutoutWindow::action(const char* name) const { return findChild<QAction*>(name); }

// Showing.

void CutoutWindow::hear(CutoutChange change) {
  switch (change) {
    case CutoutChange::Project:
      return show_project();
    case CutoutChange::Frame:
      return show_frame();
    case CutoutChange::Pose:
      stage_->show_moved();
      // Fields need not follow each move of a hand.
      if (!late_values_.isActive()) late_values_.start();
      return;
    case CutoutChange::Selection:
      return show_selection();
  }
}

void CutoutWindow::show_project() {
  const animation::Project& project = document_.project();
  sounds_.follow(document_);
  stage_->refresh();
  cells_->refresh();
  timeline_->refresh();
  sheet_->refresh();
  constraints_->refresh();
  stage_panel_->refresh();
  table_->refresh();
  std::size_t keys = 0;
  for (const animation::Cell* cell : cells_from_front(project))
    for (const animation::Track& track : cell->tracks) keys += track.size();
  const std::size_t cells = project.cell_count();
  count_->setText(QString("%L1 %2, %L3 %4")
                      .arg(cells)
                      .arg(cells == 1 ? "cell" : "cells")
                      .arg(keys)
                      .arg(keys == 1 ? "key" : "keys"));
  action("file.silence")->setEnabled(project.sound.has_value());
  if (!document_.is_modified()) banner_->forget(kRecoveredTopic);
  show_title();
  show_frame();
  show_selection();
}

void CutoutWindow::show_frame() {
  table_->follow_frame();
  stage_->follow_frame();
  timeline_->follow_frame();
  sheet_->follow_frame();
  bar_->refresh();
  cell_->refresh();
}

void CutoutWindow::show_selection() {
  cells_->follow_selection();
  cell_->refresh();
  timeline_->viewport()->update();
  sheet_->viewport()->update();
  stage_->update();
  for (QAction* it : of_selection_) it->setEnabled(!document_.selection().empty());
}

void CutoutWindow::show_title() {
  setWindowTitle(files_.name() + "[*] - ICOME");
  setWindowModified(document_.is_modified());
  const bool is_still = transport_.is_still();
  undo_->setEnabled(is_still && document_.can_undo());
  redo_->setEnabled(is_still && document_.can_redo());
}

void CutoutWindow::show_state() {
  const Transport::State state = transport_.state();
  const bool is_still = transport_.is_still();
  play_->setText(is_still ? "P&lay" : "S&top");
  play_->setIcon(icon(is_still ? Icon::Play : Icon::Pause));
  play_->setToolTip(is_still ? "Play (P)" : "Stop (P)");
  const bool records = state == Transport::State::CountIn || state == Transport::State::Recording;
  stage_->show_words(transport_.beats() > 0 ? QString::number(transport_.beats()) : QString());
  stage_->show_recording(records);
  for (QAction* it : of_still_) it->setEnabled(is_still);
  stop_->setEnabled(!is_still);  // else Esc backs out of other things
  record_->setEnabled(is_still || records);
  action("frame.record_layer")->setEnabled(is_still);
  show_title();
}

void CutoutWindow::apply_look() { stage_->refresh(); }

void CutoutWindow::tell(const Note& note) {
  banner_->forget(note.topic);
  // A banner that comes and goes by itself would move the stage under the mouse.
  note.weight == Note::Weight::Passing ? statusBar()->showMessage(one_line(note.text), kWordsStay)
                                       : banner_->tell(note);
}

void CutoutWindow::tell_remark(const std::string& remark) {
  remark.empty() ? statusBar()->clearMessage() : statusBar()->showMessage(one_line(remark), kWordsStay);
}

// Deeds of the menus.

void CutoutWindow::pose_and_go_on() {
  if (!transport_.is_still()) return transport_.stop();
  document_.keep();
  const int next = document_.frame() + look_.step;
  if (next > document_.last_frame() && next < animation::kLongestAnimation) {
    animation::Stage longer = document_.project().stage;
    longer.length = next + 1;
    document_.perform(animation::ProjectEdit{animation::ChangeStage{longer}});
  }
  document_.go_to(next);
}

void CutoutWindow::hold_here() {
  if (document_.tried()) document_.keep();
  if (document_.selection().empty()) return document_.remark("Select the cells that are to get keys.");
  document_.perform(held_keys(document_.project(), document_.selection(),
                              {animation::kAllChannels.begin(), animation::kAllChannels.end()},
                              document_.frame()));
}

void CutoutWindow::ease_chosen(animation::Ease ease) {
  const KeyPlaces keys = document_.keys().empty()
                             ? keys_at(document_.project(), document_.selection(), document_.frame())
                             : document_.keys();
  if (keys.empty()) return document_.remark("There is no key here. Select keys in the timeline.");
  document_.perform(eased_keys(document_.project(), keys, ease));
}

void CutoutWindow::copy_keys() {
  const KeyPlaces keys = document_.keys().empty()
                             ? keys_at(document_.project(), document_.selection(), document_.frame())
                             : document_.keys();
  if (keys.empty()) return document_.remark("There is no key here. Select keys in the timeline.");
  copied_ = copied_keys(document_.project(), keys);
  document_.remark(fmt::format("Copied {} {}.", keys.size(), keys.size() == 1 ? "key" : "keys"));
}

void CutoutWindow::paste_keys() {
  if (copied_.pieces.empty()) return document_.remark("Copy keys first.");
  document_.perform(pasted_keys(document_.project(), copied_, document_.frame(), document_.selection()));
}

void CutoutWindow::delete_selected() {
  const QWidget* const focus = QApplication::focusWidget();
  const auto is_in = [&](const QWidget* part) {
    return focus == part || (focus != nullptr && part->isAncestorOf(focus));
  };
  if (is_in(sheet_)) {
    const animation::Cell* const cell = document_.leading();
    if (cell != nullptr)
      document_.perform(deleted_keys(document_.project(), {{cell->id, Channel::Picture, document_.frame()}}));
    return;
  }
  if (is_in(timeline_) || document_.selection().empty()) {
    if (!document_.keys().empty()) document_.perform(deleted_keys(document_.project(), document_.keys()));
    return;
  }
  cells_->delete_chosen();
}

void CutoutWindow::duplicate_selected() {
  std::vector<CellId> copies;
  document_.as_one_step([&] {
    for (const CellId id : std::vector<CellId>(document_.selection())) {
      if (id == animation::kCamera) continue;
      const std::uint64_t first = document_.next_id();
      if (!document_.perform(cutout_command("copy-cell", {{"cell", document_.project().find(id)->name}})))
        continue;
      // A layer may have been made for it before.
      const CellId copy{document_.next_id() - 1};
      if (copy.value < first) continue;
      document_.perform(shifted_cell(document_.project(), copy, kCopyLiesBeside));
      copies.push_back(copy);
    }
  });
  if (!copies.empty()) document_.select(copies);
}

void CutoutWindow::record(bool only_layer) {
  if (!transport_.is_still()) return transport_.stop();
  std::optional<animation::LayerId> layer;
  if (only_layer) {
    const animation::Cell* const cell = document_.leading();
    const animation::Layer* const its = cell ? document_.project().layer_of(cell->id) : nullptr;
    if (its == nullptr) return document_.remark("Select a cell of the layer that is to be recorded.");
    layer = its->id;
  }
  transport_.record(layer);
}

void CutoutWindow::set_mark(int frame, const QString& text) {
  const std::string words = text.trimmed().toStdString();
  animation::ChangeMark change{.frame = frame, .text = std::nullopt};
  if (!words.empty()) change.text = words;
  document_.perform(animation::ProjectEdit{change});
}

void CutoutWindow::ask_mark(int frame) {
  auto* dialog = new QInputDialog(this);
  dialog->setObjectName("cutout.mark");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setWindowTitle("Mark");
  dialog->setLabelText(
      QString("Word at frame %1, such as a sound of speech; empty takes it away:").arg(frame));
  for (const animation::Mark& mark : document_.project().marks)
    if (mark.frame == frame) dialog->setTextValue(QString::fromStdString(mark.text));
  connect(dialog, &QInputDialog::textValueSelected, this,
          [=, this](const QString& text) { set_mark(frame, text); });
  dialog->open();
}

void CutoutWindow::choose_export() {
  if (document_.project().cell_count() == 0) return document_.remark("There is nothing to export yet.");
  auto* dialog = new ExportDialog(document_.project(), this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->on_choice([this](const animation::ExportOptions& options) { files_.choose_and_export(options); });
  dialog->open();
}

void CutoutWindow::show_shortcuts() {
  std::vector<ShortcutSheet::Part> parts = {stage_part(), time_part()};
  const auto add_part = [&](const QString& heading, const QMenu& menu) {
    auto part = ShortcutSheet::of_actions(heading, menu.actions());
    if (!part.rows.empty()) parts.push_back(std::move(part));
  };
  for (QAction* it : menuBar()->actions()) {
    add_part(it->text().remove('&'), *it->menu());
    for (QAction* below : it->menu()->actions())
      if (below->menu() && below->menu() != recent_menu_) add_part(below->text().remove('&'), *below->menu());
  }
  auto* sheet = new ShortcutSheet(parts, this);
  sheet->setAttribute(Qt::WA_DeleteOnClose);
  sheet->open();
}

// Closing and opening.

void CutoutWindow::offer_lost() {
  lost_ = lost_animations();
  if (lost_.empty()) return;
  banner_->on_remedy([this](const Note& note, Note::Remedy remedy) {
    if (remedy == Note::Remedy::DiscardJournal) return forget_lost_animation(note.journal);
    if (remedy != Note::Remedy::Recover) return;
    files_.when_safe([this, kept = note.journal] {
      const auto recovered = document_.recover(kept);
      if (!recovered)
        return tell({.weight = Note::Weight::Error, .text = recovered.error().message, .topic = "file"});
      tell({.text = "Your work was recovered. Save it to keep it.", .topic = "file"});
    });
  });
  for (const std::filesystem::path& kept : lost_) {
    std::error_code error;
    const auto written = std::filesystem::last_write_time(animation::journal_of(kept), error);
    const auto when = std::chrono::time_point_cast<std::chrono::system_clock::duration>(
        std::chrono::file_clock::to_sys(error ? std::filesystem::last_write_time(kept, error) : written));
    banner_->tell({.weight = Note::Weight::Warning,
                   .text = "There is work on an animation from " +
                           time_text(when, std::chrono::system_clock::now()) + " that was never saved.",
                   .topic = kept.string(),
                   .remedies = {Note::Remedy::Recover, Note::Remedy::DiscardJournal},
                   .journal = kept});
  }
}

void CutoutWindow::closeEvent(QCloseEvent* event) {
  transport_.stop();
  // Text that is being typed is entered now: after the journal has ended it would be lost, or kept for
  // nothing.
  if (qobject_cast<QLineEdit*>(focusWidget()) != nullptr) stage_->setFocus();
  if (!agreed_ && document_.is_modified()) {
    event->ignore();
    return files_.when_safe([this] {
      agreed_ = true;
      close();
    });
  }
  if (files_.is_exporting() && !stops_export_) {
    event->ignore();
    return ask_to_stop_export();
  }
  files_.cancel_export();
  document_.close_for_good();
  event->accept();
}

void CutoutWindow::ask_to_stop_export() {
  auto* box = new QMessageBox(QMessageBox::Question, "Stop the Export?", "An export is under way.",
                              QMessageBox::NoButton, this);
  box->setObjectName("cutout.stop_export");
  box->setInformativeText("If it is stopped, nothing of it is written.");
  const auto* stop = box->addButton("&Stop the Export and Close", QMessageBox::DestructiveRole);
  box->setDefaultButton(box->addButton("&Go On", QMessageBox::RejectRole));
  box->setAttribute(Qt::WA_DeleteOnClose);
  connect(box, &QMessageBox::finished, this, [=, this] {
    // Work that is done from now on is to be asked for again.
    stops_export_ = agreed_ = box->clickedButton() == stop;
    if (stops_export_) close();
  });
  box->open();
}

bool CutoutWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ShortcutOverride) {
    const auto* const field = qobject_cast<QLineEdit*>(watched);
    if (field == nullptr || !leaves_to_window(*field, static_cast<const QKeyEvent&>(*event))) return false;
    event->ignore();
    return true;
  }
  auto* const button = qobject_cast<QToolButton*>(watched);
  if (event->type() != QEvent::Paint || button == nullptr || !button->hasFocus()) return false;
  watched->event(event);
  paint_focus_ring(*button);
  return true;
}

void open_cutout_window(const std::filesystem::path& file) {
  auto* window = new CutoutWindow;
  window->setAttribute(Qt::WA_DeleteOnClose);
  window->show();
  if (!file.empty()) window->open(file);
  window->offer_lost();
}

void choose_cutout(QWidget& parent) {
  auto* dialog = new QFileDialog(&parent, "Open an Animation");
  dialog->setObjectName("cutout.open");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(cutout_open_filters());
  QObject::connect(dialog, &QFileDialog::fileSelected, &parent,
                   [](const QString& path) { open_cutout_window(path_of(path)); });
  dialog->open();
}

int run_cutout_window(int argc, char** argv, const CutoutWindowOptions& options) {
  const auto application = connect_display(argc, argv, kNoCutoutDisplayWays);
  if (!application) return 1;
  const std::string kept = QSettings("icome", "icome").value("theme").toString().toStdString();
  apply_theme(*application, theme_of(options.theme.empty() ? kept : options.theme).value_or(Theme::System));
  open_cutout_window(options.file);
  return QApplication::exec();
}

}  // namespace icome::ui
