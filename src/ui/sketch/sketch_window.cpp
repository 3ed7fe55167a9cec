#include "ui/sketch/sketch_window.h"

#include <QActionGroup>
#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QFileDialog>
#include <QLabel>
#include <QMenuBar>
#include <QSettings>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <cmath>

#include "ui/actions/actions.h"
#include "ui/actions/recent_files.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/column_area.h"
#include "ui/panels/object_look.h"
#include "ui/sketch/kept_look.h"
#include "ui/sketch/run_sketch.h"
#include "ui/window/connect_display.h"
#include "ui/window/shortcut_sheet.h"
#include "ui/window/window_settings.h"

namespace icome::ui {
namespace {

/// Counts up when docks and bars change, so that old layouts are not restored.
constexpr int kSketchLayout = 1;

struct SketchToolEntry {
  SketchToolKind tool;
  Icon icon;
  const char* name;
  const char* text;
  const char* keys;
  const char* hint;
};
constexpr SketchToolEntry kSketchTools[] = {
    {SketchToolKind::Pen, Icon::Pen, "tool.pen", "&Pen", "P", "Draw a stroke"},
    {SketchToolKind::Eraser, Icon::Eraser, "tool.eraser", "&Eraser", "E",
     "Take away what the circle passes over"},
    {SketchToolKind::Pull, Icon::Pull, "tool.pull", "Pu&ll", "G", "Drag a line by a place of it"},
    {SketchToolKind::Lasso, Icon::Lasso, "tool.lasso", "L&asso", "L",
     "Draw around points to select them; drag within the frame to move (Ctrl: turn and scale)"},
    {SketchToolKind::Select, Icon::Select, "tool.select", "&Select by Touching", "S",
     "Touch strokes to select them (Shift: more); drag within the frame to move (Ctrl: turn and scale)"},
    {SketchToolKind::Width, Icon::LineWidth, "tool.width", "&Width", "W",
     "Drag up from a line to make it wider there, down for narrower; with a pen, by its pressure"},
    {SketchToolKind::Connect, Icon::Connect, "tool.connect", "&Connect", "C",
     "Drag an end of a line to another end"},
    {SketchToolKind::Fill, Icon::Fill, "tool.fill", "&Fill", "F",
     "Click within a line to fill it (Shift: empty it)"},
};
constexpr int kDockWidth = 75 * kGrid;
constexpr double kZoomStep = 1.25;
constexpr double kTurnStep = 15.0;  // degrees
constexpr int kRemarkStays = 6000;  // ms
constexpr int kPenNews = 500;       // ms
constexpr const char* kNoSketchDisplayWays =
    "`icome sketch edit` changes a drawing without one, and `icome sketch render` makes a picture of it.";

const SketchToolEntry& sketch_entry(SketchToolKind tool) { return kSketchTools[std::size_t(tool)]; }

ShortcutSheet::Part paper_part() {
  return {"On the paper",
          {{"Zoom", "Wheel"},
           {"Shift the paper", "Middle drag, or Space and drag"},
           {"Turn the paper", "hold R and turn the wheel"},
           {"Select more", "Shift"},
           {"Turn and scale what is selected", "Ctrl and drag within its frame"},
           {"Move what is selected by 1 mm, by 10 mm", "Arrow keys, with Shift"},
           {"Back out", "Esc"}}};
}

std::size_t segments_in(const drawing::Drawing& drawing) {
  std::size_t segments = 0;
  for (const drawing::Layer& layer : drawing.layers)
    for (const drawing::StrokePointer& stroke : layer.strokes) segments += stroke->curve.segments.size();
  return segments;
}

}  // namespace

SketchWindow::SketchWindow(const QString& settings, QWidget* parent)
    : QMainWindow(parent), settings_(window_settings(settings, "drawing")), files_(document_, *this) {
  setObjectName("sketch");
  take_kept_look(*settings_, look_);
  make_center();
  make_docks();
  make_status();
  make_file_menu(*menuBar()->addMenu("&File"));
  make_edit_menu(*menuBar()->addMenu("&Edit"));
  make_stroke_menu(*menuBar()->addMenu("&Stroke"));
  make_view_menu(*menuBar()->addMenu("&View"));
  make_tool_menu(*menuBar()->addMenu("&Tools"));
  QMenu* const help = menuBar()->addMenu("&Help");
  add_action(*help, "help.shortcuts", "&Keys and Mouse", QKeySequence("F1"), [this] {
    show_shortcuts();
  })->setIcon(icon(Icon::Help));
  make_tool_bar();
  files_.on_note([this](const Note& note) {
    banner_->forget(note.topic);
    // A banner that comes and goes by itself would move the paper under the pen.
    note.weight == Note::Weight::Passing ? statusBar()->showMessage(one_line(note.text), kRemarkStays)
                                         : banner_->tell(note);
  });
  document_.on_change([this] { show_document(); });
  document_.on_remark([this](const std::string& remark) {
    remark.empty() ? statusBar()->clearMessage() : statusBar()->showMessage(one_line(remark), kRemarkStays);
  });
  resize(1200, 800);
  restoreGeometry(settings_->value("window/geometry").toByteArray());
  restoreState(settings_->value("window/state").toByteArray(), kSketchLayout);
  show_document();
  show_hint();
  canvas_->setFocus();
}

SketchWindow::~SketchWindow() {
  canvas_->take_pen(nullptr);
  keep_look(look_, *settings_);
  settings_->setValue("window/geometry", saveGeometry());
  settings_->setValue("window/state", saveState(kSketchLayout));
}

void SketchWindow::make_center() {
  auto* center = new QWidget(this);
  banner_ = new Banner(center);
  canvas_ = new SketchCanvas(document_, look_, center);
  canvas_->on_pointer([this](const PenInput& input) { show_pointer(input); });
  auto* rows = new QVBoxLayout(center);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  rows->addWidget(banner_);
  rows->addWidget(canvas_, 1);
  setCentralWidget(center);
}

void SketchWindow::make_docks() {
  const auto add = [this](const char* name, const QString& title, QWidget* content) {
    auto* dock = new QDockWidget(title, this);
    dock->setObjectName(name);
    dock->setWidget(content);
    addDockWidget(Qt::RightDockWidgetArea, dock);
  };
  auto* column = new ColumnArea(this);
  pen_ = new PenPanel(document_, look_, column);
  pen_->on_change([this] { canvas_->update(); });
  column->setWidget(pen_);
  column->setWidgetResizable(true);
  add("dock.pen", "Pen", column);
  layers_ = new LayerPanel(document_, this);
  add("dock.layers", "Layers", layers_);
  resizeDocks(findChildren<QDockWidget*>(), {kDockWidth, kDockWidth}, Qt::Horizontal);
}

void SketchWindow::make_status() {
  hint_ = new QLabel(this);
  hint_->setObjectName("status.hint");
  place_ = new QLabel(this);
  place_->setObjectName("status.place");
  place_->setAccessibleName("Place on the paper");
  count_ = new QLabel(this);
  count_->setObjectName("status.count");
  statusBar()->addWidget(hint_, 1);
  statusBar()->addPermanentWidget(place_);
  statusBar()->addPermanentWidget(count_);
}

void SketchWindow::make_file_menu(QMenu& menu) {
  add_action(menu, "file.new", "&New Drawing", QKeySequence::New, [] {
    open_sketch_window({});
  })->setIcon(icon(Icon::New));
  open_ =
      add_action(menu, "file.open", "&Open\u2026", QKeySequence::Open, [this] { files_.choose_and_open(); });
  open_->setIcon(icon(Icon::Open));
  menu.addSeparator();
  save_ = add_action(menu, "file.save", "&Save", QKeySequence::Save, [this] { files_.save(); });
  save_->setIcon(icon(Icon::Save));
  add_action(menu, "file.save_as", "Save &As\u2026", QKeySequence("Ctrl+Shift+S"),
             [this] { files_.save_as(); });
  add_action(menu, "file.export", "&Export a Picture\u2026", QKeySequence("Ctrl+E"),
             [this] { files_.choose_and_export(); });
  menu.addSeparator();
  add_action(menu, "file.close", "&Close", QKeySequence("Ctrl+Q"), [this] { close(); });
}

void SketchWindow::add_command(QMenu& menu, const char* name, const char* text, const QKeySequence& keys,
                               const SketchDocument::Command& what) {
  of_selection_.push_back(add_action(menu, name, text, keys, [this, what] { document_.perform(what); }));
}

void SketchWindow::make_edit_menu(QMenu& menu) {
  undo_ = add_action(menu, "edit.undo", "&Undo", QKeySequence::Undo,
                     [this] { canvas_->is_busy() ? canvas_->back_out() : document_.undo(); });
  undo_->setIcon(icon(Icon::Undo));
  redo_ = add_action(menu, "edit.redo", "&Redo", QKeySequence::Redo, [this] { document_.redo(); });
  redo_->setShortcuts({QKeySequence("Ctrl+Shift+Z"), QKeySequence("Ctrl+Y")});
  redo_->setIcon(icon(Icon::Redo));
  menu.addSeparator();
  add_action(menu, "edit.select_all", "Select &All", QKeySequence::SelectAll,
             [this] { document_.perform(command("select-all")); });
  add_command(menu, "edit.deselect", "Select &Nothing", QKeySequence("Ctrl+Shift+A"), command("deselect"));
  add_command(menu, "edit.duplicate", "&Duplicate", QKeySequence("Ctrl+D"),
              command("copy", {{"by", interaction::Value::List{5.0, 5.0}}}));
  add_command(menu, "edit.delete", "De&lete", QKeySequence::Delete, command("delete"));
  of_selection_.back()->setIcon(icon(Icon::Delete));
}

void SketchWindow::make_stroke_menu(QMenu& menu) {
  add_command(menu, "stroke.smooth", "&Smooth", {}, command("smooth"));
  add_command(menu, "stroke.close", "&Close", {}, command("close"));
  add_command(menu, "stroke.flip_across", "Flip &Left and Right", {},
              command("flip", {{"way", "left-right"}}));
  add_command(menu, "stroke.flip_down", "Flip &Up and Down", {}, command("flip", {{"way", "up-down"}}));
  add_command(menu, "stroke.align", "&Align to 5 mm", {}, command("align", {{"grid", 5.0}}));
  add_command(menu, "stroke.empty", "Without &Fill", {}, command("fill"));
  menu.addSeparator();
  add_action(menu, "stroke.connect", "C&onnect All Near Ends", {},
             [this] { document_.perform(command("connect")); });
}

void SketchWindow::add_switch(QMenu& menu, const char* name, const char* text, const char* tip, bool& flag) {
  QAction* const action = add_action(menu, name, text, {}, [] {});
  action->setCheckable(true);
  action->setChecked(flag);
  action->setStatusTip(tip);
  connect(action, &QAction::toggled, this, [this, &flag](bool on) {
    flag = on;
    canvas_->refresh();
  });
}

void SketchWindow::make_view_menu(QMenu& menu) {
  fit_ = add_action(menu, "view.fit", "&Whole Paper", QKeySequence("Ctrl+0"), [this] { canvas_->fit(); });
  fit_->setIcon(icon(Icon::ZoomToSelection));
  add_action(menu, "view.closer", "&Closer", QKeySequence::ZoomIn, [this] { canvas_->zoom(kZoomStep); });
  add_action(menu, "view.farther", "&Farther", QKeySequence::ZoomOut,
             [this] { canvas_->zoom(1.0 / kZoomStep); });
  add_action(menu, "view.turn_left", "Turn &Left", QKeySequence("Ctrl+Left"),
             [this] { canvas_->turn(-kTurnStep); });
  add_action(menu, "view.turn_right", "Turn &Right", QKeySequence("Ctrl+Right"),
             [this] { canvas_->turn(kTurnStep); });
  menu.addSeparator();
  add_switch(menu, "view.predict", "&Predict the Pen",
             "Shows the running line where the pen will be in a frame; the drawing has it as it was",
             look_.predict);
  add_switch(menu, "view.onion", "What &Was Before", "Shows faintly what the last change took away",
             look_.onion);
  add_switch(menu, "view.attract", "&Attract to Grid and Angle",
             "Draws what is moved to a grid of 5 mm, and what is turned to steps of 15\u00b0; dragging on "
             "resists it",
             look_.attract);
  add_switch(menu, "view.force", "F&orce", "Shows as an arrow the force that resists what is dragged",
             look_.force);
  menu.addSeparator();
  for (QDockWidget* dock : findChildren<QDockWidget*>()) menu.addAction(dock->toggleViewAction());
}

void SketchWindow::make_tool_menu(QMenu& menu) {
  tools_ = new QActionGroup(this);
  for (const SketchToolEntry& it : kSketchTools) {
    QAction* const action = add_action(menu, it.name, it.text, QKeySequence(it.keys), [this, &it] {
      canvas_->choose(it.tool);
      show_hint();
    });
    action->setIcon(icon(it.icon));
    action->setCheckable(true);
    action->setToolTip(QString("%1 (%2): %3").arg(QString(it.text).remove('&'), it.keys, it.hint));
    tools_->addAction(action);
  }
  tools_->actions().front()->setChecked(true);
}

void SketchWindow::make_tool_bar() {
  QToolBar* const bar = addToolBar("Tools");
  bar->setObjectName("toolbar");
  bar->addActions({open_, save_});
  bar->addSeparator();
  bar->addActions({undo_, redo_});
  bar->addSeparator();
  bar->addActions(tools_->actions());
  bar->addSeparator();
  bar->addAction(fit_);
}

void SketchWindow::show_document() {
  setWindowTitle(files_.name() + "[*] - ICOME");
  setWindowModified(document_.is_modified());
  undo_->setEnabled(document_.can_undo());
  redo_->setEnabled(document_.can_redo());
  for (QAction* action : of_selection_) action->setEnabled(!document_.selection().empty());
  const drawing::Drawing& drawing = document_.drawing();
  const std::size_t strokes = drawing.stroke_count();
  const std::size_t segments = segments_in(drawing);
  count_->setText(QString("%L1 %2, %L3 %4")
                      .arg(strokes)
                      .arg(strokes == 1 ? "stroke" : "strokes")
                      .arg(segments)
                      .arg(segments == 1 ? "segment" : "segments"));
  layers_->refresh();
  canvas_->refresh();
}

void SketchWindow::show_pointer(const PenInput& input) {
  constexpr double kMmOfMetres = 1000.0;
  const auto number = [](double value) { return QString::number(kMmOfMetres * value, 'f', 1); };
  QString text = QString("%1, %2 mm").arg(number(input.place.x()), number(input.place.y()));
  if (input.is_pen) {
    constexpr double kDegreesOfRadians = 57.29577951308232;
    text += QString(", pen %1 %, %2\u00b0 aslant")
                .arg(std::lround(100.0 * input.pressure))
                .arg(std::lround(kDegreesOfRadians * input.tilt));
  }
  place_->setText(text);
}

void SketchWindow::take_pen(std::unique_ptr<sketch::FeltPen> pen) {
  felt_pen_ = std::move(pen);
  canvas_->take_pen(felt_pen_.get());
  pen_->offer_papers(felt_pen_->paper().name, [this](const sketch::Paper& paper) { felt_pen_->lay(paper); });
  auto* device = new QLabel(this);
  device->setObjectName("status.pen");
  device->setText(QString("%1, 1 : %2")
                      .arg(QString::fromStdString(felt_pen_->info().name))
                      .arg(felt_pen_->scale(), 0, 'g', 2));
  device->setToolTip("The pen that pushes back, and how much farther it goes on the paper than in the hand");
  statusBar()->addPermanentWidget(device);
  connect(&pen_news_, &QTimer::timeout, this, [this] { tell_of_pen(); });
  pen_news_.start(kPenNews);
}

/// Tells above the paper what a person should know about the pen's device, as long as it holds.
void SketchWindow::tell_of_pen() {
  const std::string condition = felt_pen_->condition();
  if (condition == pen_told_) return;
  pen_told_ = condition;
  constexpr const char* kTopic = "pen";
  banner_->forget(kTopic);
  if (!condition.empty())
    banner_->tell({.weight = Note::Weight::Warning,
                   .text = felt_pen_->info().name + ": " + condition,
                   .topic = kTopic});
}

void SketchWindow::show_hint() { hint_->setText(sketch_entry(canvas_->tool()).hint); }

void SketchWindow::show_shortcuts() {
  std::vector<ShortcutSheet::Part> parts = {paper_part()};
  for (QAction* it : menuBar()->actions()) {
    auto part = ShortcutSheet::of_actions(it->text().remove('&'), it->menu()->actions());
    if (!part.rows.empty()) parts.push_back(std::move(part));
  }
  auto* sheet = new ShortcutSheet(parts, this);
  sheet->setAttribute(Qt::WA_DeleteOnClose);
  sheet->open();
}

void SketchWindow::closeEvent(QCloseEvent* event) {
  if (agreed_ || !document_.is_modified()) return event->accept();
  event->ignore();
  files_.when_safe([this] {
    agreed_ = true;
    close();
  });
}

SketchWindow& open_sketch_window(const std::filesystem::path& file) {
  auto* window = new SketchWindow;
  window->setAttribute(Qt::WA_DeleteOnClose);
  window->show();
  if (!file.empty()) window->open(file);
  return *window;
}

void choose_sketch(QWidget& parent) {
  auto* dialog = new QFileDialog(&parent, "Open a Drawing");
  dialog->setObjectName("sketch.open");
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->setFileMode(QFileDialog::ExistingFile);
  dialog->setNameFilters(sketch_open_filters());
  QObject::connect(dialog, &QFileDialog::fileSelected, &parent,
                   [](const QString& path) { open_sketch_window(path_of(path)); });
  dialog->open();
}

int run_sketch_window(int argc, char** argv, SketchWindowOptions options) {
  const auto application = connect_display(argc, argv, kNoSketchDisplayWays);
  if (!application) return 1;
  // Lines follow the hand better with all that the mouse reports.
  QApplication::setAttribute(Qt::AA_CompressHighFrequencyEvents, false);
  const std::string kept = QSettings("icome", "icome").value("theme").toString().toStdString();
  apply_theme(*application, theme_of(options.theme.empty() ? kept : options.theme).value_or(Theme::System));
  SketchWindow& window = open_sketch_window(options.file);
  if (options.pen) window.take_pen(std::move(options.pen));
  return QApplication::exec();
}

}  // namespace icome::ui
