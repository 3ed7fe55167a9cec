#include "ui/window/main_window.h"

#include <QApplication>
#include <QCloseEvent>
#include <QDockWidget>
#include <QDropEvent>
#include <QLabel>
#include <QMenuBar>
#include <QMimeData>
#include <QScreen>
#include <QStatusBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/forms/elided_label.h"
#include "ui/look/icons.h"
#include "ui/panels/object_look.h"
#include "ui/sharing/conflict_dialog.h"
#include "ui/window/status_strip.h"

namespace icome::ui {
namespace {

constexpr int kLayout = 4;  // counts up when docks and bars change, so that old layouts are not restored

bool same_file(const std::filesystem::path& one, const std::filesystem::path& other) {
  std::error_code error;
  const bool same = std::filesystem::equivalent(one, other, error);
  return error ? std::filesystem::absolute(one, error) == std::filesystem::absolute(other, error) : same;
}

QDockWidget* make_dock(QMainWindow* window, const char* name, const QString& title, QWidget* content,
                       Qt::DockWidgetArea area) {
  auto* dock = new QDockWidget(title, window);
  dock->setObjectName(name);
  dock->setAccessibleName(title);
  dock->setWidget(content);
  window->addDockWidget(area, dock);
  return dock;
}

}  // namespace

MainWindow::MainWindow(session::Session& session, QSettings& settings, const Options& options)
    : session_(session),
      settings_(settings),
      options_(options),
      tools_(session, {.chosen = [this](Tool tool) { show_tool(tool); },
                       .refused = [this](const std::string& why) { tell_error(why); },
                       .asked = [this](QPointF at) { show_scene_menu(at); },
                       .menu = [this](const session::MenuSpot& spot) { haptic_menu_.toggle(spot); },
                       .button_talks = [this] { return conversation_.listens_while_held(); }}),
      files_(session, settings, *this),
      edits_(session, {.begin = [this] { return finish_work(); },
                       .refused = [this](const std::string& why) { tell_error(why); },
                       .rename = [this] { tree_->rename(); },
                       .search = [this] { tree_->search(); }}),
      operations_(session,
                  {.begin = [this] { return finish_work(); },
                   .refused = [this](const std::string& why) { tell_error(why); },
                   .told = [this](const std::string& what) { tell({.text = what, .topic = "edit"}); },
                   .ask = [this](const interaction::Operation& it) { ask(it); },
                   .find = [this] { find_command(); }}),
      views_(session, tools_, settings),
      techniques_(session, settings, *this, [this](const Note& note) { tell(note); }),
      moves_(session, settings),
      pictures_(session,
                {.begin = [this] { return finish_work(); },
                 .refused = [this](const std::string& why) { tell_error(why); }},
                *this),
      drawings_(session,
                {.begin = [this] { return finish_work(); },
                 .refused = [this](const std::string& why) { tell_error(why); }},
                *this),
      haptic_menu_(session, settings,
                   {.begin = [this] { return finish_work(); },
                    .tell = [this](const Note& note) { tell(note); },
                    .ask = [this](const interaction::Operation& it) { ask(it); }},
                   *this),
      conversation_(session, {.begin = [this] { return !QApplication::activeModalWidget() && finish_work(); },
                              .mouse = [this] { return tools_.mouse_way(); },
                              .save = [this] { files_.save(); },
                              .close_design = [this] { files_.leave(); },
                              .menu = [this] { return haptic_menu_.element(); },
                              .open_menu = [this] { haptic_menu_.toggle({}); },
                              .loudspeaker = options.loudspeaker}) {
  if (options_.menu) haptic_menu_.use(*options_.menu);
  setObjectName("icome");
  setWindowIcon(app_icon());
  setAcceptDrops(true);
  make_center();
  make_docks();
  make_menus();
  make_tool_bar();
  restore_layout();
  files_.on_begin([this] { return finish_work(); });
  files_.on_save([this] { operation_->keep(); });
  files_.on_leave([this] {
    operation_->leave();
    techniques_.end_recording();
  });
  techniques_.on_choice([this] { is_stale_ = true; });
  views_.on_look([this] { show_look(); });
  views_.on_theme([this](Theme theme) { choose_theme(theme); });
  views_.show_theme(options_.theme);
  banner_->on_remedy([this](const Note& note, Note::Remedy what) { remedy(note, what); });
  tree_->on_zoom_to([this] { zoom_to_selection(session_, tools_.aspect()); });
  session_.on_change([this](const world::Changes*) { is_stale_ = true; });
  session_.on_selection([this] {
    edits_.refresh();  // so that a key that is pressed right after it finds its action
    is_stale_ = true;
  });
  show_tool(tools_.tool());
  show_title();
  timer_.setTimerType(Qt::PreciseTimer);
  connect(&timer_, &QTimer::timeout, this, [this] { tick(); });
  timer_.start(16);
}

MainWindow::~MainWindow() {
  // The scene's window hands events to the tools, which are destroyed before child widgets would be.
  delete takeCentralWidget();
}

void MainWindow::make_center() {
  auto* center = new QWidget(this);
  auto* rows = new QVBoxLayout(center);
  rows->setContentsMargins(0, 0, 0, 0);
  rows->setSpacing(0);
  banner_ = new Banner(center);
  shaping_ = new ShapeOptions(session_, tools_.shape_tool(), center);
  scene_ = new SceneView(session_, tools_, center);
  voice_ = new VoiceBar(
      conversation_, settings_,
      options_.microphone ? options_.microphone : [] { return speech::open_microphone(); },
      [this] { scene_->take_keyboard(); }, center);
  voice_->hide();
  conversation_.on_answer([this](const session::Spoken& spoken) {
    voice_->show_answer(spoken);
    is_stale_ = true;
  });
  scene_->window_of_scene().on_drop([this](QDropEvent& drop) { return offer_drop(drop, true); });
  rows->addWidget(banner_);
  rows->addWidget(shaping_);
  rows->addWidget(scene_, 1);
  rows->addWidget(voice_);
  setCentralWidget(center);
  hint_ = new ElidedLabel(this);
  hint_->setObjectName("status.hint");
  count_ = new QLabel(this);
  count_->setObjectName("status.count");
  technique_ = new QLabel(this);
  technique_->setObjectName("status.technique");
  technique_->setToolTip(
      "By which the hands select, hold and travel: Tools > Technique chooses another, or touch");
  statusBar()->addWidget(hint_, 1);
  sharing_ = new QLabel(this);
  sharing_->setObjectName("status.sharing");
  sharing_->setAccessibleName("Connection to the server of the design");
  statusBar()->addPermanentWidget(sharing_);
  statusBar()->addPermanentWidget(technique_);
  statusBar()->addPermanentWidget(count_);
}

void MainWindow::make_docks() {
  tree_ = new WorldTree(session_, this);
  QDockWidget* world = make_dock(this, "dock.world", "World", tree_, Qt::LeftDockWidgetArea);
  properties_ = new PropertyPanel(session_, this);
  QDockWidget* properties =
      make_dock(this, "dock.properties", "Properties", properties_, Qt::RightDockWidgetArea);
  hand_ = new StatusStrip(session_, this);
  make_dock(this, "dock.hand", "Hand", hand_, Qt::BottomDockWidgetArea);
  operation_ = new OperationPanel(
      session_, {.begin = [this] { return finish_work(); }, .closed = [this] { stop_asking(); }}, this);
  operation_dock_ = make_dock(this, "dock.operation", "Operation", operation_, Qt::RightDockWidgetArea);
  connect(operation_dock_->toggleViewAction(), &QAction::toggled, operation_, [this] {
    if (operation_dock_->isHidden()) operation_->leave();
  });
  tabifyDockWidget(properties, operation_dock_);
  devices_ = new DevicePanel(session_, options_.devices, this);
  devices_dock_ = make_dock(this, "dock.devices", "Devices", devices_, Qt::RightDockWidgetArea);
  tabifyDockWidget(properties, devices_dock_);
  devices_dock_->hide();
  people_ = new SharingPanel(session_, {.open = [this] { files_.choose_address(); }}, this);
  people_dock_ = make_dock(this, "dock.people", "People", people_, Qt::RightDockWidgetArea);
  tabifyDockWidget(properties, people_dock_);
  people_dock_->hide();
  resizeDocks({world, properties}, {60 * kGrid, 80 * kGrid}, Qt::Horizontal);
}

void MainWindow::restore_layout() {
  const QSize room = screen()->availableSize();
  resize(std::min(1240, room.width() * 31 / 32), std::min(740, room.height() * 15 / 16));
  restoreGeometry(settings_.value("window/geometry").toByteArray());
  restoreState(settings_.value("window/state").toByteArray(), kLayout);
  operation_dock_->hide();  // nothing is asked yet
}

void MainWindow::begin(const std::filesystem::path& design) {
  const bool is_address = session::SessionSharing::is_address(design.string());
  auto works = session_.files().recoverable();
  // The newest work on the design; without a design, the newest of all.
  std::stable_sort(works.begin(), works.end(),
                   [](const auto& a, const auto& b) { return a.changed > b.changed; });
  const auto wanted = std::find_if(works.begin(), works.end(), [&](const session::RecoverableWork& it) {
    return !is_address && (design.empty() || (!it.design.empty() && same_file(it.design, design)));
  });
  if (wanted != works.end()) {
    files_.recover(wanted->journal);
    works.erase(wanted);
  } else if (!design.empty()) {
    files_.open(design);
  }
  for (auto work = works.rbegin(); work != works.rend(); ++work) tell(note_of(*work));
  scene_->take_keyboard();
}

void MainWindow::tick() {
  tools_.tick();
  session_.view().set_aspect(tools_.aspect());
  for (const session::SessionEvent& event : session_.update()) {
    hear(event);
  }
  pictures_.tick();
  conversation_.tick();
  voice_->tick();
  scene_->tick();
  shaping_->tick();
  edits_.refresh();
  views_.refresh();
  show_progress();
  show_title();
  show_count();
  show_sharing();
  const bool has_menu = session_.menu().use() != nullptr;
  if (std::exchange(had_menu_, has_menu) != has_menu) is_stale_ = true;
  const auto labelled = wanted_label();
  if (is_stale_ || tools_.drag_words() != drag_words_ || operation_->remark() != remark_ ||
      techniques_.hint() != technique_hint_)
    show_hint();
  if (is_stale_ || labelled != labelled_ || devicePixelRatio() != pixel_ratio_) {
    labelled_ = labelled;
    show_look();
  }
  if (is_stale_) haptic_menu_.refresh();
  is_stale_ = false;
}

void MainWindow::hear(const session::SessionEvent& event) {
  using Kind = session::SessionEvent::Kind;
  tell(files_.hear(event));
  // The new design is seen whole, and notes on edits of the one before are of no use.
  if (event.kind == Kind::Opened || event.kind == Kind::Recovered) {
    banner_->forget("edit");
    session_.view().home();
    if (session_.sharing().state()) show_people();
  }
  if (event.kind == Kind::Conflicts) choose_for_conflicts();
}

void MainWindow::choose_for_conflicts() {
  if (session_.sharing().conflicts().empty() || findChild<QDialog*>("conflicts") != nullptr) return;
  auto* dialog = new ConflictDialog(
      session_,
      [this](const base::Result<void>& done) {
        banner_->forget("conflicts");
        if (!done) tell_error(done.error().message);
      },
      this);
  dialog->setAttribute(Qt::WA_DeleteOnClose);
  dialog->open();
}

void MainWindow::tell_error(const std::string& why) {
  tell({.weight = Note::Weight::Error, .text = why, .topic = "edit"});
}

void MainWindow::discard(const std::filesystem::path& journal) {
  for (const session::RecoverableWork& work : session_.files().recoverable()) {
    if (work.journal != journal) continue;
    session_.files().discard(work);
    return;
  }
}

void MainWindow::remedy(const Note& note, Note::Remedy what) {
  switch (what) {
    case Note::Remedy::Save:
      files_.save();
      break;
    case Note::Remedy::SaveAs:
      files_.save_as();
      break;
    case Note::Remedy::SaveAgain:
      files_.save_again();
      break;
    case Note::Remedy::OpenAnother:
      files_.choose_and_open();
      break;
    case Note::Remedy::RevertToSaved:
      files_.revert();
      break;
    case Note::Remedy::Recover:
      files_.recover(note.journal);
      break;
    case Note::Remedy::DiscardJournal:
      discard(note.journal);
      break;
    case Note::Remedy::Open:
      files_.open(note.design);
      break;
    case Note::Remedy::Choose:
      choose_for_conflicts();
      break;
  }
}

void MainWindow::show_progress() {
  const QString doing = files_.doing();
  if (doing.isEmpty()) {
    busy_since_.invalidate();
    banner_->hide_progress();
    return;
  }
  if (!busy_since_.isValid()) busy_since_.start();
  constexpr int kPatience = 300;  // ms, shorter work needs no progress bar
  if (busy_since_.elapsed() < kPatience) return;
  const auto part = session_.files().opening();
  banner_->show_progress(doing, part,
                         part ? [this] { session_.files().cancel_open(); } : std::function<void()>());
}

void MainWindow::show_title() {
  const QString title = QString("%1[*] - ICOME").arg(files_.design_name().replace("[*]", "[*][*]"));
  if (windowTitle() != title) setWindowTitle(title);
  setWindowModified(session_.files().modified());
}

/// The connection of a shared design in the status bar, and what others do in tree and scene.
void MainWindow::show_sharing() {
  const QString state = sharing_words(session_);
  if (state != sharing_state_) {
    sharing_state_ = state;
    sharing_->setText(state);
    sharing_->setVisible(!state.isEmpty());
    sharing_->setToolTip(tip_of(sharing_tip(session_)));
    if (state.isEmpty())
      for (const char* const topic : kSharingTopics) banner_->forget(topic);
  }
  QString floor;
  for (const auto& person : session_.sharing().people()) {
    floor += QString("%1 %2:").arg(person.author).arg(one_line(person.name));
    for (const world::ObjectId id : person.holds) floor += QString(" %1").arg(id.value);
  }
  if (floor == floor_state_) return;
  floor_state_ = floor;
  tree_->show_holders();
  is_stale_ = true;
}

/// The object that has its name written above it; nothing: none has.
std::optional<world::ObjectId> MainWindow::wanted_label() const {
  if (session_.menu().use() != nullptr && haptic_menu_.pops_up())
    return std::nullopt;  // it would lie over it
  if (tools_.hovered()) return tools_.hovered();
  const std::vector<world::ObjectId>& selected = session_.selection();
  return selected.size() == 1 ? std::optional(selected.front()) : std::nullopt;
}

void MainWindow::show_look() {
  const SceneColours its = scene_colours();
  pixel_ratio_ = devicePixelRatio();
  session::DisplayWish wish;
  wish.look.above = its.above;
  wish.look.below = its.below;
  wish.selection = its.selection;
  wish.look.outline_width = int(std::lround(wish.look.outline_width * pixel_ratio_));
  wish.look.shadows = views_.shadows();
  wish.look.grid = views_.grid();
  wish.look.grid_colour = its.grid;
  wish.look.passes = 16;
  wish.workspace = its.workspace;
  wish.spared_sign = spared_sign_.picture("Force held down to spare the motors", pixel_ratio_);
  const auto people = session_.sharing().people();
  for (const auto& it : people)
    if (!it.is_me)
      wish.name_signs[it.author] = name_signs_[it.author].picture(shortened(one_line(it.name)), pixel_ratio_);
  if (labelled_) {
    if (auto panel = label_.panel(session_, *labelled_, pixel_ratio_))
      wish.look.overlay.panels.push_back(std::move(*panel));
  }
  const std::vector<world::ObjectId> asked =
      voice_->isVisible() ? conversation_.candidates() : std::vector<world::ObjectId>();
  numbers_.resize(asked.size());
  for (std::size_t i = 0; i < asked.size(); ++i) {
    const auto& number = numbers_[i].picture(QString::number(i + 1), pixel_ratio_);
    if (auto panel = panel_above(session_, asked[i], number, pixel_ratio_))
      wish.look.overlay.panels.push_back(std::move(*panel));
  }
  session_.view().set_look(wish);
  session_.menu().set_theme(is_dark() ? session::ElementTheme::Dark : session::ElementTheme::Light);
}

/// Ends what the mouse is doing, and commits what is being typed. False: the text was refused.
bool MainWindow::finish_work() {
  tools_.finish();
  return shaping_->finish_typing() && properties_->finish_typing() && tree_->finish_typing() &&
         devices_->finish_typing();
}

void MainWindow::choose_theme(Theme theme) {
  settings_.setValue("theme", QString::fromStdString(std::string(name(theme))));
  apply_theme(*qApp, theme);
  views_.show_theme(theme);
}

void MainWindow::changeEvent(QEvent* event) {
  QMainWindow::changeEvent(event);
  if (event->type() == QEvent::PaletteChange && scene_) show_look();
}

void MainWindow::closeEvent(QCloseEvent* event) {
  closing_ = true;
  if (!agreed_) {
    files_.when_safe([this] {
      agreed_ = true;
      if (!closing_) close();
    });
  }
  closing_ = false;
  event->setAccepted(agreed_);
  if (!agreed_) return;
  timer_.stop();
  settings_.setValue("window/geometry", saveGeometry());
  settings_.setValue("window/state", saveState(kLayout));
  session_.files().cancel_open();
  session_.files().close();
}

bool MainWindow::offer_drop(QDropEvent& drop, bool over_scene) {
  const QString text = drop.mimeData()->text().trimmed();
  if (session::SessionSharing::is_address(text.toStdString())) {
    drop.setDropAction(Qt::CopyAction);
    drop.accept();
    if (drop.type() == QEvent::Drop) files_.open_address(text);
    return true;
  }
  const QList<QUrl> urls = drop.mimeData()->urls();
  if (urls.size() != 1 || !urls.front().isLocalFile()) return false;
  drop.setDropAction(Qt::CopyAction);
  drop.accept();
  const std::filesystem::path file = path_of(urls.front().toLocalFile());
  const bool dropped = drop.type() == QEvent::Drop;
  if (!is_named_as_picture(file)) {
    if (dropped) files_.open(file);
    return true;
  }
  const SceneInput input = in_eye({.at = drop.position(), .size = scene_->size()}, tools_.stereo());
  if (!dropped) {
    if (over_scene) tools_.move(input);  // names the object that it would fall on
  } else if (over_scene) {
    drop_picture(file, input);
  } else {
    tell_error("Drop a picture on the object in the scene that it is to lie on");
  }
  return true;
}

void MainWindow::drop_picture(const std::filesystem::path& file, const SceneInput& input) {
  const auto picked = session_.stage().pick_seen(input.ray(session_.view()));
  if (!picked)
    return tell_error("There is no object under the picture: drop it on the one that it is to lie on");
  pictures_.put(file, {picked->object});
}

bool MainWindow::event(QEvent* event) {
  const bool drop = event->type() == QEvent::DragEnter || event->type() == QEvent::DragMove ||
                    event->type() == QEvent::Drop;
  if (drop && offer_drop(static_cast<QDropEvent&>(*event), false)) return true;
  return QMainWindow::event(event);
}

}  // namespace icome::ui
