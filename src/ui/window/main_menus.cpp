#include <QActionGroup>
#include <QApplication>
#include <QDockWidget>
#include <QLabel>
#include <QMenuBar>
#include <QToolBar>
#include <algorithm>
#include <array>

#include "ui/actions/actions.h"
#include "ui/actions/object_menu.h"
#include "ui/cutout/run_cutout.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"
#include "ui/sketch/sketch_window.h"
#include "ui/window/about_box.h"
#include "ui/window/command_palette.h"
#include "ui/window/main_window.h"
#include "ui/window/shortcut_sheet.h"

namespace icome::ui {
namespace {

struct ToolEntry {
  Tool tool;
  Icon icon;
  const char* name;
  const char* text;
  const char* keys;
  const char* hint;  // the use of mouse and keyboard
};
constexpr ToolEntry kTools[] = {
    {Tool::Select, Icon::Select, "tool.select", "&Select and Move", "S",
     "Click to select, drag to move (hold X, Y or Z to keep to an axis)"},
    {Tool::Touch, Icon::Touch, "tool.touch", "&Touch", "T",
     "Press to touch, turn the wheel to press harder or softer"},
    {Tool::View, Icon::View, "tool.view", "Orbit and &View", "V",
     "Drag to turn, Shift and drag to shift, Ctrl and drag to look around"},
    {Tool::Shape, Icon::DragPoint, "tool.shape", "Sha&pe by Points", "P",
     "Drag vertices, edges, faces or a lattice's points (hold X, Y or Z to keep to an axis)"},
};

/// Uses of mouse and keys that are not actions of a menu.
ShortcutSheet::Part mouse_part() {
  return {"In the scene",
          {{"Turn the view", "Right drag"},
           {"Shift the view", "Middle drag, or Shift+right drag"},
           {"Closer, farther", "Wheel"},
           {"Zoom to an object", "Double click"},
           {"Select", "Click"},
           {"Select more", "Shift or Ctrl and click"},
           {"Put a picture on an object", "drop its file there"},
           {"Move what is selected", "Drag"},
           {"\u2026 along x, y or z", "hold X, Y or Z"},
           {"\u2026 without snapping", "hold Shift or Alt"},
           {"Move an operand, or the projector of a picture", "Drag its outline, seen while selected"},
           {"\u2026 turn it", "Ctrl and drag its outline"},
           {"Move by 1 mm, by 10 mm", "Arrow keys, with Shift"},
           {"\u2026 away, nearer", "Page Up, Page Down"},
           {"Turn the view (nothing selected)", "Arrow keys"},
           {"Touch", "Press the button, the pen or Enter"},
           {"Haptic menu", "Space, or a stylus's second button"},
           {"\u2026 choose from it", "Click, push, or arrow keys and Enter"},
           {"Talk, where voice commands ask for it", "hold F9, or a stylus's second button"},
           {"Next tool", "Tab"},
           {"Back out", "Esc"}}};
}

/// The first widget within `part` that Tab would reach; null: none.
QWidget* first_stop(const QWidget& part) {
  if (QWidget* proxy = part.focusProxy(); proxy && proxy->isVisible()) return proxy;
  for (QWidget* it = part.nextInFocusChain(); it != &part; it = it->nextInFocusChain()) {
    const bool stops = (it->focusPolicy() & Qt::TabFocus) != 0 && it->isVisible() && it->isEnabled();
    if (stops && part.isAncestorOf(it)) return it;
  }
  return nullptr;
}

/// Moves the focus there, away from the scene's own window; a dock behind others comes to the front.
void go_to(QWidget& stop) {
  for (QWidget* it = &stop; it; it = it->parentWidget()) {
    if (auto* dock = qobject_cast<QDockWidget*>(it)) dock->raise();
  }
  stop.activateWindow();
  stop.setFocus(Qt::TabFocusReason);
}

QString millimetres(double metres) { return QString::number(1000.0 * metres, 'f', 1); }

}  // namespace

void MainWindow::make_menus() {
  files_.fill(*menuBar()->addMenu("&File"));
  QMenu* file = menuBar()->actions().front()->menu();
  file->addSeparator();
  add_action(*file, "file.new_drawing", "New &Drawing", {}, [] { open_sketch_window({}); });
  add_action(*file, "file.open_drawing", "Open D&rawing\u2026", {}, [this] { choose_sketch(*this); });
  add_action(*file, "file.new_animation", "New &Animation", {}, [] { open_cutout_window({}); });
  add_action(*file, "file.open_animation", "Open Ani&mation\u2026", {}, [this] { choose_cutout(*this); });
  file->addSeparator();
  add_action(*file, "file.quit", "&Quit", QKeySequence("Ctrl+Q"), [this] { close(); });
  QMenu* edit = menuBar()->addMenu("&Edit");
  edits_.fill(*edit);
  QMenu* model = menuBar()->addMenu("&Model");
  operations_.fill(*model, *edit);
  model->addSeparator();
  pictures_.fill(*model);
  drawings_.fill(*model->addMenu("&Drawing"));
  moves_.fill(*model->addMenu("&Moving"), *this);
  QMenu* view = menuBar()->addMenu("&View");
  views_.fill(*view);
  view->addSeparator();
  add_action(*view, "view.devices", "&Devices\u2026", {}, [this] { show_devices(); });
  add_action(*view, "view.people", "&People\u2026", {}, [this] { show_people(); });
  make_tool_menu(*menuBar()->addMenu("&Tools"));
  QMenu* window = menuBar()->addMenu("&Window");
  for (QDockWidget* dock : findChildren<QDockWidget*>()) window->addAction(dock->toggleViewAction());
  window->addSeparator();
  add_action(*window, "window.next_part", "&Next Part", QKeySequence("F6"), [this] { next_part(); });
  make_help_menu(*menuBar()->addMenu("&Help"));
}

void MainWindow::make_tool_menu(QMenu& menu) {
  auto* group = new QActionGroup(this);
  for (const ToolEntry& it : kTools) {
    QAction* action = add_action(menu, it.name, it.text, QKeySequence(it.keys),
                                 [this, tool = it.tool] { tools_.choose(tool); });
    action->setIcon(icon(it.icon));
    action->setCheckable(true);
    group->addAction(action);
    tool_actions_[int(it.tool)] = action;
  }
  menu.addSeparator();
  haptic_menu_.fill(menu);
  voice_action_ = add_action(menu, "tool.voice", "&Voice Commands", QKeySequence("F8"),
                             [this] { show_voice(voice_action_->isChecked()); });
  voice_action_->setCheckable(true);
  menu.addSeparator();
  techniques_.fill(menu);
}

void MainWindow::make_help_menu(QMenu& menu) {
  QAction* sheet =
      add_action(menu, "help.shortcuts", "&Keys and Mouse", QKeySequence("F1"), [this] { show_shortcuts(); });
  sheet->setIcon(icon(Icon::Help));
  add_action(menu, "help.about", "&About ICOME", {}, [this] {
    auto* box = new AboutBox(scene_->window_of_scene().renderer(), this);
    box->setAttribute(Qt::WA_DeleteOnClose);
    box->open();
  });
}

void MainWindow::show_shortcuts() {
  std::vector<ShortcutSheet::Part> parts = {mouse_part()};
  for (QAction* it : menuBar()->actions()) {
    QList<QAction*> actions;
    for (QAction* entry : it->menu()->actions()) {
      if (entry->menu()) actions << entry->menu()->actions();
      actions << entry;
    }
    auto part = ShortcutSheet::of_actions(it->text().remove('&'), actions);
    if (!part.rows.empty()) parts.push_back(std::move(part));
  }
  auto* sheet = new ShortcutSheet(parts, this);
  sheet->setAttribute(Qt::WA_DeleteOnClose);
  sheet->open();
}

void MainWindow::find_command() {
  auto* palette = new CommandPalette(commands_of(*menuBar()), this);
  palette->setAttribute(Qt::WA_DeleteOnClose);
  palette->open();
}

void MainWindow::ask(const interaction::Operation& operation) {
  operation_->ask(operation);
  operation_dock_->show();
  operation_dock_->raise();
  go_to(*operation_->first_field());
}

void MainWindow::show_devices() {
  devices_dock_->show();
  devices_dock_->raise();
  if (QWidget* const stop = first_stop(*devices_)) go_to(*stop);
}

void MainWindow::show_people() {
  people_dock_->show();
  people_dock_->raise();
  if (QWidget* const stop = first_stop(*people_)) go_to(*stop);
}

void MainWindow::show_voice(bool shown) {
  voice_->setVisible(shown);
  is_stale_ = true;
  if (shown)
    go_to(voice_->field());
  else
    scene_->take_keyboard();
}

void MainWindow::stop_asking() {
  operation_dock_->hide();
  scene_->take_keyboard();
}

void MainWindow::make_tool_bar() {
  QToolBar* bar = addToolBar("Tools");
  bar->setObjectName("toolbar");
  bar->addAction(files_.open_design());
  bar->addAction(files_.save_design());
  bar->addSeparator();
  bar->addAction(edits_.undo());
  bar->addAction(edits_.redo());
  bar->addSeparator();
  for (QAction* it : tool_actions_) bar->addAction(it);
  bar->addSeparator();
  bar->addAction(views_.home());
  bar->addAction(views_.zoom_to_selection());
  bar->addSeparator();
  bar->addAction(edits_.duplicate());
  bar->addAction(edits_.delete_objects());
}

void MainWindow::show_tool(Tool tool) {
  tool_actions_[int(tool)]->setChecked(true);
  shaping_->setVisible(tool == Tool::Shape);
  operation_->forget_remark();
  is_stale_ = true;
  show_look();
}

void MainWindow::show_hint() {
  const std::vector<world::ObjectId>& selected = session_.selection();
  QString text = kTools[int(tools_.tool())].hint;
  const QString by = techniques_.name();
  technique_hint_ = techniques_.hint();
  if (tools_.tool() == Tool::Touch && !by.isEmpty()) text = technique_hint_;
  technique_->setVisible(!by.isEmpty());
  technique_->setText("Technique: " + by);
  if (tools_.tool() == Tool::Select && !selected.empty()) {
    const base::Bounds bounds = session_.stage().selection_bounds();
    text = selected.size() > 1 ? QString("%1 objects").arg(selected.size())
                               : shortened(shown_name(session_.world(), selected.front()));
    if (!bounds.isEmpty()) {
      const base::Vector3 size = bounds.sizes();
      text += QString(": %1 \u00d7 %2 \u00d7 %3 mm")
                  .arg(millimetres(size.x()), millimetres(size.y()), millimetres(size.z()));
    }
  }
  remark_ = operation_->remark();
  if (!remark_.isEmpty()) text = remark_;
  if (session_.menu().use() != nullptr)
    text = "Click an item, push it, or choose by arrow keys and Enter; Esc closes the menu";
  drag_words_ = tools_.drag_words();
  if (!drag_words_.empty()) text = one_line(drag_words_);
  hint_->setText(text);
}

void MainWindow::show_count() {
  const auto counted = [](std::size_t count, const char* one, const char* many) {
    return QString("%L1 %2").arg(count).arg(count == 1 ? one : many);
  };
  const auto& drawn = session_.view().drawn();
  const QString count = counted(drawn->object_count(), "object", "objects") + ", " +
                        counted(drawn->triangle_count(), "triangle", "triangles");
  if (count_->text() != count) count_->setText(count);
}

void MainWindow::show_scene_menu(QPointF at) {
  const SceneInput input = in_eye({.at = at, .size = scene_->size()}, tools_.stereo());
  if (const auto picked = session_.stage().pick_seen(input.ray(session_.view()))) {
    const auto& selected = session_.selection();
    if (std::find(selected.begin(), selected.end(), picked->object) == selected.end())
      session_.select({picked->object});
  } else {
    session_.select({});
  }
  auto* menu = new QMenu(this);
  menu->setObjectName("scene.menu");
  menu->setAttribute(Qt::WA_DeleteOnClose);
  fill_object_menu(
      *menu, session_,
      {.zoom = [this] { zoom_to_selection(session_, tools_.aspect()); },
       .rename = [this] { tree_->rename(); },
       .picture = [this] { pictures_.choose(); },
       .draw = drawings_.selected() ? [this] { drawings_.draw_on_selected(); } : std::function<void()>(),
       .refused = [this](const std::string& why) { tell_error(why); }});
  menu->addSeparator();
  menu->addAction(views_.home());
  menu->popup(scene_->mapToGlobal(at.toPoint()));
}

void MainWindow::next_part() {
  const std::array<QWidget*, 10> parts{scene_,      banner_,    shaping_, voice_,  tree_,
                                       properties_, operation_, devices_, people_, hand_};
  const QWidget* const focus = QApplication::focusWidget();
  auto found = std::find_if(parts.begin(), parts.end(),
                            [&](const QWidget* it) { return focus && it->isAncestorOf(focus); });
  // A widget with the focus has the keyboard even if the scene's own window has not let go of it yet.
  if (found == parts.end() && scene_->has_keyboard()) found = parts.begin();
  // From nowhere it goes to the scene.
  const auto now = std::size_t((found == parts.end() ? parts.end() - 1 : found) - parts.begin());
  for (std::size_t step = 1; step <= parts.size(); ++step) {
    QWidget* const part = parts[(now + step) % parts.size()];
    if (!part->isVisible()) continue;
    if (part == scene_) return scene_->take_keyboard();
    if (QWidget* const stop = first_stop(*part)) return go_to(*stop);
  }
}

}  // namespace icome::ui
