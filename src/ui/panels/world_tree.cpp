#include "ui/panels/world_tree.h"

#include <QAction>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QStackedWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "interaction/object_edits.h"
#include "ui/actions/object_menu.h"
#include "ui/forms/quiet_combo_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/match_model.h"
#include "ui/panels/object_look.h"
#include "ui/panels/object_view.h"
#include "ui/panels/panel_note.h"
#include "ui/panels/world_model.h"

namespace icome::ui {

using world::ObjectId;

namespace {

/// Most rows that are unfolded at first, level by level: as many as can be seen at a glance.
constexpr int kAtAGlance = 24;

}  // namespace

struct WorldTree::Parts {
  Parts(session::Session& of, WorldTree& panel);

  ObjectView& view() { return *static_cast<ObjectView*>(stack->currentWidget()); }
  void build(WorldTree& panel);
  void connect_view(ObjectView& view);
  void follow(const world::Changes* changes);
  void unfold();
  void search(const QString& text);
  void show_count();
  void show_scenes();
  void open_menu(const QPoint& at);

  session::Session& session;
  std::function<void()> zoom = {};
  int refusals = 0;
  std::vector<world::SceneId> scenes = {};
  WorldModel* model;
  MatchModel* matches;
  QLineEdit* field;
  QComboBox* scene;
  QStackedWidget* stack;
  ObjectView* tree;
  ObjectView* list;
  QLabel* count;
  PanelNote* note;
  std::shared_ptr<bool> alive = std::make_shared<bool>(true);  // listeners may outlive us
};

WorldTree::Parts::Parts(session::Session& of, WorldTree& panel)
    : session(of),
      model(new WorldModel(of, &panel)),
      matches(new MatchModel(of, &panel)),
      field(new QLineEdit(&panel)),
      scene(new QuietComboBox(&panel)),
      stack(new QStackedWidget(&panel)),
      tree(new ObjectView(of, *model, stack)),
      list(new ObjectView(of, *matches, stack)),
      count(new QLabel(&panel)),
      note(new PanelNote(&panel)) {
  build(panel);
  connect_view(*tree);
  connect_view(*list);
  QObject::connect(field, &QLineEdit::textChanged, &panel, [this](const QString& text) { search(text); });
  QObject::connect(scene, &QComboBox::activated, &panel, [this](int row) {
    session.stage().show_scene(row > 0 ? scenes[std::size_t(row) - 1] : world::SceneId{});
  });
  for (ObjectModel* objects : {static_cast<ObjectModel*>(model), static_cast<ObjectModel*>(matches)})
    objects->on_refusal([this](const QString& why) {
      ++refusals;
      note->say(why);
    });
  const std::weak_ptr<bool> guard = alive;
  session.on_change([this, guard](const world::Changes* changes) {
    if (!guard.expired()) follow(changes);
  });
  session.on_selection([this, guard] {
    if (!guard.expired()) view().show_selection();
  });
  show_scenes();
  unfold();
  view().show_selection();
}

void WorldTree::Parts::build(WorldTree& panel) {
  field->setPlaceholderText("Search objects");
  field->setAccessibleName("Search objects by name");
  field->setClearButtonEnabled(true);
  field->addAction(icon(Icon::Search), QLineEdit::LeadingPosition);
  scene->setAccessibleName("Scene that is shown");
  scene->setToolTip("What is seen and touched: the whole world, or one of its scenes");
  tree->setAccessibleName("Objects of the world");
  tree->setDragDropMode(QAbstractItemView::InternalMove);
  list->setAccessibleName("Objects that were found");
  list->setRootIsDecorated(false);
  stack->addWidget(tree);
  stack->addWidget(list);
  count->setForegroundRole(QPalette::PlaceholderText);
  count->setContentsMargins(2 * kGrid, kGrid, 2 * kGrid, kGrid);
  auto* top = new QVBoxLayout;
  top->setContentsMargins(2 * kGrid, 2 * kGrid, 2 * kGrid, 2 * kGrid);
  top->setSpacing(kGrid);
  top->addWidget(field);
  top->addWidget(scene);
  auto* all = new QVBoxLayout(&panel);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(0);
  all->addLayout(top);
  all->addWidget(stack, 1);
  all->addWidget(note);
  all->addWidget(count);
  panel.setFocusProxy(tree);
}

void WorldTree::Parts::connect_view(ObjectView& it) {
  QObject::connect(&it, &QTreeView::customContextMenuRequested, &it,
                   [this](const QPoint& at) { open_menu(at); });
  QObject::connect(&it, &QTreeView::doubleClicked, &it, [this] {
    if (zoom) zoom();
  });
}

void WorldTree::Parts::follow(const world::Changes* changes) {
  tree->follow(changes);
  list->follow(changes);
  // The hidden view takes over the selection when it is shown.
  if (!changes || !changes->objects.empty()) view().show_selection();
  if (!changes) unfold();
  if (!changes || !changes->scenes.empty()) show_scenes();
  if (!changes || !changes->objects.empty()) show_count();
}

void WorldTree::Parts::unfold() {
  std::vector<QModelIndex> level{QModelIndex()};
  int rows = 0;
  while (!level.empty() && rows <= kAtAGlance) {
    std::vector<QModelIndex> next;
    for (const QModelIndex& index : level) {
      if (model->canFetchMore(index)) model->fetchMore(index);
      for (int row = 0; row < std::min(model->rowCount(index), kAtAGlance + 1); ++row)
        next.push_back(model->index(row, 0, index));
    }
    rows += int(next.size());
    if (rows > kAtAGlance) break;
    for (const QModelIndex& index : level) {
      if (index.isValid()) tree->expand(index);
    }
    level = std::move(next);
  }
  show_count();
}

void WorldTree::Parts::search(const QString& text) {
  const bool searching = !text.simplified().isEmpty();
  matches->search(text);
  stack->setCurrentWidget(searching ? list : tree);
  view().show_selection();
  show_count();
}

void WorldTree::Parts::show_count() {
  const std::size_t all = session.world().objects().size();
  const QLocale locale(QLocale::English);
  const QString total = all == 1 ? "1 object" : QString("%1 objects").arg(locale.toString(qulonglong(all)));
  if (stack->currentWidget() == list)
    count->setText(QString("%1 of %2").arg(locale.toString(qulonglong(matches->size())), total));
  else
    count->setText(all == 0 ? "No objects yet" : total);
}

void WorldTree::Parts::show_scenes() {
  scenes.clear();
  for (const auto& [id, it] : session.world().scenes()) scenes.push_back(id);
  std::sort(scenes.begin(), scenes.end());
  scene->clear();
  scene->addItem(icon(Icon::Scene), "Whole world");
  for (const world::SceneId id : scenes) {
    const QString name = one_line(session.world().find(id)->name);
    scene->addItem(icon(Icon::Scene), name.isEmpty() ? QString("Scene without a name") : name);
    if (id == session.stage().shown_scene()) scene->setCurrentIndex(scene->count() - 1);
  }
  // A single scene that is the whole world would be no choice.
  const bool all =
      scenes.size() == 1 && session.world().find(scenes.front())->roots == session.world().roots();
  scene->setVisible(!scenes.empty() && !all);
}

void WorldTree::Parts::open_menu(const QPoint& at) {
  note->clear();
  ObjectView& it = view();
  QMenu menu(&it);
  const ObjectMenu entries{
      .zoom = zoom,
      .rename = [&it] { it.edit(it.currentIndex()); },
      .refused = [this](const std::string& why) { note->say(QString::fromStdString(why)); },
  };
  fill_object_menu(menu, session, entries);
  if (!menu.isEmpty()) menu.exec(it.viewport()->mapToGlobal(at));
}

WorldTree::WorldTree(session::Session& session, QWidget* parent)
    : QWidget(parent), parts_(std::make_unique<Parts>(session, *this)) {}

WorldTree::~WorldTree() = default;

void WorldTree::on_zoom_to(std::function<void()> zoom) { parts_->zoom = std::move(zoom); }

void WorldTree::rename() {
  ObjectView& view = parts_->view();
  view.setFocus();
  if (view.currentIndex().isValid()) view.edit(view.currentIndex());
}

void WorldTree::show_holders() {
  for (ObjectView* it : {parts_->tree, parts_->list}) it->viewport()->update();
}

bool WorldTree::finish_typing() {
  const int before = parts_->refusals;
  parts_->view().finish_editing();
  return parts_->refusals == before;
}

void WorldTree::search() {
  parts_->field->setFocus();
  parts_->field->selectAll();
}

}  // namespace icome::ui
